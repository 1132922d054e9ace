// Space claims: what the geometry clauses of a contract ask of each movement (docs/geometry.md).
#pragma once

#include "proof/explore/exploration.h"
#include "proof/geometry/gouge.h"
#include "proof/obligation/obligation.h"
#include "proof/space/path_questions.h"
#include "proof/space/region_shapes.h"
#include "proof/space/term_space.h"
#include "proof/symbolic/contract_terms.h"

namespace feedhold::prove {

/// One clause, or all clauses of one name.
struct SpaceRule {
  ObligationKind kind; // KeepIn, KeepOut, Clearance, Travel
  ClauseId clause;
  std::size_t region = 0;                       // of KeepIn and KeepOut: of namesOf
  std::string name = {};                        // of the region
  bool isOfMachine = false;                     // Travel: in machine coordinates
  std::vector<geometry::FreeSpace> spaces = {}; // the point of the tool is in all of them
  /// Of KeepIn and KeepOut: the same where the tool keeps so far away; empty where a region knows no distances.
  std::function<std::vector<geometry::FreeSpace>(const smt::Number &margin)> spacesFor = {};
  std::optional<smt::TermId> height = {};  // of Clearance
  smt::TermId isSound = smt::TermId(1);    // without that the claim means nothing
  std::optional<std::string> missing = {}; // why it cannot be checked
};

/// What a run is asked of a rule.
geometry::SpaceClaim claimOf(const SpaceRule &rule);

class SpaceClaims {
public:
  /// `tolerance`: how far the tool may pass what a clause says.
  SpaceClaims(smt::TermStore &store, ContractTerms &terms, const Contract &contract, const SymbolicState &entry,
              const Dialect &dialect, smt::Number tolerance);

  const std::vector<SpaceRule> &rules() const { return rules_; }
  bool concerns(const SpaceRule &rule, const MoveInstance &move) const;
  /// Why the movement cannot be checked; absent: `questions` check it.
  std::optional<std::string> whyNotTold(const MoveInstance &move) const;
  /// What has to hold before the move so that coordinates are those of the tool, and what is missing otherwise.
  std::vector<std::pair<smt::TermId, std::string>> premises(const SpaceRule &rule, const MoveInstance &move) const;
  std::vector<SpaceQuestion> questions(const SpaceRule &rule, const MoveInstance &move) const;
  /// The rule for a tool that has to keep so far away; there is SpaceRule::spacesFor.
  SpaceRule withMargin(const SpaceRule &rule, double margin) const;
  /// The feed or the speed in force; of a cutting movement.
  smt::TermId keepsLimit(const WordLimit &limit, const MoveInstance &move) const;
  /// With `@MACHINE`, of a start that `@START` leaves open: the tool is outside of the regions to keep out of.  No move
  /// can bring a tool into a region in which it stands already; whoever calls the program answers for that.  Where the
  /// contract tells lengths of tools, it is so with the longest.
  std::vector<smt::TermId> startIsOutside() const;
  /// Where the contract tells lengths: the tip is so much lower than the coordinates while none is in force.
  std::optional<smt::TermId> lengthInSpindle() const { return lengthInSpindle_; }
  /// What may hold of the position before each iteration of a loop.
  std::vector<smt::TermId> hints(const SymbolicState &state) const;

private:
  std::optional<LatheTip> tip() const;
  std::optional<Diameters<smt::TermId>> diameters() const;
  std::string_view axesOfRegions() const;
  void addRegions(const std::vector<Region> &regions, ObligationKind kind);
  static bool isOfProgrammed(const SpaceRule &rule);
  smt::Number distanceOf(geometry::SpaceClaim claim) const;
  MoveInstance placed(const SpaceRule &rule, MoveInstance instance) const;
  bool mayMoveBeside(const MoveInstance &instance, Axis axis) const;
  std::string adviceOnAngles(std::optional<Axis> axis) const;
  SpaceQuestion clearanceOf(const SpaceRule &rule, const MoveInstance &move) const;

  smt::TermStore &store_;
  ContractTerms &terms_;
  const Contract &contract_;
  const SymbolicState &entry_;
  const Dialect &dialect_;
  smt::Number tolerance_;
  AxisSet fixed_;      // at each of whose angles the regions are the same
  smt::Number corner_; // how far the tool may be from the programmed path
  TermSpace space_;
  std::vector<SpaceRule> rules_;
  std::optional<smt::TermId> lengthInSpindle_;
};

/// A movement that takes material away.
bool isCutting(MoveKind kind);

/// Whether the contract has a clause on where the tool goes.
bool hasSpaceClause(const Contract &contract);

} // namespace feedhold::prove
