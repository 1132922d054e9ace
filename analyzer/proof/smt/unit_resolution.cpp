#include "proof/smt/unit_resolution.h"

#include "proof/smt/steps.h"

#include <algorithm>
#include <set>

namespace feedhold::smt {

namespace {

/// The alternatives that are left of the formula; yes: it says nothing.
TermId resolved(TermStore &store, const Bounds &bounds, const std::set<TermId> &units, TermId formula) {
  std::vector<TermId> left;
  const std::vector<TermId> alternatives = store[formula].arguments;
  spend(10 * alternatives.size());
  for (const TermId each : alternatives) {
    const std::optional<bool> known = bounds.truthOf(each);
    if (known == true || units.contains(each))
      return store.yes();
    if (known == false || units.contains(store.logicalNot(each)))
      continue;
    left.push_back(each);
  }
  return store.logicalOr(left);
}

} // namespace

std::vector<TermId> resolveUnits(TermStore &store, std::vector<TermId> formulas) {
  constexpr int kMostRounds = 3;
  const auto isChoice = [&](TermId formula) { return store[formula].kind == TermKind::Or; };
  if (std::none_of(formulas.begin(), formulas.end(), isChoice))
    return formulas;
  for (int round = 0; round < kMostRounds; ++round) {
    std::set<TermId> units;
    std::vector<TermId> simple;
    std::copy_if(formulas.begin(), formulas.end(), std::back_inserter(simple),
                 [&](TermId formula) { return !isChoice(formula); });
    units.insert(simple.begin(), simple.end());
    const Bounds bounds(store, simple);
    std::vector<TermId> next = simple;
    bool changed = false;
    for (const TermId formula : formulas) {
      if (!isChoice(formula))
        continue;
      const TermId left = resolved(store, bounds, units, formula);
      changed |= left != formula;
      if (store[left].kind == TermKind::And) {
        next.insert(next.end(), store[left].arguments.begin(), store[left].arguments.end());
      } else if (left != store.yes()) {
        next.push_back(left);
      }
    }
    formulas = std::move(next);
    if (!changed)
      break;
  }
  return formulas;
}

} // namespace feedhold::smt
