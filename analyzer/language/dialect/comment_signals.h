// Comments: makers' names, and statements that other languages write in parentheses.
#pragma once

#include "language/dialect/text_signals.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace feedhold {

/// Length of the comment that `text` begins with, its parentheses included.
std::size_t commentLength(std::string_view text);

enum class CommentLanguage : std::uint8_t { Any, Foreign };

/// Statements in parentheses stand alone in their block.
enum class CommentPlace : std::uint8_t { Alone, BesideCode };

/// Counts the signals of a comment, given with its parentheses.
CommentLanguage scanComment(std::string_view comment, CommentPlace place, TextScan &scan);

} // namespace feedhold
