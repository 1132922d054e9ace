#include "proof/decide/discharge_parts.h"

#include "proof/smt/steps.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace feedhold::prove {
namespace {

/// Disjoint sets of numbers below `size`.
class DisjointSets {
public:
  explicit DisjointSets(std::size_t size) : parents_(size) { std::iota(parents_.begin(), parents_.end(), 0); }
  std::size_t of(std::size_t member) {
    while (parents_[member] != member)
      member = parents_[member] = parents_[parents_[member]];
    return member;
  }
  void join(std::size_t a, std::size_t b) { parents_[of(a)] = of(b); }

private:
  std::vector<std::size_t> parents_;
};

} // namespace

std::vector<std::vector<smt::TermId>> independentParts(const smt::TermStore &store,
                                                       std::span<const smt::TermId> formulas) {
  DisjointSets sets(formulas.size());
  std::map<smt::TermId, std::size_t> users; // of a variable: the first formula
  for (std::size_t i = 0; i < formulas.size(); ++i)
    for (const smt::TermId variable : store.variablesOf(formulas[i])) {
      smt::spend(2);
      sets.join(i, users.try_emplace(variable, i).first->second);
    }
  std::map<std::size_t, std::vector<smt::TermId>> bySet;
  for (std::size_t i = 0; i < formulas.size(); ++i)
    bySet[sets.of(i)].push_back(formulas[i]);
  std::vector<std::vector<smt::TermId>> parts;
  for (auto &[set, part] : bySet)
    parts.push_back(std::move(part));
  std::ranges::stable_sort(parts, {}, &std::vector<smt::TermId>::size);
  return parts;
}

} // namespace feedhold::prove
