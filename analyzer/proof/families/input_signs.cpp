#include "proof/families/input_signs.h"

#include <algorithm>

namespace feedhold::prove {

using smt::Sort;
using smt::TermId;
using smt::TermKind;

namespace {

/// A value whose sign its own form does not tell.
bool mayHaveSign(ProofStart &start, TermId id) {
  const smt::Term &term = start.store()[id];
  const bool isComputed = term.kind == TermKind::Divide || term.kind == TermKind::Ite ||
                          (term.kind == TermKind::Apply && term.function != smt::Function::Sqrt);
  const std::vector<TermId> &variables = smt::variablesOf(start.store(), id);
  return isComputed && term.sort != Sort::Bool && !variables.empty() &&
         std::all_of(variables.begin(), variables.end(),
                     [&](TermId variable) { return start.interpretation().isFromEntry(variable); });
}

} // namespace

std::vector<TermId> signsOfInputs(ProofStart &start, const Exploration &found) {
  constexpr std::size_t kMostTerms = 40;
  constexpr Budget kOfOne{.search = 250'000, .z3 = 0, .cvc5 = 0};
  smt::TermStore &store = start.store();
  std::vector<TermId> roots;
  for (const MoveInstance &move : found.moves)
    for (const auto *point : {&move.move.start, &move.move.end})
      for (const Axis axis : {Axis::X, Axis::Y, Axis::Z})
        roots.push_back((*point)[indexOf(axis)].number);
  const TermId zero = store.number(smt::Number(0));
  std::vector<TermId> known = start.demands();
  std::vector<TermId> signs;
  std::size_t tried = 0;
  for (const TermId term : smt::reachable(store, roots)) {
    if (!mayHaveSign(start, term) || ++tried > kMostTerms)
      continue;
    for (const TermId sign : {store.less(zero, term), store.lessOrEqual(zero, term), store.less(term, zero)})
      if (sign == store.yes() || discharge(store, start.onPath(known, sign), kOfOne).proved()) {
        signs.push_back(sign);
        known.push_back(sign);
        break;
      }
  }
  return signs;
}

} // namespace feedhold::prove
