// The remedy for comparisons that rounding decides: a margin that no rounding error reaches.
#pragma once

#include "rules/expressions/expression_view.h"

namespace feedhold::rules {

/// `#1LT1` becomes `#1LT[1-.0005]`, `#1EQ1` becomes `ABS[#1-1]LT.0005`: for numbers on the left that are `apart` from
/// each other.  None where they are so near that the margin might take one for the next.
std::vector<FixIt> marginFixes(const FileContext &context, const BinaryOperation &relation, double apart);

} // namespace feedhold::rules
