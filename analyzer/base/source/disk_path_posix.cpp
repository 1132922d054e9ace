// diskPath where upper and lower case differ.
#include "base/source/disk_path.h"

#include "base/source/path_text.h"

namespace feedhold {

std::filesystem::path diskPath(const std::filesystem::path &path) { return normalPath(absolutePath(path)); }

} // namespace feedhold
