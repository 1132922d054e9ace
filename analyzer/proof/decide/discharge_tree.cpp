#include "proof/decide/discharge_tree.h"

#include "base/support/match.h"

#include <map>

namespace feedhold::prove {
namespace {

bool touches(const std::set<std::uint32_t> &used, std::uint32_t first, std::uint32_t end) {
  auto found = used.lower_bound(first);
  return found != used.end() && *found < end;
}

/// Where the checker counts what the search numbered.
struct Places {
  std::map<std::uint32_t, std::uint32_t> hypotheses, clauses;
  std::uint32_t nextHypothesis = 0, nextClause = 0;

  void enter(const Range &range) {
    for (std::uint32_t index = range.firstHypothesis; index < range.endHypothesis; ++index)
      hypotheses[index] = nextHypothesis++;
    for (std::uint32_t index = range.firstClause; index < range.endClause; ++index)
      clauses[index] = nextClause++;
  }
};

check::Certificate numberedWith(const TreeNode &tree, const Places &places) {
  check::Certificate result{tree.step, {}};
  match(
      result.step,
      [&](check::Combination &use) {
        for (check::Product &product : use.products)
          for (std::uint32_t &index : product.hypotheses)
            index = places.hypotheses.at(index);
        for (check::EqualityUse &equality : use.equalities)
          equality.hypothesis = places.hypotheses.at(equality.hypothesis);
      },
      [&](check::ClauseSplit &split) { split.clause = places.clauses.at(split.clause); }, [&](check::IntegerSplit &) {},
      [&](check::SignSplit &) {}, [&](check::Tighten &use) { use.hypothesis = places.hypotheses.at(use.hypothesis); });
  for (const Branch &branch : tree.branches) {
    Places inner = places;
    inner.enter(branch.assumes);
    result.branches.push_back(numberedWith(*branch.tree, inner));
  }
  return result;
}

} // namespace

bool TreeNode::uses(const Range &range) const {
  return touches(hypotheses, range.firstHypothesis, range.endHypothesis) ||
         touches(clauses, range.firstClause, range.endClause);
}

Tree leaf(check::Combination combination) {
  auto node = std::make_shared<TreeNode>();
  for (const check::Product &product : combination.products)
    node->hypotheses.insert(product.hypotheses.begin(), product.hypotheses.end());
  for (const check::EqualityUse &equality : combination.equalities)
    node->hypotheses.insert(equality.hypothesis);
  node->step = std::move(combination);
  return node;
}

Tree splitTree(Step step, std::vector<Branch> branches) {
  auto node = std::make_shared<TreeNode>();
  for (const Branch &branch : branches) {
    const Range &range = branch.assumes;
    for (std::uint32_t index : branch.tree->hypotheses)
      if (index < range.firstHypothesis || index >= range.endHypothesis)
        node->hypotheses.insert(index);
    for (std::uint32_t index : branch.tree->clauses)
      if (index < range.firstClause || index >= range.endClause)
        node->clauses.insert(index);
  }
  if (const auto *split = std::get_if<check::ClauseSplit>(&step))
    node->clauses.insert(split->clause);
  if (const auto *use = std::get_if<check::Tighten>(&step))
    node->hypotheses.insert(use->hypothesis);
  node->step = std::move(step);
  node->branches = std::move(branches);
  return node;
}

Tree tightenTree(std::uint32_t hypothesis, std::uint32_t stronger, Tree tree) {
  const Range range{stronger, stronger + 1, 0, 0};
  if (!tree->uses(range))
    return tree;
  return splitTree(check::Tighten{hypothesis}, {{range, std::move(tree)}});
}

check::Certificate numbered(const TreeNode &tree, const check::UnsatProblem &claim) {
  Places places;
  places.enter({0, static_cast<std::uint32_t>(claim.conjunction.constraints.size()), 0,
                static_cast<std::uint32_t>(claim.conjunction.clauses.size())});
  return numberedWith(tree, places);
}

} // namespace feedhold::prove
