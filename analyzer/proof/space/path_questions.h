// Path questions: what has to be proved so that the point of a tool stays in a free space all along its path.
#pragma once

#include "proof/geometry/tool_path.h"

#include <set>
#include <utility>
#include <vector>

namespace feedhold::prove {

/// It holds if one of its alternatives does: the cheap ones first, the exact one last.
struct SpaceQuestion {
  struct Alternative {
    std::vector<smt::TermId> conditions; // of new variables of the goal
    smt::TermId goal;
    std::vector<std::pair<smt::TermId, smt::TermId>> example = {}; // values that they allow, by variable
  };
  std::vector<Alternative> alternatives;
};

class PathQuestions {
public:
  PathQuestions(smt::TermStore &store, const geometry::TermMove &move)
      : store_(store), path_(store, move), hull_(path_.hull()) {}

  /// All of them have to hold: of a convex space one for each bound, of another one.
  std::vector<SpaceQuestion> of(const geometry::FreeSpace &space);

private:
  using Alternative = SpaceQuestion::Alternative;

  SpaceQuestion questionOfBound(const geometry::FreeSpace &space, const geometry::Formula &bound);
  SpaceQuestion questionOfAll(const geometry::FreeSpace &space);
  std::vector<smt::TermId> simpleGoals(const geometry::FreeSpace &space) const;
  std::vector<Alternative> ofArc(const geometry::FreeSpace &space) const;
  std::vector<Alternative> onLevels(const geometry::FreeSpace &space);
  Alternative onHull(smt::TermId goal) const { return {hull_.conditions, goal, hull_.example}; }
  Alternative atAnyPoint(const geometry::Formula &formula);
  bool isOfLevel(const geometry::Formula &bound) const;
  template <typename AtCorner> smt::TermId atCorners(const AtCorner &formula) const {
    std::set<smt::TermId> corners;
    for (const geometry::TermPoint &corner : hull_.corners)
      corners.insert(formula(corner));
    return store_.logicalAnd(std::vector(corners.begin(), corners.end()));
  }

  smt::TermStore &store_;
  geometry::ToolPath path_;
  geometry::ToolPath::Hull hull_;
};

} // namespace feedhold::prove
