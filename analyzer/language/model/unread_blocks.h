// What a block can have meant that could not be read.
#pragma once

#include "language/dialect/dialect.h"
#include "language/syntax/tree.h"

#include <array>
#include <string_view>

namespace feedhold {

/// The text has nothing but coordinates, as `X1O. Y5.`, behind a reference return at most, as `28 U0 W0`: no reading of
/// it changes a mode.
bool namesAxesAlone(const SourceFile &source, const SyntaxTree &tree, const Dialect &dialect, BlockId block);

/// Why such a block is not followed.  An interpretation that goes on behind mistakes takes it for a movement.
inline constexpr std::string_view kUnreadMovement = "a block of coordinates that could not be read";

/// However it is read, the block calls no program and neither begins nor ends a modal call: each G and M of its text
/// has a number, and the number is that of a code which does not.
bool leavesModalCalls(const SourceFile &source, const SyntaxTree &tree, const Dialect &dialect, BlockId block);

/// Why any other block is not followed, and one that leaves modal calls as they are.
inline constexpr std::string_view kUnreadBlock = "a block that could not be read, perhaps with a call";
inline constexpr std::string_view kUnreadWithoutCall = "a block that could not be read";

/// Why a block with a code such as `GO1` is not followed, by the digit.  An interpretation that goes on behind mistakes
/// takes the code for the one that is meant.
inline constexpr std::array<std::string_view, 4> kUnreadMotionCodes = {
    "a G00 with the letter O", "a G01 with the letter O", "a G02 with the letter O", "a G03 with the letter O"};

} // namespace feedhold
