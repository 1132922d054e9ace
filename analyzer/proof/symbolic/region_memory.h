// Region memory: what variables hold that were written through an index of which only a range is known.
//
// The state keeps single variables, and a token for all the others (path_memory.h).  Each time a range of variables
// changes as a whole the token becomes a new variable, under which the change is taken down.  So where two states have
// the same token, every variable that neither of them keeps by itself holds the same in both; what it holds is found
// out where it is read.
#pragma once

#include "language/dialect/dialect.h"
#include "proof/symbolic/symbolic_value.h"

#include <compare>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace feedhold::prove {

/// `#[..]` in the text.
struct IndexPlace {
  std::uint32_t file;
  std::uint32_t begin; // of its span
  friend auto operator<=>(const IndexPlace &, const IndexPlace &) = default;
};

/// Between which variables each index chooses, as the flow analysis has it.  A proof uses only what is proved again.
using IndexRanges = std::map<IndexPlace, VariableSpan>;

/// A value is written to one variable of a span, which the index chooses.
struct RegionWrite {
  smt::TermId index;
  SymbolicValue value;
  bool isInSpan; // the index lies in the span for certain; else it may lie in that of another change
};

/// A span of variables changes.
struct RegionChange {
  VariableSpan span;
  std::optional<RegionWrite> write;                            // absent: they hold anything
  smt::TermId before{0};                                       // the token
  std::vector<std::pair<std::uint32_t, SymbolicValue>> held{}; // of the span: what the state kept; of a write
};

} // namespace feedhold::prove
