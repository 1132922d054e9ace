#include "proof/family/known_answers.h"

#include "base/support/parallel.h"
#include "dialects/registry.h"
#include "language/parse/parse.h"
#include "meaning/cfg/program_set.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::proof_tests {

using prove::Obligation;
using prove::ObligationKind;
using prove::Verdict;

namespace {

constexpr std::uint64_t kTrialFuel = 5'000;
constexpr std::uint64_t kShownFuel = 100'000;

class LoadedProgram {
public:
  explicit LoadedProgram(const KnownProgram &known)
      : dialect_(*findDialect(allDialects(), "fanuc-30i")), source_(SourceFile::fromText(known.name, known.text)),
        tree_(parse(source_, dialect_)), model_(resolve(source_, tree_, dialect_)),
        contracts_(readContracts(source_, tree_, model_, dialect_)),
        set_({{FileId(0), &source_, &tree_, &model_, &dialect_}}, CallGraph({{FileId(0), "", "", &model_}})) {}
  LoadedProgram(const LoadedProgram &) = delete;
  LoadedProgram &operator=(const LoadedProgram &) = delete;

  bool isClean() const { return tree_.issues.empty() && contracts_.issues.empty() && !model_.programs.empty(); }
  prove::ProgramProof proof() const {
    return prove::prove(set_, entry(), &contracts_, {.guards = prove::InferGuards::No});
  }
  RunResult runOn(const Inputs &inputs, std::uint64_t fuel) const {
    RunOptions options;
    for (const auto &[variable, value] : inputs)
      options.variables.set(variable, ConcreteValue::of(value));
    options.fuel = fuel;
    return run(set_, entry(), options);
  }

private:
  Callee entry() const { return {FileId(0), set_.file(FileId(0)).cfg.entryOf(ProgramId(0)), ProgramId(0)}; }

  const Dialect &dialect_;
  SourceFile source_;
  SyntaxTree tree_;
  ProgramModel model_;
  FileContracts contracts_;
  ProgramSet set_;
};

std::string toString(const Inputs &inputs) {
  std::string text;
  for (const auto &[variable, value] : inputs)
    text += fmt::format(" #{}={}", variable, value);
  return text.empty() ? " nothing" : text;
}

bool stopsAt(const Obligation &claim, const RunResult &result) {
  return claim.place == result.place && claim.span == result.alarmSpan;
}

bool isEnd(ObligationKind kind) { return kind == ObligationKind::LoopEnds || kind == ObligationKind::ProgramEnds; }

/// Which of several loops a run does not leave is not looked at.
bool hasEndless(const KnownProgram &known) {
  return std::any_of(known.answers.begin(), known.answers.end(), [](const KnownAnswer &answer) {
    return answer.verdict == Verdict::Refuted && answer.claim.find("-ends") != std::string::npos;
  });
}

bool breaks(const Obligation &claim, const RunResult &result) {
  switch (claim.kind) {
  case ObligationKind::LoopEnds:
  case ObligationKind::ProgramEnds: return result.end == RunEnd::Repeats || result.end == RunEnd::Fuel;
  case ObligationKind::AlarmUnreachable: return result.end == RunEnd::UserAlarm && stopsAt(claim, result);
  case ObligationKind::NoControlAlarm:
    return result.end == RunEnd::Alarm && claim.alarm == result.alarm && stopsAt(claim, result);
  case ObligationKind::Compensation: return result.end == RunEnd::Alarm && result.compensation == claim.place;
  case ObligationKind::AlarmIff:
  case ObligationKind::Ensures:
  case ObligationKind::Assigns:
  case ObligationKind::ModalPreserved:
  case ObligationKind::Guarded:
  case ObligationKind::CallMeetsContract:
  case ObligationKind::ContractSatisfiable:
  case ObligationKind::KeepIn:
  case ObligationKind::KeepOut:
  case ObligationKind::Clearance:
  case ObligationKind::Travel:
  case ObligationKind::Limit: return false;
  }
  FEEDHOLD_UNREACHABLE("the switch names every kind");
}

/// Of the obligations that one claim is about: those that a run breaks.
std::vector<const Obligation *> broken(const std::vector<const Obligation *> &claims, const RunResult &result) {
  std::vector<const Obligation *> found;
  for (const Obligation *claim : claims)
    if (breaks(*claim, result))
      found.push_back(claim);
  return found;
}

/// Several when a block can stop in several ways: `no-control-alarm.N50`, `no-control-alarm.N50.2`.
std::vector<const Obligation *> obligationsOf(const prove::ProgramProof &proof, const std::string &claim) {
  std::vector<const Obligation *> found;
  for (const Obligation &each : proof.obligations) {
    const std::string id = each.id.substr(each.id.find('.') + 1);
    if (id == claim || id.starts_with(claim + "."))
      found.push_back(&each);
  }
  return found;
}

/// Why the answer cannot be right; empty when runs agree with it.
std::string contradiction(const LoadedProgram &loaded, const KnownProgram &known,
                          const std::vector<const Obligation *> &claims) {
  if (isEnd(claims.front()->kind) && hasEndless(known))
    return "";
  for (const Inputs &trial : known.trials) {
    const RunResult result = loaded.runOn(trial, kTrialFuel);
    if (result.end != RunEnd::Fuel && !broken(claims, result).empty())
      return fmt::format("known to be proved, but is broken by{}", toString(trial));
  }
  return "";
}

Verdict::Kind plain(const Verdict &verdict) {
  return verdict == Verdict::Unreachable ? Verdict::Proved : verdict.kind();
}

void compare(const LoadedProgram &loaded, const prove::ProgramProof &proof, const KnownProgram &known,
             const KnownAnswer &answer, Comparison &into) {
  const std::string name = fmt::format("{} {}", known.name, answer.claim);
  std::vector<const Obligation *> claims = obligationsOf(proof, answer.claim);
  if (claims.empty()) {
    into.undecided.push_back(name + ": there is no such obligation");
    return;
  }
  if (answer.verdict == Verdict::Refuted) {
    claims = broken(claims, loaded.runOn(answer.shownBy, kShownFuel));
    if (claims.empty())
      into.wrong.push_back(
          fmt::format("{}: known to be refuted, but is not broken by{}", name, toString(answer.shownBy)));
  } else if (const std::string why = contradiction(loaded, known, claims); !why.empty()) {
    into.wrong.push_back(fmt::format("{}: {}", name, why));
    return;
  }
  Comparison verdicts;
  for (const Obligation *claim : claims)
    if (claim->verdict == Verdict::Unknown)
      verdicts.undecided.push_back(
          fmt::format("{}: {}, not known to be {}", name, claim->verdict.reason(), nameOf(answer.verdict)));
    else if (plain(claim->verdict) != answer.verdict)
      verdicts.wrong.push_back(
          fmt::format("{}: {}, but is known to be {}", name, nameOf(claim->verdict), nameOf(answer.verdict)));
  if (!verdicts.wrong.empty())
    into.wrong.push_back(verdicts.wrong.front());
  else if (!verdicts.undecided.empty())
    into.undecided.push_back(verdicts.undecided.front());
  else if (!claims.empty())
    ++into.right;
}

Comparison compareOne(const KnownProgram &known) {
  Comparison result{.programs = 1};
  const LoadedProgram loaded(known);
  if (!loaded.isClean()) {
    result.wrong.push_back(known.name + ": the text has mistakes");
    return result;
  }
  const prove::ProgramProof proof = loaded.proof();
  for (const KnownAnswer &answer : known.answers)
    compare(loaded, proof, known, answer, result);
  return result;
}

} // namespace

Comparison compareWithVerdicts(std::span<const KnownProgram> programs) {
  std::vector<Comparison> each(programs.size());
  parallelFor(programs.size(), 0, [&](std::size_t i) { each[i] = compareOne(programs[i]); });
  Comparison all;
  for (const Comparison &one : each) {
    all.programs += one.programs;
    all.right += one.right;
    all.undecided.insert(all.undecided.end(), one.undecided.begin(), one.undecided.end());
    all.wrong.insert(all.wrong.end(), one.wrong.begin(), one.wrong.end());
  }
  return all;
}

std::string summary(const Comparison &comparison) {
  std::string text;
  for (const std::string &line : comparison.undecided)
    text += "undecided: " + line + "\n";
  for (const std::string &line : comparison.wrong)
    text += "wrong: " + line + "\n";
  return text + fmt::format("{} programs, {} claims: {} right, {} undecided, {} wrong; {} % decided\n",
                            comparison.programs, comparison.claims(), comparison.right, comparison.undecided.size(),
                            comparison.wrong.size(), comparison.decidedPercent());
}

} // namespace feedhold::proof_tests
