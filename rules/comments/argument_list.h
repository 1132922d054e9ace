// Argument list: the arguments that the remarks at the head of a macro name, `(A=WIDTH, X=CENTER)` or `(#18 = RADIUS)`.
#pragma once

#include "findings/rule/rule.h"

#include <optional>
#include <set>

namespace feedhold::rules {

struct ArgumentList {
  std::set<std::uint32_t> variables;
  Span comment; // the last remark that names some
};

/// Absent where the remarks before the first block that does something name none.  What later remarks name is in it,
/// too.
std::optional<ArgumentList> argumentListOf(const FileContext &context, ProgramId program);

} // namespace feedhold::rules
