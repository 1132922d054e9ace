// Runs of the machine in space: where they violate a claim, and the distance that they keep.
#pragma once

#include "proof/context/proof_context.h"

namespace feedhold::prove {

class SpaceRuns {
public:
  /// Of one rule, and of the movements of one block and what it calls.
  SpaceRuns(const ProofContext &context, const SpaceRule &rule, Place own)
      : context_(context), rule_(rule), own_(own) {}

  std::optional<geometry::Gouge> gougeIn(const RunResult &run, const GivenVariables &given) const;
  /// Proofs in exact numbers take words as they are written: what only their rounding to the least increment makes is
  /// no witness against them.
  Violation violation() const;
  /// The same run as the witness of a refuted claim.
  Witness located(Witness witness) const;
  /// How near the sampled runs come in each block; absent: none of them moves there.
  static constexpr double kTouches = 1e-6; // nearer than that is no distance
  static std::map<Place, double> nearest(const ProofContext &context, const SpaceRule &rule);
  /// What the rounded words of a sampled run lead to, where that is further than proofs over exact numbers know.
  std::optional<std::string> roundedAway() const;

  /// How far the tool may pass what the claim says; absent: the claim is about exact numbers.
  std::optional<double> tolerance() const;

private:
  std::vector<Place> gougedBlocks(const RunResult &run, const GivenVariables &given) const;
  double leastDepth(const std::vector<RecordedMove> &moves) const;

  const ProofContext &context_;
  const SpaceRule &rule_;
  Place own_;
};

} // namespace feedhold::prove
