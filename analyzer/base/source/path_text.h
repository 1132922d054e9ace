// Paths in their normal form, and as text with `/` on every system.  std::filesystem of libstdc++ takes
// `\\server\share` for `\server\share`: what is made of a path here keeps its server.
#pragma once

#include <filesystem>
#include <string>

namespace feedhold {

/// Of a drive or a server, on Windows.
bool isAbsolutePath(const std::filesystem::path &path);
/// From the root on.
std::filesystem::path absolutePath(const std::filesystem::path &path);
/// Without `.`, `..` and doubled separators.
std::filesystem::path normalPath(const std::filesystem::path &path);
/// The same from the root on, with links resolved as far as the path exists; not on servers.
std::filesystem::path canonicalPath(const std::filesystem::path &path, std::error_code &error);
std::string pathText(const std::filesystem::path &path);

} // namespace feedhold
