// Writing a file so that a reader, or a power cut, sees the old bytes or the new ones and nothing between.
#pragma once

#include "base/support/result.h"

#include <filesystem>
#include <optional>
#include <string_view>

namespace feedhold {

/// Puts `text` in place of an existing file, with the same permissions; follows a link to the file itself.  Absent: it
/// worked.
std::optional<Error> replaceFile(const std::filesystem::path &path, std::string_view text);

/// Puts a file in its place, new or not, readable for its owner.  A power cut may leave it without its bytes.
std::optional<Error> putFile(const std::filesystem::path &path, std::string_view text);

/// The same for a file that others read, too: an old one keeps its permissions, a new one gets the usual ones.
std::optional<Error> saveFile(const std::filesystem::path &path, std::string_view text);

/// Writes a file, new or not.
std::optional<Error> writeFile(const std::filesystem::path &path, std::string_view text);

} // namespace feedhold
