#include "surface/sink/ranges_facts.h"

#include "language/dialect/code_name.h"

#include "inference/absint/describe.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace feedhold {

namespace {

bool isAnything(const AbstractValue &value) {
  return value.mayBeVacant() && value.mayBeNumber() && value.number() == AbstractNumber::any();
}
bool isAnyNumber(const AbstractValue &value) { return value.isNumber() && value.number() == AbstractNumber::any(); }
bool isConstant(const AbstractValue &value, double constant) {
  return value.isNumber() && value.number().constantValue() == constant;
}

constexpr std::initializer_list<CodeAction> kCycles = {
    CodeAction::CycleDrill,    CodeAction::CycleDwell,      CodeAction::CyclePeck,      CodeAction::CycleChipBreak,
    CodeAction::CycleTap,      CodeAction::CycleTapLeft,    CodeAction::CycleBore,      CodeAction::CycleBoreStop,
    CodeAction::CycleBackBore, CodeAction::CycleBoreManual, CodeAction::CycleBoreDwell, CodeAction::CycleFineBore,
    CodeAction::SideCycle};

class FactWriter {
public:
  FactWriter(const AbstractState &state, const ContextStates &context, const ProgramSet &programs,
             const ModalTable &modes, const std::bitset<kLocalVariables + 1> &mentioned)
      : state_(state), context_(context), programs_(programs), modes_(modes), mentioned_(mentioned) {}

  StateFacts write() {
    variables();
    for (const Axis axis : kAllAxes)
      add(facts_.positions, std::string(1, letterOf(axis)), state_.at(axis), symbolOfPosition(indexOf(axis)), true);
    groups();
    spindle();
    words();
    cycle();
    offsets();
    mappings();
    modalCalls();
    return std::move(facts_);
  }

private:
  // ---- values ----

  void variables() {
    for (std::uint32_t local = 1; local <= kLocalVariables; ++local) {
      const AbstractValue &value = state_.locals[local];
      if (mentioned_[local] || !(value.isVacant() || isAnything(value)))
        variable(local, value);
    }
    for (const auto &[number, value] : state_.variables.entries())
      variable(number, value);
    facts_.othersAreUnknown = !state_.havocked.empty();
  }
  void variable(std::uint32_t number, const AbstractValue &value) {
    const VariableRange *range =
        number < kFirstNamedVariable ? findVariable(*programs_.file(context_.file).dialect, number) : nullptr;
    const bool isCell = range && range->kind == VariableKind::System; // holds some number at any time
    const bool isOwn = number > kLocalVariables || sharesLocals();
    add(facts_.variables, programs_.nameOfVariable(number), value,
        isOwn ? std::optional(symbolOfVariable(number)) : std::nullopt, isCell);
  }
  /// Its locals are those of the program that was started.
  bool sharesLocals() const {
    return std::all_of(context_.calls.begin(), context_.calls.end(), [&](Place place) {
      const auto *node = std::get_if<CallProgram>(&programs_.node(place).instruction);
      if (!node)
        return false; // a modal call
      const CallKind kind = programs_.file(place.file).model->calls[node->call].kind;
      return kind == CallKind::Subprogram || kind == CallKind::Local || kind == CallKind::External;
    });
  }
  /// Unless it is as it was at the start, when nothing was known of it but perhaps that it is a number.  `own`: the
  /// symbol of the thing itself at the start.
  void add(std::vector<ValueFact> &facts, std::string name, const AbstractValue &value,
           std::optional<std::uint32_t> own, bool isAlwaysNumber) {
    const bool asAtStart = own && value.origin() == Origin{*own, Rational()};
    if (asAtStart && (isAnything(value) || (isAlwaysNumber && isAnyNumber(value))))
      return;
    auto relation = relationOf(name, value);
    if (relation && asAtStart)
      relation->isItself = true;
    facts.push_back({std::move(name), value, std::move(relation), isAlwaysNumber});
  }
  /// To the start, or to the first value of the same symbol.
  std::optional<KnownRelation> relationOf(const std::string &name, const AbstractValue &value) {
    if (!value.origin() || value.origin()->symbol == kZeroSymbol)
      return std::nullopt;
    const Origin &origin = *value.origin();
    const bool isKnown = value.isVacant() || (value.isNumber() && value.number().isConstant());
    if (isEntrySymbol(origin.symbol)) {
      auto start = nameAtStart(origin.symbol);
      if (!start || isKnown)
        return std::nullopt;
      return KnownRelation{std::move(*start), KnownRelation::Time::AtStart, origin.offset.toDouble()};
    }
    const auto [first, isNew] = firstOf_.emplace(origin.symbol, std::pair{name, origin.offset});
    const auto offset = subtract(origin.offset, first->second.second);
    if (isNew || isKnown || !offset)
      return std::nullopt;
    return KnownRelation{first->second.first, KnownRelation::Time::Now, offset->toDouble()};
  }
  std::optional<std::string> nameAtStart(std::uint32_t symbol) const {
    if (symbol >= kWordSymbols)
      return std::string(1, kModalWords[symbol - kWordSymbols]);
    if (symbol >= kModalSymbols)
      return fmt::format("the {} code", nameOfGroup(symbol - kModalSymbols));
    if (symbol >= kPositionSymbols)
      return std::string(1, kAxisLetters[symbol - kPositionSymbols]);
    const std::string name = programs_.nameOfVariable(symbol);
    if (context_.calls.empty() || symbol > kLocalVariables)
      return name;
    const ProgramModel &model = *programs_.file(context_.start.file).model;
    return fmt::format("{} of {}", name, toString(model.programs[context_.start.program].name));
  }

  // ---- modes ----

  std::string nameOfGroup(std::size_t group) const {
    for (std::size_t kind = 0; kind < kModalKinds; ++kind)
      if (modes_.groupOf(static_cast<ModalKind>(kind)) == group)
        return std::string(nameOf(static_cast<ModalKind>(kind)));
    return fmt::format("group {}", group);
  }
  void groups() {
    for (std::size_t group = 1; group < kModalGroups; ++group) {
      const CodeSet &codes = state_.codes[group];
      const auto &rows = modes_.group(group).codes;
      const bool isAssumed = modes_.groupOf(ModalKind::Polar) == group && codes.isSingle() && isPolarOff(codes);
      if (rows.empty() || codes == CodeSet::atEntry() || isAssumed || modes_.groupOf(ModalKind::ModalCall) == group)
        continue;
      ModeFact fact{nameOfGroup(group), {}, codes.mayBeAtEntry()};
      for (std::size_t i = 0; i < rows.size(); ++i)
        if (codes.contains(i))
          fact.codes.push_back(codeName('G', rows[i]->tenths));
      fact.isAnyCode = fact.codes.size() == rows.size();
      facts_.modes.push_back(std::move(fact));
    }
  }
  /// So it is taken to be at the start.
  bool isPolarOff(const CodeSet &codes) const {
    return (codes.codes() & ~modes_.maskOf(ModalKind::Polar, {CodeAction::PolarOff})) == 0;
  }
  void spindle() {
    constexpr std::array kCodes = {"M05", "M03", "M04"};
    static_assert(kCodes.size() == kSpindleActions.size());
    if (state_.spindle == CodeSet::atEntry())
      return;
    ModeFact fact{"spindle", {}, state_.spindle.mayBeAtEntry()};
    for (std::size_t i = 0; i < kCodes.size(); ++i)
      if (state_.spindle.contains(i))
        fact.codes.emplace_back(kCodes[i]);
    fact.isAnyCode = fact.codes.size() == kCodes.size();
    facts_.modes.push_back(std::move(fact));
  }
  void modalCalls() {
    for (const auto &modal : state_.modalCalls) {
      const ProgramFile &file = programs_.file(FileId(modal.file));
      const Call &call = file.model->calls[CallId(modal.call)];
      facts_.modalCalls.push_back(
          fmt::format("{} in line {}", file.source->utf8(call.span), file.source->lineOf(call.span.begin)));
    }
    facts_.maybeOtherModalCalls = mayBeTrue(state_.modalCallsUnknown);
  }

  // ---- settings ----

  void known(std::string name, const AbstractValue &value) {
    if (!isAnything(value) && !isAnyNumber(value))
      setting(std::move(name), value);
  }
  void setting(std::string name, const AbstractValue &value) {
    auto relation = relationOf(name, value);
    facts_.settings.push_back({std::move(name), value, std::move(relation), true});
  }
  void words() {
    for (std::size_t i = 0; i < kModalWords.size(); ++i)
      add(facts_.settings, std::string(1, kModalWords[i]), state_.words[i],
          kWordSymbols + static_cast<std::uint32_t>(i), false);
  }
  void cycle() {
    const auto group = modes_.groupOf(ModalKind::Cycle);
    if (!group || (state_.codes[*group].codes() & modes_.maskOf(ModalKind::Cycle, kCycles)) == 0)
      return;
    known("cycle Z", state_.cycle.bottom);
    known("cycle R", state_.cycle.retract);
    known("cycle initial level", state_.cycle.initial);
    if (!state_.cycle.peck.isVacant())
      known("cycle Q", state_.cycle.peck);
    if (!state_.cycle.dwell.isVacant())
      known("cycle P", state_.cycle.dwell);
  }
  void offsets() {
    for (const Axis axis : kAllAxes) {
      known(fmt::format("G52 {}", letterOf(axis)), state_.local[indexOf(axis)]);
      known(fmt::format("G92 {}", letterOf(axis)), state_.shift[indexOf(axis)]);
    }
    known("length offset", state_.lengthOffset);
  }
  void mappings() {
    if (!mayBeTrue(state_.transformed))
      return;
    for (const Axis axis : kAllAxes) {
      const std::size_t i = indexOf(axis);
      if (!isConstant(state_.transform.scale[i], 1))
        setting(fmt::format("scale {}", letterOf(axis)), state_.transform.scale[i]);
      if (!state_.transform.mirrorAt[i].isVacant())
        setting(fmt::format("mirror at {}", letterOf(axis)), state_.transform.mirrorAt[i]);
    }
    if (!isConstant(state_.transform.angle, 0))
      setting("rotated by", state_.transform.angle);
  }

  const AbstractState &state_;
  const ContextStates &context_;
  const ProgramSet &programs_;
  const ModalTable &modes_;
  const std::bitset<kLocalVariables + 1> &mentioned_;
  std::map<std::uint32_t, std::pair<std::string, Rational>> firstOf_; // of a symbol: its first value
  StateFacts facts_;
};

std::string listed(const std::vector<std::string> &words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i)
    text += (i == 0 ? "" : i + 1 == words.size() ? " or " : ", ") + words[i];
  return text;
}

} // namespace

FactsOfStates::FactsOfStates(const ContextStates &context, const ProgramSet &programs)
    : context_(context), programs_(programs), modes_(*programs.file(context.file).dialect) {
  for (const VariableUse &use : programs.file(context.file).model->variablesOf(context.program))
    if (use.number && *use.number <= kLocalVariables)
      mentioned_.set(*use.number);
}

StateFacts FactsOfStates::at(const AbstractState &state) const {
  return FactWriter(state, context_, programs_, modes_, mentioned_).write();
}

std::string textOf(const KnownRelation &relation) {
  if (relation.isItself)
    return "as at start";
  const std::string_view at = relation.time == KnownRelation::Time::AtStart ? " at start" : "";
  if (relation.offset == 0)
    return fmt::format("= {}{}", relation.name, at);
  return fmt::format("= {}{} {} {:.10g}", relation.name, at, relation.offset < 0 ? '-' : '+',
                     std::fabs(relation.offset));
}

bool isUnknown(const ValueFact &fact) {
  return !fact.relation && (isAnything(fact.value) || (fact.isAlwaysNumber && isAnyNumber(fact.value)));
}

std::string textOf(const ValueFact &fact) {
  if (!fact.relation)
    return isUnknown(fact) ? "not known" : describe(fact.value);
  if ((isAnything(fact.value) || isAnyNumber(fact.value)) && !fact.relation->isItself)
    return textOf(*fact.relation);
  return fmt::format("{} ({})", describe(fact.value), textOf(*fact.relation));
}

std::string textOf(const ModeFact &fact) {
  if (fact.codes.empty())
    return "as at start";
  if (fact.isAnyCode)
    return "any code";
  return listed(fact.codes) + (fact.maybeAsAtStart ? ", or as at start" : "");
}

} // namespace feedhold
