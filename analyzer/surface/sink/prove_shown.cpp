#include "surface/sink/prove_shown.h"

#include "language/dialect/code_name.h"
#include "language/dialect/switch_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace feedhold {

using prove::Obligation;
using prove::ObligationKind;
using prove::Verdict;

namespace {

constexpr std::array kVerdicts = {Verdict::Proved, Verdict::Refuted, Verdict::Unknown, Verdict::Unreachable};

/// The shortest text that is read as the same number, without an exponent.
std::string shortest(double value) {
  std::string text = fmt::format("{:.17f}", value);
  for (int decimals = 0; decimals < 17; ++decimals)
    if (std::string rounded = fmt::format("{:.{}f}", value, decimals); std::stod(rounded) == value) {
      text = std::move(rounded);
      break;
    }
  return text == "-0" ? "0" : text;
}

/// A number without a point counts in the least increment on many controls.
std::string withPoint(double value) {
  std::string text = shortest(value);
  return text.find('.') == std::string::npos ? text + "." : text;
}

std::optional<char> letterFor(const Dialect &dialect, std::uint32_t variable) {
  for (std::size_t i = 0; i < dialect.argumentVariables.size(); ++i)
    if (dialect.argumentVariables[i] == variable && variable != 0)
      return static_cast<char>('A' + i);
  return std::nullopt;
}

/// `O9810`, `O9810 and O9811`, `O9810, O9811 and O9832`
std::string listOf(const std::vector<std::string> &names) {
  std::string text = names.front();
  for (std::size_t i = 1; i < names.size(); ++i)
    text += (i + 1 == names.size() ? " and " : ", ") + names[i];
  return text;
}

/// What of the start is not as after power-on: `in G18 at X5.`; empty: nothing.
std::string startOf(const TypedWitness &witness) {
  std::string text;
  for (const std::string &word : witness.modal)
    text += (text.empty() ? "in " : " ") + word;
  std::string_view before = text.empty() ? "at " : " at ";
  for (const auto &[axis, coordinate] : witness.place) {
    text += fmt::format("{}{}{}", before, axis, withPoint(coordinate));
    before = " ";
  }
  return text;
}

std::string controlAlarm(const Dialect &dialect, AlarmKind kind) {
  const auto number = alarmNumber(dialect, kind);
  return number ? fmt::format("{} ({})", *number, meaningOf(kind)) : std::string(meaningOf(kind));
}

/// An alarm that the control raises at the block of the claim; under cutter compensation it may be any block behind it.
bool isOfBlock(const Obligation &obligation) {
  return obligation.alarm && obligation.alarm != AlarmKind::CutterCompensation;
}

} // namespace

std::vector<std::pair<std::string, bool>> settingsOf(const GivenStart &start) {
  std::vector<std::pair<std::string, bool>> settings;
  for (const auto &[setting, isOn] : start.settings)
    settings.emplace_back(switchNames()[setting].name, isOn);
  return settings;
}

std::vector<std::string> modalWords(const GivenStart &start, const Dialect &dialect) {
  const ModalTable modes(dialect);
  std::vector<std::string> words;
  for (const auto &[group, code] : start.codes)
    if (const auto &codes = modes.group(group).codes; code < codes.size())
      words.push_back(codeName('G', codes[code]->tenths));
  for (const auto &[letter, number] : start.words)
    words.push_back(letter + shortest(number));
  return words;
}

void VerdictCounts::add(const prove::ProgramProof &proof) {
  for (const Obligation &obligation : proof.obligations)
    ++byVerdict[static_cast<std::size_t>(obligation.verdict.kind())];
}

std::string textOf(const VerdictCounts &counts) {
  std::string text;
  for (const Verdict::Kind verdict : kVerdicts)
    if (counts.of(verdict) != 0)
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", counts.of(verdict), nameOf(verdict));
  return text.empty() ? "nothing to prove" : text;
}

std::string programName(const ProvedFile &file, const ProvedProgram &program) {
  const std::string name = toString(file.file().model.programs[program.program].name);
  return name.empty() ? "a program without a number" : name;
}

std::string quotedWord(const std::string &word) {
  const bool isPlain = !word.empty() && word.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz"
                                                               "0123456789_-+=./,:%@") == std::string::npos;
  if (isPlain)
    return word;
  std::string text = "'";
  for (const char c : word)
    text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

/// Of a mill, whose cell of a cutter radius it is.
std::optional<std::uint32_t> offsetNumber(const Dialect &dialect, std::uint32_t variable) {
  const OffsetMemory &memory = dialect.behaviour.cutterOffsets;
  if (dialect.machine == MachineKind::Turning)
    return std::nullopt;
  for (std::uint32_t number = 1; number <= memory.count; ++number)
    if (cellOf(dialect, memory.geometry.front() + number - 1) == variable)
      return number;
  return std::nullopt;
}

TypedWitness typed(const prove::Witness &witness, const ProvedFile &file, const ProvedProgram &program,
                   const ProveReport &report) {
  const ProgramModel &model = file.file().model;
  const ProgramName &name = model.programs[program.program].name;
  TypedWitness result;
  std::string letters;
  result.options = quotedWord(file.file().shown);
  if (model.programs.size() > 1 && !toString(name).empty())
    result.options += " --program " + quotedWord(toString(name));
  for (const auto &[variable, value] : witness.variables.entries()) {
    if (value.vacant)
      continue;
    if (const auto letter = letterFor(file.project->dialect(), variable); letter && name.number) {
      letters += fmt::format(" {}{}", *letter, withPoint(value.number));
      result.options += fmt::format(" --arg {}={}", *letter, shortest(value.number));
      continue;
    }
    if (const auto offset = offsetNumber(file.project->dialect(), variable)) {
      result.others.emplace_back(fmt::format("D{}", *offset), shortest(value.number));
      result.variables.emplace_back(fmt::format("{}", variable), value.number);
      result.options += fmt::format(" --offset D{}={}", *offset, shortest(value.number));
      continue;
    }
    const std::string shown = file.project->set->nameOfVariable(variable);
    result.others.emplace_back(shown, shortest(value.number));
    result.variables.emplace_back(shown.substr(1), value.number);
    result.options += " --var " + quotedWord(shown.substr(1) + "=" + shortest(value.number));
  }
  for (const auto &[variable, script] : witness.variables.readings.entries()) {
    const std::string shown = file.project->set->nameOfVariable(variable);
    std::string numbers;
    for (const double reading : script)
      numbers += (numbers.empty() ? "" : ",") + shortest(reading);
    result.readings.emplace_back(shown.substr(1), script);
    result.options += " --input " + quotedWord((variable == kSkipShare ? shown.substr(1) : shown) + "=" + numbers);
  }
  result.modal = modalWords(witness.variables.start, file.project->dialect());
  for (const std::string &word : result.modal)
    result.options += " --modal " + word;
  for (const auto &[axis, coordinate] : witness.variables.start.place) {
    result.place.emplace_back(letterOf(axis), coordinate);
    result.options += fmt::format(" --start {}{}", letterOf(axis), shortest(coordinate));
  }
  result.settings = settingsOf(witness.variables.start);
  for (const auto &[setting, isOn] : result.settings)
    result.options += fmt::format(" --switch {}={}", setting, isOn ? "on" : "off");
  if (!witness.returning.empty())
    result.options += " --missing return";
  result.options += report.readingOptions;
  if (name.number)
    result.call = fmt::format("G65 P{}{}", *name.number, letters);
  return result;
}

constexpr std::string_view kSkipName = "skip"; // of kSkipShare

/// Of each skip move in turn.
std::string skipText(const std::vector<double> &shares) {
  std::string text;
  for (const double share : shares) {
    const std::string one = share == 1   ? "no skip signal"
                            : share == 0 ? "the skip signal at once"
                                         : fmt::format("the skip signal after {} % of the way", shortest(100 * share));
    text += (text.empty() ? "" : ", then ") + one;
  }
  return text;
}

std::string textOf(const TypedWitness &witness) {
  std::string text = witness.call.value_or("a run of this program");
  std::string_view before = " with ";
  for (const auto &[name, value] : witness.others) {
    text += fmt::format("{}{}={}", before, name, value);
    before = ", ";
  }
  for (const auto &[name, readings] : witness.readings) {
    std::string numbers;
    for (const double reading : readings)
      numbers += (numbers.empty() ? "" : ", then ") + shortest(reading);
    text +=
        std::string(before) + (name == kSkipName ? skipText(readings) : fmt::format("#{} read as {}", name, numbers));
    before = ", ";
  }
  if (const std::string start = startOf(witness); !start.empty())
    text += ", started " + start;
  std::string_view join = ", where ";
  for (const auto &[name, isOn] : witness.settings) {
    text += fmt::format("{}`{}` is {}", join, name, isOn ? "on" : "off");
    join = " and ";
  }
  return text;
}

std::string claimOf(const Obligation &obligation, const Dialect &dialect) {
  return isOfBlock(obligation) ? "the control never stops here with " + controlAlarm(dialect, *obligation.alarm)
                               : obligation.claim;
}

std::string happenedIn(const prove::Witness &witness, const Obligation &obligation, const Dialect &dialect) {
  const std::string happened = isOfBlock(obligation) && witness.end == RunEnd::Alarm
                                   ? "stops with " + controlAlarm(dialect, *obligation.alarm)
                                   : witness.happened;
  const std::size_t programs = witness.returning.size();
  return programs == 0 ? happened
                       : fmt::format("{}, if {} {}", happened, listOf(witness.returning),
                                     programs == 1 ? "returns and changes nothing" : "return and change nothing");
}

namespace {

/// That a missing program returns is told beside it; of one that is in the files it is a claim of its own proof.
std::string keeping(const Obligation &obligation) {
  const bool isOne = obligation.promising.size() == 1;
  const bool isOfEnd =
      (obligation.kind == ObligationKind::LoopEnds || obligation.kind == ObligationKind::ProgramEnds) &&
      !std::ranges::includes(obligation.returning, obligation.promising); // both in order
  const std::string_view ends = !isOfEnd ? "" : isOne ? "comes to its end and " : "come to their end and ";
  return fmt::format("{}{}", ends, isOne ? "keeps its contract" : "keep their contracts");
}

} // namespace

std::vector<std::string> assumedIn(const Obligation &obligation) {
  std::vector<std::string> assumed;
  if (const std::size_t programs = obligation.returning.size(); programs > 0)
    assumed.push_back(fmt::format("if {} {}{}, which {} not in the files", listOf(obligation.returning),
                                  programs == 1 ? "returns" : "return",
                                  !obligation.unchanged ? ""
                                  : programs == 1       ? " and changes nothing"
                                                        : " and change nothing",
                                  programs == 1 ? "is" : "are"));
  if (const std::size_t programs = obligation.promising.size(); programs > 0)
    assumed.push_back(fmt::format("if {} {}", listOf(obligation.promising), keeping(obligation)));
  if (obligation.takesFewPasses)
    assumed.emplace_back("if no loop makes more than 10^12 passes");
  if (obligation.offsetIsOfTool)
    assumed.emplace_back("if the offset of D is the radius of `@TOOL`");
  return assumed;
}

std::string remedyOf(const prove::Guard &guard) {
  return fmt::format("with the clause `{}` in the contract, this is proved{}", guard.clause,
                     guard.exactOnly ? " in exact arithmetic" : "");
}

std::string messageOf(const Obligation &obligation, const Dialect &dialect) {
  const bool isRefuted = obligation.verdict == Verdict::Refuted;
  const std::string_view open = isRefuted ? "" : "it is not known whether ";
  switch (obligation.kind) {
  case ObligationKind::LoopEnds:
    return isRefuted ? "this loop can run for ever" : "it is not known whether this loop always ends";
  case ObligationKind::ProgramEnds:
    return isRefuted ? "this program can run for ever" : "it is not known whether this program always comes to an end";
  case ObligationKind::AlarmUnreachable: return fmt::format("{}this alarm can be raised", open);
  case ObligationKind::NoControlAlarm:
    return fmt::format("{}the control can stop here{}", open,
                       obligation.alarm ? " with " + controlAlarm(dialect, *obligation.alarm) : "");
  case ObligationKind::Compensation:
    return fmt::format("{}the control can stop in the cutter compensation that begins here", open);
  case ObligationKind::AlarmIff:
  case ObligationKind::Ensures:
  case ObligationKind::Assigns:
  case ObligationKind::ModalPreserved:
    return isRefuted ? fmt::format("`{}` is not kept", obligation.claim)
                     : fmt::format("it is not known whether `{}` is always kept", obligation.claim);
  case ObligationKind::Guarded:
    return isRefuted ? "a call outside the contract gets past the guards"
                     : "it is not known whether the guards stop every call outside the contract";
  case ObligationKind::CallMeetsContract:
    return isRefuted ? "this call breaks what the called program relies on"
                     : "it is not known whether this call always keeps to what the called program relies on";
  case ObligationKind::ContractSatisfiable: return "no call satisfies this contract";
  case ObligationKind::KeepIn:
    return isRefuted
               ? fmt::format("the tool leaves the region of `{}`", obligation.claim)
               : fmt::format("it is not known whether the tool always stays in the region of `{}`", obligation.claim);
  case ObligationKind::KeepOut:
    return isRefuted ? fmt::format("the tool enters the region of `{}`", obligation.claim)
                     : fmt::format("it is not known whether the tool always stays out of the region of `{}`",
                                   obligation.claim);
  case ObligationKind::Clearance:
  case ObligationKind::Travel:
  case ObligationKind::Limit:
    return isRefuted ? fmt::format("`{}` is not kept here", obligation.claim)
                     : fmt::format("it is not known whether `{}` is always kept here", obligation.claim);
  }
  FEEDHOLD_UNREACHABLE("the switch names every kind");
}

} // namespace feedhold
