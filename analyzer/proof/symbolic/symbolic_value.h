// SymbolicValue: what a variable holds, as terms.
#pragma once

#include "proof/smt/term.h"

namespace feedhold::prove {

/// The number is 0 where it is vacant.
struct SymbolicValue {
  smt::TermId vacant{1};
  smt::TermId number{0};
  friend bool operator==(const SymbolicValue &, const SymbolicValue &) = default;
};

} // namespace feedhold::prove
