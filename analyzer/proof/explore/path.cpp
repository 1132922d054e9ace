#include "proof/explore/path.h"

#include "proof/smt/steps.h"

#include <algorithm>

namespace feedhold::prove {

using smt::TermId;
using smt::TermKind;

bool Path::says(const smt::TermStore &store, TermId condition) const {
  smt::spend(2 + conditions.size() / 8);
  if (condition == store.yes() || std::find(conditions.begin(), conditions.end(), condition) != conditions.end())
    return true;
  const smt::Term &term = store[condition];
  const auto isSaid = [&](TermId part) { return says(store, part); };
  if (term.kind == TermKind::Or)
    return std::any_of(term.arguments.begin(), term.arguments.end(), isSaid);
  if (term.kind == TermKind::And)
    return std::all_of(term.arguments.begin(), term.arguments.end(), isSaid);
  return term.kind == TermKind::Not && denies(store, term.arguments.front());
}

bool Path::denies(const smt::TermStore &store, TermId condition) const {
  smt::spend(2 + conditions.size() / 2);
  const smt::Term &term = store[condition];
  const auto isDenied = [&](TermId part) { return denies(store, part); };
  if (term.kind == TermKind::And)
    return std::any_of(term.arguments.begin(), term.arguments.end(), isDenied);
  if (term.kind == TermKind::Or)
    return std::all_of(term.arguments.begin(), term.arguments.end(), isDenied);
  return std::any_of(conditions.begin(), conditions.end(), [&](TermId each) {
    return store[each].kind == TermKind::Not && store[each].arguments.front() == condition;
  });
}

bool Path::assume(const smt::TermStore &store, TermId condition) {
  if (condition == store.no())
    return false;
  if (says(store, condition))
    return true;
  if (store[condition].kind == TermKind::And) {
    const std::vector<TermId> parts = store[condition].arguments;
    return std::all_of(parts.begin(), parts.end(), [&](TermId part) { return assume(store, part); });
  }
  conditions.push_back(condition);
  return true;
}

} // namespace feedhold::prove
