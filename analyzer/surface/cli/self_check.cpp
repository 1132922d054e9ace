#include "surface/cli/self_check.h"

#include "dialects/registry.h"
#include "findings/session/session.h"
#include "proof/smt/solver.h"
#include "rules/registry.h"
#include "surface/evidence/evidence_check.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold {
namespace {

/// Cuts to #1 in steps of #2.  Its contract is kept by every call that meets it.
constexpr std::string_view kSteps = R"(O9901(SELF-CHECK)
(@REQUIRE #1 GE 10)
(@REQUIRE #1 LE 50)
(@REQUIRE #2 GE 1)
(@REQUIRE #2 LE 5)
(@ENSURE #100 GE #1)
#100=0
WHILE[#100 LT #1]DO1
#100=#100+#2
G01 Z-#100 F200.
END1
M99
)";

/// Divides by an argument that may be 0.
constexpr std::string_view kDivision = R"(O9902(SELF-CHECK)
#100=10/#1
M99
)";

KnownNames everything() { return {allDialects(), allRules()}; }

CheckOptions optionsFor(std::string_view text) {
  CheckOptions options;
  options.piped = PipedText{"self-check", std::string(text)};
  options.control.dialect = allDialects().dialects.front()->id;
  options.config.source = ConfigSource::None;
  options.jobs = 1;
  return options;
}

std::vector<std::string> rulesThatSpeak(std::string_view text) {
  std::vector<std::string> names;
  for (const CheckedFile &file : check(optionsFor(text), everything()).files)
    for (const Finding &finding : file.findings)
      if (isReported(finding, file))
        names.emplace_back(finding.rule->name);
  return names;
}

SelfCheckStep checkStep() {
  SelfCheckStep step{"check",
                     "a division by an argument that may be 0 is found, and nothing in a program without defects"};
  const std::vector<std::string> found = rulesThatSpeak(kDivision);
  const std::vector<std::string> none = rulesThatSpeak(kSteps);
  if (found != std::vector<std::string>{"unguarded-division"} || !none.empty())
    step.problem = fmt::format("found [{}] and [{}]", fmt::join(found, ", "), fmt::join(none, ", "));
  return step;
}

/// `#1` is 10 and `#2` is 3: cuts at 3, 6, 9 and 12.
SelfCheckStep runStep() {
  SelfCheckStep step{"run", "a run makes the movements that the control makes"};
  const CheckOptions options = optionsFor(kSteps);
  const auto project = loadProject(
      ProgramOptions{
          .path = "self-check", .piped = options.piped, .control = options.control, .config = options.config},
      everything());
  const std::optional<Callee> start = project ? startOf(*project.value(), std::nullopt) : std::nullopt;
  if (!start) {
    step.problem = project ? "the program is not found" : project.error().message;
    return step;
  }
  RunOptions given;
  given.variables.set(1, ConcreteValue::of(10));
  given.variables.set(2, ConcreteValue::of(3));
  const RunResult result = run(*project.value()->set, *start, given);
  std::vector<double> depths;
  for (const RecordedMove &move : result.moves)
    depths.push_back(move.move.end[2].number);
  if (result.end != RunEnd::Returned || depths != std::vector<double>{-3, -6, -9, -12})
    step.problem = fmt::format("it ends with {} after Z {}", nameOf(result.end), fmt::join(depths, " "));
  return step;
}

ProofsResult proofsOf(std::string_view text) {
  ProofOptions options{.files = optionsFor(text), .steps = KeepSteps::Yes};
  options.prove.arithmetic = prove::Arithmetic::Exact;
  options.prove.missing = MissingPrograms::DoAnything;
  options.prove.mayTakeFewPasses = false;
  return proveAll(options, everything());
}

std::vector<prove::Obligation> obligationsOf(const ProofsResult &proofs) {
  std::vector<prove::Obligation> all;
  for (const ProvedFile &file : proofs.files)
    for (const ProvedProgram &program : file.programs)
      all.insert(all.end(), program.proof.obligations.begin(), program.proof.obligations.end());
  return all;
}

std::string verdictsOf(const std::vector<prove::Obligation> &obligations) {
  std::string text;
  for (const prove::Obligation &obligation : obligations)
    text += fmt::format("{}{}: {}", text.empty() ? "" : ", ", obligation.id, prove::nameOf(obligation.verdict.kind()));
  return text;
}

SelfCheckStep proveStep(const ProofsResult &proofs) {
  SelfCheckStep step{"prove", "a loop ends and a contract is kept for every call, without a solver"};
  const std::vector<prove::Obligation> all = obligationsOf(proofs);
  const bool allCertified = std::ranges::all_of(all, [](const prove::Obligation &obligation) {
    return obligation.verdict == prove::Verdict::Proved && obligation.verdict.grade() == prove::Grade::Certified;
  });
  if (all.size() != 3 || !allCertified)
    step.problem = verdictsOf(all);
  return step;
}

SelfCheckStep refuteStep() {
  SelfCheckStep step{"refute", "a call that stops the control is found, and its run stops"};
  const std::vector<prove::Obligation> all = obligationsOf(proofsOf(kDivision));
  const auto stops = std::ranges::count_if(all, [](const prove::Obligation &obligation) {
    const prove::Witness *witness = obligation.verdict.witness();
    return witness != nullptr && witness->end == RunEnd::Alarm;
  });
  if (stops != 1)
    step.problem = verdictsOf(all);
  return step;
}

std::size_t verifiedIn(const Bundle &bundle) {
  const std::vector<Question> questions = checkEvidence(bundle, {AskSolvers::WhereNeeded, 1});
  return static_cast<std::size_t>(std::ranges::count_if(
      questions, [](const Question &question) { return question.isFollowed && question.holds(); }));
}

/// The certificates of other questions: each the one of its neighbour.
Bundle exchanged(const Bundle &bundle) {
  Bundle result = bundle;
  std::string *last = nullptr;
  for (auto &[name, text] : result)
    if (name.ends_with(".certificate")) {
      if (last != nullptr)
        std::swap(*last, text);
      last = &text;
    }
  return result;
}

SelfCheckStep certificateStep(const ProofsResult &proofs) {
  SelfCheckStep step{"certificate",
                     "the checker verifies every certificate, and rejects certificates of other questions"};
  const Bundle bundle = makeBundle(proofs, {}, FEEDHOLD_VERSION, "/");
  const auto all = static_cast<std::size_t>(
      std::ranges::count_if(bundle, [](const auto &file) { return file.first.ends_with(".certificate"); }));
  const std::size_t verified = verifiedIn(bundle);
  const std::size_t wrong = verifiedIn(exchanged(bundle));
  if (all == 0 || verified != all || wrong == all)
    step.problem = fmt::format("{} of {} are verified, and {} of the wrong ones", verified, all, wrong);
  return step;
}

constexpr std::string_view kNoSquare =
    "(set-logic QF_NRA)\n(declare-const x Real)\n(assert (< (* x x) 0.0))\n(check-sat)\n";
constexpr std::string_view kSquare =
    "(set-logic QF_NRA)\n(declare-const x Real)\n(assert (= (* x x) 4.0))\n(check-sat)\n";
constexpr std::uint64_t kResources = 1'000'000;

template <typename Ask> SelfCheckStep solverStep(std::string name, const std::optional<std::string> &version, Ask ask) {
  if (!version)
    return {std::move(name), "not installed: claims that no certificate settles stay unknown", {}, true};
  SelfCheckStep step{std::move(name), *version + " refutes what has no solution, and not what has one"};
  const bool refutes = ask(std::string(kNoSquare)).isUnsat();
  const bool refutesWrongly = ask(std::string(kSquare)).isUnsat();
  if (!refutes || refutesWrongly)
    step.problem = refutes ? "it refutes what has a solution" : "it does not refute what has no solution";
  return step;
}

} // namespace

std::vector<SelfCheckStep> selfCheck() {
  const ProofsResult proofs = proofsOf(kSteps);
  const auto z3 = [](const std::string &text) { return smt::askZ3(text, smt::Arithmetic::Nonlinear, kResources); };
  const auto cvc5 = [](const std::string &text) { return smt::askCvc5(text, kResources); };
  return {checkStep(),
          runStep(),
          proveStep(proofs),
          refuteStep(),
          certificateStep(proofs),
          solverStep("z3", smt::z3Version(), z3),
          solverStep("cvc5", smt::cvc5Version(), cvc5)};
}

} // namespace feedhold
