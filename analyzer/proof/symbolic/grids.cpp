#include "proof/symbolic/grids.h"

#include <algorithm>
#include <utility>

namespace feedhold::prove {

using smt::Number;
using smt::Sort;
using smt::TermId;
using smt::TermKind;

namespace {

std::optional<Grid> gridOf(const Number &number) {
  if (number.isZero())
    return kGridOfZero;
  if (number.isInteger())
    return 0; // larger powers of two are of no use
  Number multiple = number;
  for (Grid grid = -1; grid >= kFinestGrid; --grid)
    if ((multiple *= Number(2)).isInteger())
      return grid;
  return std::nullopt;
}

} // namespace

bool Grids::believeInputs(bool believes) {
  known_.clear();
  return std::exchange(believesInputs_, believes);
}

std::optional<Grid> Grids::of(TermId term) {
  const auto known = known_.find(term);
  if (known != known_.end())
    return known->second;
  const std::optional<Grid> found = find(term);
  if (found) // a variable may be told later
    known_.emplace(term, found);
  return found;
}

std::optional<Grid> Grids::find(TermId id) {
  const smt::Term &term = store_[id];
  if (term.kind == TermKind::Number)
    return gridOf(term.number);
  const auto all = [&](std::span<const TermId> arguments, Grid start, auto &&join) -> std::optional<Grid> {
    Grid grid = start;
    for (const TermId argument : arguments) {
      const std::optional<Grid> each = of(argument);
      if (!each)
        return std::nullopt;
      grid = std::clamp(join(grid, *each), -kGridOfZero, kGridOfZero);
    }
    return grid >= kFinestGrid ? std::optional(grid) : std::nullopt;
  };
  const auto least = [](Grid a, Grid b) { return std::min(a, b); };
  if (const auto told = ofVariables_.find(id); told != ofVariables_.end())
    return told->second;
  if (const auto told = ofInputs_.find(id); believesInputs_ && told != ofInputs_.end())
    return told->second;
  if (term.kind == TermKind::Add)
    return all(term.arguments, kGridOfZero, least);
  if (term.kind == TermKind::Multiply)
    return all(term.arguments, 0, [](Grid a, Grid b) { return a + b; });
  if (term.kind == TermKind::Ite)
    return all(std::span(term.arguments).subspan(1), kGridOfZero, least);
  return term.sort == Sort::Int ? std::optional(0) : std::nullopt;
}

} // namespace feedhold::prove
