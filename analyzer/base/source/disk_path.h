// Whether two paths name the same file.  One .cpp for each system.
#pragma once

#include <filesystem>

namespace feedhold {

/// From the root on and without `..`; where upper and lower case are the same, as the file is spelled in its folder. Of
/// paths that are equal then, one is enough.
std::filesystem::path diskPath(const std::filesystem::path &path);

} // namespace feedhold
