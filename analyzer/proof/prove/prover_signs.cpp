// Signs of what a program computes from its arguments once and for all, `#21/FUP[#21/#22]`: known, they spare each
// claim about movements to find them again.
#include "proof/prove/prover.h"

namespace feedhold::prove {

using smt::Sort;
using smt::TermId;
using smt::TermKind;

namespace {

constexpr std::size_t kMostTerms = 40;
constexpr Budget kQuick{.search = 250'000, .z3 = 0, .cvc5 = 0};

} // namespace

/// A value whose sign its own form does not tell.
bool Prover::mayHaveSign(TermId id) const {
  const smt::Term &term = store_[id];
  const bool isComputed = term.kind == TermKind::Divide || term.kind == TermKind::Ite ||
                          (term.kind == TermKind::Apply && term.function != smt::Function::Sqrt);
  const std::vector<TermId> &variables = smt::variablesOf(store_, id);
  return isComputed && term.sort != Sort::Bool && !variables.empty() &&
         std::all_of(variables.begin(), variables.end(),
                     [&](TermId variable) { return reading_.isFromEntry(variable); });
}

/// They hold for all inputs that the contract allows, and only for those.
void Prover::learnSigns() {
  signs_.clear();
  std::vector<TermId> roots;
  for (const MoveInstance &move : found_.moves)
    for (const auto *point : {&move.move.start, &move.move.end})
      for (const Axis axis : {Axis::X, Axis::Y, Axis::Z})
        roots.push_back((*point)[indexOf(axis)].number);
  const TermId zero = store_.number(smt::Number(0));
  std::size_t tried = 0;
  for (const TermId term : smt::reachable(store_, roots)) {
    if (!mayHaveSign(term) || ++tried > kMostTerms)
      continue;
    std::vector<TermId> known = demands_;
    known.insert(known.end(), signs_.begin(), signs_.end());
    for (const TermId sign : {store_.less(zero, term), store_.lessOrEqual(zero, term), store_.less(term, zero)})
      if (sign == store_.yes() || discharge(store_, onPath(known, sign), kQuick).proved()) {
        signs_.push_back(sign);
        break;
      }
  }
}

} // namespace feedhold::prove
