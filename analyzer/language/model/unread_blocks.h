// What a block can have meant that could not be read.
#pragma once

#include "language/dialect/dialect.h"
#include "language/syntax/tree.h"

#include <string_view>

namespace feedhold {

/// The text has nothing but coordinates, as `X1O. Y5.`, behind a reference return at most, as `28 U0 W0`: no reading of
/// it changes a mode.
bool namesAxesAlone(const SourceFile &source, const SyntaxTree &tree, const Dialect &dialect, BlockId block);

/// Why such a block is not followed.  An interpretation that goes on behind mistakes takes it for a movement.
inline constexpr std::string_view kUnreadMovement = "a block of coordinates that could not be read";

} // namespace feedhold
