#include "proof/families/space_runs.h"

#include "base/support/text.h"
#include "proof/space/plain_space.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::prove {

using geometry::SpaceClaim;

namespace {

constexpr int kShownDecimals = 4; // a control shows three in millimetres and four in inches

SpaceClaim plainClaim(ObligationKind kind) {
  if (kind == ObligationKind::KeepIn)
    return SpaceClaim::KeepIn;
  if (kind == ObligationKind::KeepOut)
    return SpaceClaim::KeepOut;
  return kind == ObligationKind::Clearance ? SpaceClaim::Clearance : SpaceClaim::Travel;
}

std::string howFar(const SpaceRule &rule, double depth) {
  const std::string distance = depth < 1e-4 ? "less than 0.0001" : decimalText(depth, kShownDecimals);
  if (rule.kind == ObligationKind::KeepIn)
    return fmt::format("the tool is {} outside {}", distance, rule.name);
  if (rule.kind == ObligationKind::KeepOut)
    return fmt::format("the tool is {} inside {}", distance, rule.name);
  if (rule.kind == ObligationKind::Clearance)
    return fmt::format("a rapid move goes {} below the clearance height", distance);
  return fmt::format("the tool is {} outside the travel limits", distance);
}

std::string textOf(const SpaceRule &rule, const GougeAt &gouge) {
  const auto &[x, y, z] = gouge.at;
  return fmt::format("{} at X{} Y{} Z{}", howFar(rule, gouge.depth), decimalText(x, kShownDecimals),
                     decimalText(y, kShownDecimals), decimalText(z, kShownDecimals));
}

geometry::PlainSpace spaceOf(const ProofContext &context, const GivenVariables &given) {
  const ProofSubject &subject = context.subject;
  return plainSpace(subject.programs, subject.program, *subject.contracts, context.witnesses.runOptions(given));
}

} // namespace

std::optional<GougeAt> SpaceRuns::gougeIn(const RunResult &run, const GivenVariables &given) const {
  const auto gouge = geometry::deepestGouge(spaceOf(context_, given), plainClaim(rule_.kind), rule_.region, run.moves,
                                            [this](const RecordedMove &move) { return move.own == own_; });
  if (!gouge || gouge->depth < leastDepth())
    return std::nullopt;
  return GougeAt{run.moves[gouge->move].place, gouge->at, gouge->depth};
}

std::optional<double> SpaceRuns::tolerance() const {
  const ProofSubject &subject = context_.subject;
  return subject.options.arithmetic == Arithmetic::Exact
             ? std::nullopt
             : std::optional(toleranceOf(*subject.contract(), subject.dialect()).toDouble());
}

/// Less is the rounding of the machine's numbers, or within the tolerance, and no gouge.
double SpaceRuns::leastDepth() const {
  constexpr double kRounding = 1e-6;
  return kRounding + tolerance().value_or(0);
}

Violation SpaceRuns::violation() const {
  const auto happened = [runs = *this](const RunResult &run, const GivenVariables &given) {
    const auto gouge = runs.gougeIn(run, given);
    if (!gouge)
      return std::optional<std::string>();
    return std::optional(textOf(runs.rule_, *gouge) +
                         (run.offsetIsAssumed ? "; the offset of D is taken to be the radius of `@TOOL`" : ""));
  };
  if (tolerance())
    return happened;
  return {happened, [runs = *this](const GivenVariables &given) {
            const WitnessSearch &witnesses = runs.context_.witnesses;
            const RunResult run = witnesses.runOf(given, WordRounding::None);
            return runs.gougeIn(run, given) && witnesses.agreesExactly(given, run) != Agreement::Different;
          }};
}

Witness SpaceRuns::located(Witness witness) const {
  witness.gouge = gougeIn(context_.witnesses.runOf(witness.variables), witness.variables);
  return witness;
}

std::optional<double> SpaceRuns::nearest() const {
  std::optional<double> nearest;
  for (const WitnessSearch::Sample &sample : context_.witnesses.samples()) {
    const auto margin =
        geometry::smallestMargin(spaceOf(context_, sample.given), plainClaim(rule_.kind), rule_.region,
                                 sample.result.moves, [this](const RecordedMove &move) { return move.own == own_; });
    if (margin && (!nearest || *margin < *nearest))
      nearest = margin;
    if (nearest && *nearest < kTouches)
      break;
  }
  return nearest;
}

std::optional<std::string> SpaceRuns::roundedAway() const {
  constexpr std::size_t kMostLooked = 20;
  const auto &samples = context_.witnesses.samples();
  for (std::size_t i = 0; i < samples.size() && i < kMostLooked; ++i)
    if (const auto gouge = gougeIn(samples[i].result, samples[i].given))
      return fmt::format("rounding of words to the least increment adds up: {}", textOf(rule_, *gouge));
  return std::nullopt;
}

} // namespace feedhold::prove
