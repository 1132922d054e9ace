#include "proof/families/space_runs.h"

#include "base/support/text.h"
#include "proof/space/plain_space.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace feedhold::prove {

namespace {

constexpr int kShownDecimals = 4; // a control shows three in millimetres and four in inches

std::string howFar(const SpaceRule &rule, double depth) {
  const std::string distance = depth < 1e-4 ? "less than 0.0001" : decimalText(depth, kShownDecimals);
  if (rule.kind == ObligationKind::KeepIn)
    return fmt::format("the tool is {} outside {}", distance, rule.name);
  if (rule.kind == ObligationKind::KeepOut)
    return fmt::format("the tool is {} inside {}", distance, rule.name);
  if (rule.kind == ObligationKind::Clearance)
    return fmt::format("a rapid move goes {} below the clearance height", distance);
  return rule.isOfMachine
             ? fmt::format("the axes are {} outside the range of the machine, in machine coordinates", distance)
             : fmt::format("the tool is {} outside the travel limits", distance);
}

/// In machine coordinates where the rule has these.
std::string textOf(const SpaceRule &rule, const geometry::Gouge &gouge, const RecordedMove &move, MachineKind machine) {
  std::array<std::string, 3> shown;
  for (std::size_t axis = 0; axis < shown.size(); ++axis)
    shown[axis] =
        decimalText(gouge.at[axis] + (rule.isOfMachine ? move.machineZero[axis] - move.zero[axis] : 0), kShownDecimals);
  const std::string tool = gouge.length
                               ? fmt::format(", with a tool of length {} in the spindle and no length in force",
                                             decimalText(*gouge.length, kShownDecimals))
                               : "";
  const std::string place = machine == MachineKind::Turning ? fmt::format("X{} Z{}", shown[0], shown[2])
                                                            : fmt::format("X{} Y{} Z{}", shown[0], shown[1], shown[2]);
  const std::string beside = gouge.beside > 0 ? fmt::format(", where it may be {} beside its path (`@CORNER`)",
                                                            decimalText(gouge.beside, kShownDecimals))
                                              : "";
  return fmt::format("{} at {}{}{}", howFar(rule, gouge.depth), place, tool, beside);
}

/// Of the coordinates, and of what is added to them on the way to machine coordinates.
double largestNumber(const std::vector<RecordedMove> &moves) {
  double largest = 0;
  for (const RecordedMove &each : moves)
    for (std::size_t axis = 0; axis < each.zero.size(); ++axis)
      for (const double number : {each.move.start[axis].number, each.move.end[axis].number, each.machineZero[axis]})
        largest = std::max(largest, std::fabs(number));
  return largest;
}

const geometry::PlainSpace &spaceOf(const ProofContext &context, const GivenVariables &given) {
  return context.witnesses.spaceOf(given, [&subject = context.subject](const RunOptions &run) {
    return plainSpace(subject.programs, subject.program, *subject.contracts, run);
  });
}

} // namespace

std::optional<geometry::Gouge> SpaceRuns::gougeIn(const RunResult &run, const GivenVariables &given) const {
  const auto gouge = geometry::deepestGouge(spaceOf(context_, given), claimOf(rule_), rule_.region, run.moves,
                                            [this](const RecordedMove &move) { return move.own == own_; });
  return gouge && gouge->depth >= leastDepth(run.moves) ? gouge : std::nullopt;
}

std::optional<double> SpaceRuns::tolerance() const {
  const ProofSubject &subject = context_.subject;
  return subject.options.arithmetic == Arithmetic::Exact
             ? std::nullopt
             : std::optional(toleranceOf(*subject.contract(), subject.dialect()).toDouble());
}

/// Less is the rounding of the machine's numbers, which grows with them, or within the tolerance, and no gouge.
double SpaceRuns::leastDepth(const std::vector<RecordedMove> &moves) const {
  constexpr double kRounding = 1e-6, kOfSize = 1e-9;
  return std::max(kRounding, kOfSize * largestNumber(moves)) + tolerance().value_or(0);
}

/// The same as gougeIn(), for all blocks.
std::vector<Place> SpaceRuns::gougedBlocks(const RunResult &run, const GivenVariables &given) const {
  geometry::BlockDepths gouges = geometry::BlockDepths::ofGouges(claimOf(rule_), rule_.region);
  gouges.add(spaceOf(context_, given), run.moves);
  std::vector<Place> blocks;
  if (gouges.depths().empty())
    return blocks;
  const double least = leastDepth(run.moves);
  for (const auto &[block, depth] : gouges.depths())
    if (depth >= least)
      blocks.push_back(block);
  return blocks;
}

Violation SpaceRuns::violation() const {
  const auto happened = [runs = *this](const RunResult &run, const GivenVariables &given) {
    const auto gouge = runs.gougeIn(run, given);
    if (!gouge)
      return std::optional<std::string>();
    return std::optional(textOf(runs.rule_, *gouge, run.moves[gouge->move], runs.context_.subject.dialect().machine) +
                         (run.offsetIsAssumed ? "; the offset of D is taken to be the radius of `@TOOL`" : ""));
  };
  Violation violation{happened};
  const auto gouged = [runs = *this](const RunResult &run, const GivenVariables &given) {
    return runs.gougedBlocks(run, given);
  };
  violation.ofBlock = {{{rule_.kind, rule_.clause}, gouged}, own_};
  if (!tolerance())
    violation.breaksExactly = [runs = *this](const GivenVariables &given) {
      const WitnessSearch &witnesses = runs.context_.witnesses;
      const RunResult run = witnesses.runOf(given, WordRounding::None);
      return runs.gougeIn(run, given) && witnesses.agreesExactly(given, run) != Agreement::Different;
    };
  return violation;
}

Witness SpaceRuns::located(Witness witness) const {
  const RunResult run = context_.witnesses.runOf(witness.variables);
  if (const auto gouge = gougeIn(run, witness.variables))
    witness.gouge = GougeAt{run.moves[gouge->move].place, gouge->at, gouge->depth};
  return witness;
}

std::map<Place, double> SpaceRuns::nearest(const ProofContext &context, const SpaceRule &rule) {
  geometry::BlockDepths depths = geometry::BlockDepths::ofMargins(claimOf(rule), rule.region);
  for (const WitnessSearch::Sample &sample : context.witnesses.samples())
    depths.add(spaceOf(context, sample.given), sample.result.moves);
  std::map<Place, double> margins;
  for (const auto &[block, depth] : depths.depths())
    margins.emplace(block, std::max(0.0, -depth));
  return margins;
}

std::optional<std::string> SpaceRuns::roundedAway() const {
  constexpr std::size_t kMostLooked = 20;
  const auto &samples = context_.witnesses.samples();
  for (const std::size_t i : context_.witnesses.mayBreak(violation()))
    if (i < kMostLooked)
      if (const auto gouge = gougeIn(samples[i].result, samples[i].given))
        return fmt::format(
            "rounding of words to the least increment adds up: {}",
            textOf(rule_, *gouge, samples[i].result.moves[gouge->move], context_.subject.dialect().machine));
  return std::nullopt;
}

} // namespace feedhold::prove
