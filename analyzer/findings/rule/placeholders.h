// Text that shows how a program looks, and is none: `#3=ACOS[${x}]`, a line of `...`, `if [..]`.
#pragma once

#include "findings/rule/rule.h"

#include <optional>

namespace feedhold {

/// The first placeholder of a file.  Only lines that do not parse are looked at: no program that a control reads has
/// one.
std::optional<Span> placeholderIn(const FileContext &context);

} // namespace feedhold
