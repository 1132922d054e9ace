#include "proof/sample_proofs.h"

#include "meaning/cfg/wto.h"
#include "proof/contract_run.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace feedhold::proof_tests {

using prove::Obligation;
using prove::ObligationKind;
using prove::Verdict;
using soundness::EntryValues;
using soundness::LoadedSample;
using soundness::Random;
using soundness::Sample;

namespace {

constexpr std::uint64_t kFuel = 3'000;
constexpr std::uint64_t kMuchFuel = 300'000;

bool holds(const Obligation &obligation) {
  return obligation.verdict == Verdict::Proved || obligation.verdict == Verdict::Unreachable;
}

bool hasEnded(RunEnd end) {
  return end == RunEnd::M02 || end == RunEnd::M30 || end == RunEnd::Returned || end == RunEnd::EndOfFile;
}

void makeExact(EntryValues &entry) {
  const auto exact = [](ConcreteValue &value) { value.number = std::round(value.number * 8) / 8; };
  for (auto &given : entry.given.entries())
    exact(given.second);
  forEachValue(entry.state, exact);
}

class ProvedProgram {
public:
  ProvedProgram(const LoadedSample &machine, const LoadedSample &analysed, const FileContracts &contracts,
                ProgramId program)
      : machine_(machine), analysed_(analysed), callee_{FileId(0), file().cfg.entryOf(program), program},
        contract_(machine, contracts, contracts.of(program)), wto_(file().cfg, *file().model, callee_.entry) {
    prove::ProveOptions options;
    options.budget = smallBudget();
    options.guards = prove::InferGuards::No;
    proof_ = prove::prove(analysed.set, callee_, &contracts, options);
  }

  void count(ProofTally &tally) const {
    ++tally.programs;
    tally.incomplete += proof_.incomplete ? 1 : 0;
    for (const Obligation &obligation : proof_.obligations) {
      ++tally.obligations;
      tally.proved += holds(obligation) ? 1 : 0;
      tally.refuted += obligation.verdict == Verdict::Refuted ? 1 : 0;
    }
  }

  /// Claims that are not proved, with what is said of them.
  std::size_t explained() const {
    return static_cast<std::size_t>(
        std::count_if(proof_.obligations.begin(), proof_.obligations.end(), [](const Obligation &each) {
          return !holds(each) && (each.verdict.witness() || !each.verdict.reason().empty());
        }));
  }

  /// A witness that the machine does not run to what is said of it.
  std::optional<std::string> idleWitness() const {
    for (const Obligation &obligation : proof_.obligations) {
      if (!obligation.verdict.witness())
        continue;
      RunOptions options;
      options.variables = obligation.verdict.witness()->variables;
      options.fuel = kMuchFuel;
      const ModalTable modes(analysed_.dialect());
      EntryValues entry{startState(ConcreteInterpretation(analysed_.dialect(), options.variables), modes, {}),
                        options.variables};
      contract_.prepare(entry);
      if (obligation.kind != ObligationKind::Guarded && !contract_.allows(entry))
        return fmt::format("{}: the contract does not allow the witness", obligation.id);
      options.state = entry.state;
      const RunResult result = feedhold::run(analysed_.set, callee_, options);
      if (!shows(obligation, result) && !leavesDoubles(options))
        return fmt::format("{}: the witness comes to {} at {}", obligation.id, nameOf(result.end), at(result.place));
    }
    return std::nullopt;
  }

  std::optional<std::string> run(const SampleKind &kind, Random &random, ProofTrial &trial) const {
    ProofTally &tally = trial.tally;
    EntryValues entry = kind.entry(machine_, random);
    if (!random.oneIn(4))
      contract_.draw(entry, random);
    makeExact(entry);
    contract_.prepare(entry);
    const bool allowed = contract_.allows(entry);
    Passes passes;
    std::uint64_t moments = 0;
    RunOptions options;
    options.variables = entry.given;
    options.state = entry.state;
    options.fuel = kFuel;
    options.blockSkip = random.oneIn(2) ? BlockSkipSwitch::On : BlockSkipSwitch::Off;
    options.trace = [&](const RunMoment &moment) {
      if (moment.depth == 0) {
        ++passes[moment.place].times;
        passes[moment.place].last = ++moments;
      }
    };
    RunResult result = feedhold::run(machine_.set, callee_, options);
    if (!allowed)
      return guarded(result);
    ++tally.runs;
    if (result.end == RunEnd::Fuel && isProved(ObligationKind::ProgramEnds)) {
      options.fuel = kMuchFuel;
      passes.clear();
      result = feedhold::run(machine_.set, callee_, options);
      tally.stillRunning += result.end == RunEnd::Fuel ? 1 : 0;
    }
    trial.ends.push_back(endOf(entry, result));
    std::optional<std::string> why = promise(entry, result);
    if (!why)
      why = tooManyPasses(entry, passes, tally);
    if (!why && (result.end == RunEnd::Alarm || result.end == RunEnd::UserAlarm))
      why = stop(result);
    if (!why && result.end == RunEnd::Repeats)
      why = repetition(result, passes, moments);
    return why && !leavesDoubles(options) ? why : std::nullopt;
  }

private:
  /// How often a run came to a place of the program itself, and when it did so last.
  struct Visits {
    std::uint64_t times = 0;
    std::uint64_t last = 0;
  };
  using Passes = std::map<Place, Visits>;

  const ProgramFile &file() const { return machine_.set.file(FileId(0)); }
  std::string at(Place place) const { return machine_.blockOf(place); }
  bool isProved(ObligationKind kind) const {
    return std::any_of(proof_.obligations.begin(), proof_.obligations.end(),
                       [&](const Obligation &each) { return each.kind == kind && holds(each); });
  }

  /// How the run ended, and whether it broke a promise.
  std::string endOf(const EntryValues &entry, const RunResult &result) const {
    std::string text(nameOf(result.end));
    if (result.end == RunEnd::UserAlarm)
      text += fmt::format(" {}", result.alarmNumber);
    if (result.end == RunEnd::Alarm)
      text += fmt::format(" {}", meaningOf(result.alarm));
    for (const Obligation &obligation : proof_.obligations)
      if (contract_.broken(obligation, entry, result))
        text += fmt::format(", {} is broken", obligation.claim);
    return text;
  }

  /// Some number becomes so large or so small that the run is not what exact numbers would do.
  bool leavesDoubles(RunOptions options) const {
    bool found = false;
    options.trace = [&](const RunMoment &moment) {
      forEachValue(moment.state, [&found](const ConcreteValue &value) {
        const double size = std::fabs(value.number);
        found = found || std::isnan(size) || size > 1e12 || (size != 0 && size < 1e-12);
      });
    };
    feedhold::run(machine_.set, callee_, options);
    return found;
  }

  bool shows(const Obligation &obligation, const RunResult &result) const {
    const bool here = result.place == obligation.place && result.alarmSpan == obligation.span;
    switch (obligation.kind) {
    case ObligationKind::AlarmUnreachable:
      return here && result.end == RunEnd::UserAlarm && !contract_.foresees(result.alarmNumber);
    case ObligationKind::NoControlAlarm:
      return here && result.end == RunEnd::Alarm && result.alarm == *obligation.alarm;
    case ObligationKind::Compensation: return result.end == RunEnd::Alarm && result.compensation == obligation.place;
    case ObligationKind::LoopEnds:
    case ObligationKind::ProgramEnds: return result.end == RunEnd::Repeats || result.end == RunEnd::Fuel;
    case ObligationKind::Guarded: return !result.moves.empty() || hasEnded(result.end);
    case ObligationKind::AlarmIff:
    case ObligationKind::Ensures:
    case ObligationKind::Assigns:
    case ObligationKind::ModalPreserved:
    case ObligationKind::CallMeetsContract:
    case ObligationKind::ContractSatisfiable:
    case ObligationKind::KeepIn: // random programs with such clauses: space_proofs.h
    case ObligationKind::KeepOut:
    case ObligationKind::Clearance:
    case ObligationKind::Travel:
    case ObligationKind::Limit: return true;
    }
    return true;
  }

  std::optional<std::string> stop(const RunResult &result) const {
    if (file().model->programOf(machine_.set.node(result.place).block) != callee_.program)
      return std::nullopt;
    const bool own = result.end == RunEnd::UserAlarm;
    if (own && contract_.foresees(result.alarmNumber))
      return std::nullopt; // the clause that foresees it is judged by itself
    const std::string noAlarm = fmt::format("no {} here", meaningOf(result.alarm));
    for (const Obligation &obligation : proof_.obligations)
      if (obligation.kind == (own ? ObligationKind::AlarmUnreachable : ObligationKind::NoControlAlarm) &&
          obligation.place == result.place && obligation.span == result.alarmSpan &&
          (own || obligation.claim == noAlarm)) {
        if (!holds(obligation))
          return std::nullopt;
        return fmt::format("{} is {} ({}), and is raised at {}", obligation.id, nameOf(obligation.verdict),
                           obligation.claim, at(result.place));
      }
    if (proof_.incomplete)
      return std::nullopt;
    return fmt::format("nothing is claimed of the stop at {}", at(result.place));
  }

  std::optional<std::string> repetition(const RunResult &result, const Passes &passes, std::uint64_t moments) const {
    for (const Obligation &obligation : proof_.obligations)
      if (holds(obligation) && (obligation.kind == ObligationKind::ProgramEnds ||
                                (obligation.kind == ObligationKind::LoopEnds &&
                                 goesRoundIn(obligation.place.node, result, passes, moments))))
        return fmt::format("{} is {}, and the run comes back to {}", obligation.id, nameOf(obligation.verdict),
                           at(result.place));
    return std::nullopt;
  }
  /// What goes round may be a loop around this one: then the head of that has been passed not long ago.
  bool goesRoundIn(NodeId head, const RunResult &result, const Passes &passes, std::uint64_t moments) const {
    if (!result.calls.empty() || result.place != Place{FileId(0), head})
      return false;
    return std::none_of(passes.begin(), passes.end(), [&](const auto &visited) {
      const auto &[place, visits] = visited;
      return place.node != head && isInside(head, place.node) && visits.last * 2 > moments;
    });
  }

  std::optional<std::string> promise(const EntryValues &entry, const RunResult &result) const {
    for (const Obligation &obligation : proof_.obligations)
      if (holds(obligation))
        if (const auto why = contract_.broken(obligation, entry, result))
          return fmt::format("{} ({}) is {}: {}", obligation.id, obligation.claim, nameOf(obligation.verdict), *why);
    return std::nullopt;
  }
  /// Of a run that starts outside of the contract.
  std::optional<std::string> guarded(const RunResult &result) const {
    if (isProved(ObligationKind::Guarded) && (!result.moves.empty() || hasEnded(result.end)))
      return fmt::format("a call outside of the contract comes to {} after {} moves", nameOf(result.end),
                         result.moves.size());
    return std::nullopt;
  }

  std::optional<std::string> tooManyPasses(const EntryValues &entry, const Passes &passes, ProofTally &tally) const {
    for (const Obligation &obligation : proof_.obligations) {
      const auto seen = passes.find(obligation.place);
      if (obligation.verdict.bound().empty() || !holds(obligation) || seen == passes.end() ||
          isNested(obligation.place.node))
        continue;
      const std::optional<double> most = valueAtEntry(std::string(obligation.verdict.bound()), entry);
      ++tally.bounded;
      if (!most && seen->second.times == 1) // a quotient by a step of 0, where no pass is made
        continue;
      if (!most || std::max(*most, 0.0) + 1 < static_cast<double>(seen->second.times))
        return fmt::format("{}: at most {} = {} passes, and the run comes there {} times", obligation.id,
                           obligation.verdict.bound(), most.value_or(-1), seen->second.times);
    }
    return std::nullopt;
  }
  bool isNested(NodeId head) const {
    return std::any_of(wto_.order().begin(), wto_.order().end(),
                       [&](NodeId other) { return other != head && isInside(head, other); });
  }
  bool isInside(NodeId node, NodeId head) const {
    const std::uint32_t position = wto_.positionOf(node);
    return wto_.isHead(head) && wto_.positionOf(head) <= position && position < wto_.endOf(head);
  }
  /// By a program that works it out.
  std::optional<double> valueAtEntry(const std::string &expression, const EntryValues &entry) const {
    const LoadedSample program({"O1", "#149=" + expression, "M99"}, machine_.dialect());
    RunOptions options;
    options.variables = entry.given;
    options.state = entry.state;
    const RunResult result = feedhold::run(program.set, program.main(), options);
    const ConcreteValue *value = result.state.variables.find(149);
    return value ? std::optional(value->number) : std::nullopt;
  }

  const LoadedSample &machine_;
  const LoadedSample &analysed_;
  Callee callee_;
  ContractOnRun contract_;
  Wto wto_;
  prove::ProgramProof proof_;
};

} // namespace

ProofTally &ProofTally::operator+=(const ProofTally &other) {
  programs += other.programs;
  incomplete += other.incomplete;
  obligations += other.obligations;
  proved += other.proved;
  refuted += other.refuted;
  runs += other.runs;
  bounded += other.bounded;
  stillRunning += other.stillRunning;
  return *this;
}

prove::Budget smallBudget() { return {.search = 40'000, .z3 = 0, .cvc5 = 0}; }

Sample exactSample(Sample sample) {
  constexpr std::pair<std::string_view, std::string_view> kNear[] = {
      {"0.1", "0.125"}, {".001", ".125"}, {"0.3", "0.375"}, {"-.1", "-.125"}};
  for (std::string &line : sample.lines)
    for (const auto &[inexact, exact] : kNear)
      for (std::size_t found = line.find(inexact); found != std::string::npos; found = line.find(inexact, found + 1)) {
        const std::size_t end = found + inexact.size();
        const bool whole = (end == line.size() || std::isdigit(static_cast<unsigned char>(line[end])) == 0) &&
                           (found == 0 || std::isdigit(static_cast<unsigned char>(line[found - 1])) == 0);
        if (whole)
          line.replace(found, inexact.size(), exact);
      }
  return sample;
}

ProofTrial tryProofs(const SampleKind &kind, const Sample &sample, std::uint64_t inputSeed, int runs) {
  Random random(inputSeed);
  const LoadedSample analysed(sample.lines, controlOf(sample));
  const LoadedSample machine(sample.lines, machineOf(sample, random));
  const FileContracts contracts =
      readContracts(analysed.source(), analysed.tree(), analysed.model(), analysed.dialect());
  ProofTrial trial;
  for (ProgramId id(0); id.index() < analysed.model().programs.size(); id = id.next()) {
    const ProvedProgram proved(machine, analysed, contracts, id);
    proved.count(trial.tally);
    trial.explained += proved.explained();
    trial.wrong = proved.idleWitness();
    for (int i = 0; i < runs && !trial.wrong; ++i)
      trial.wrong = proved.run(kind, random, trial);
    if (trial.wrong)
      break;
  }
  return trial;
}

std::optional<std::string> brokenClaim(const SampleKind &kind, const Sample &sample, std::uint64_t inputSeed, int runs,
                                       ProofTally &tally) {
  const ProofTrial trial = tryProofs(kind, sample, inputSeed, runs);
  tally += trial.tally;
  return trial.wrong;
}

Sample leastBroken(const SampleKind &kind, Sample sample, std::uint64_t inputSeed, int runs) {
  bool smaller = true;
  while (smaller) {
    smaller = false;
    for (std::size_t count = sample.lines.size() / 2; count > 0; count /= 2)
      for (std::size_t at = 0; at + count <= sample.lines.size();) {
        Sample fewer = sample;
        const auto first = fewer.lines.begin() + static_cast<std::ptrdiff_t>(at);
        fewer.lines.erase(first, first + static_cast<std::ptrdiff_t>(count));
        ProofTally tally;
        if (!fewer.lines.empty() && brokenClaim(kind, fewer, inputSeed, runs, tally)) {
          sample = std::move(fewer);
          smaller = true;
        } else {
          ++at;
        }
      }
  }
  return sample;
}

} // namespace feedhold::proof_tests
