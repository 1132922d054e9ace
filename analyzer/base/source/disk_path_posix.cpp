// diskPath where upper and lower case differ.
#include "base/source/disk_path.h"

namespace feedhold {

std::filesystem::path diskPath(const std::filesystem::path &path) {
  return std::filesystem::absolute(path).lexically_normal();
}

} // namespace feedhold
