// The tree of a refutation while it is searched for: hypotheses have numbers of their own, and each node knows which it
// uses, so that splits that turn out to be idle can be left out.
#pragma once

#include "proof/check/certificate.h"

#include <memory>
#include <set>

namespace feedhold::prove {

/// What a branch assumes: numbers of hypotheses and of clauses, ends not included.
struct Range {
  std::uint32_t firstHypothesis = 0, endHypothesis = 0;
  std::uint32_t firstClause = 0, endClause = 0;
};

struct TreeNode;
using Tree = std::shared_ptr<const TreeNode>;
using Step = decltype(check::Certificate::step);

struct Branch {
  Range assumes;
  Tree tree;
};

struct TreeNode {
  Step step;
  std::vector<Branch> branches;
  std::set<std::uint32_t> hypotheses; ///< used here or below, and not assumed below
  std::set<std::uint32_t> clauses;

  bool uses(const Range &range) const;
};

Tree leaf(check::Combination combination);
Tree splitTree(Step step, std::vector<Branch> branches);
/// The tree itself where it does not use what tightening gives.
Tree tightenTree(std::uint32_t hypothesis, std::uint32_t stronger, Tree tree);

/// With hypotheses and clauses numbered as the checker does.
check::Certificate numbered(const TreeNode &tree, const check::UnsatProblem &claim);

} // namespace feedhold::prove
