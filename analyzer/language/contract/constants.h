// Constants: what an expression of a contract is worth when the values of its variables are known exactly.
#pragma once

#include "base/support/rational.h"
#include "language/syntax/tree.h"

#include <functional>
#include <optional>

namespace feedhold {

/// The value of `#n`; absent when it is not known.
using ValueOfVariable = std::function<std::optional<Rational>(std::uint32_t)>;

/// Absent when a variable is not known, for functions other than ABS, and where the value does not fit.
std::optional<Rational> constantValue(const SyntaxTree &tree, ExpressionId expression,
                                      const ValueOfVariable &valueOf = {});
/// Of a condition, by the same rules.
std::optional<bool> constantTruth(const SyntaxTree &tree, ExpressionId condition, const ValueOfVariable &valueOf = {});

} // namespace feedhold
