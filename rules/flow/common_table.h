// Tables of common variables: `#[550+#1]`, and `#[#19+#40]` behind the default `#19=100`.
#pragma once

#include "rules/flow/definitions.h"

#include <optional>

namespace feedhold::rules {

/// The number behind the local variables on which the computed number of a variable is based: a literal in its index,
/// or in an assignment to a variable of the index.
std::optional<std::uint32_t> tableBase(const FlowFacts &facts, ExpressionId variable);

} // namespace feedhold::rules
