// Which G code system a lathe program was written for.
#pragma once

#include "language/dialect/dialect.h"
#include "language/dialect/text_signals.h"

#include <optional>
#include <string_view>

namespace feedhold {

/// Absent where the text shows too little, or marks of several systems.
std::optional<GCodeSystem> gCodeSystemOf(const TextScan &scan);

/// What the marks of a system are, for people.
std::string_view marksOf(GCodeSystem system);

} // namespace feedhold
