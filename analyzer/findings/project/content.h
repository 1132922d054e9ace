// Content: whether bytes can be a program at all, before any language is considered.
#pragma once

#include <optional>
#include <string_view>

namespace feedhold {

/// The reason of a file without any text.
inline constexpr std::string_view kEmptyFile = "the file is empty";

/// Why these bytes are no program text; absent when they may be one.
std::optional<std::string_view> whyNotText(std::string_view bytes);

} // namespace feedhold
