// Watched: what lies on the disk that a run depends on, so that a change shows.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace feedhold {

/// Time of the last change and size, by path.
struct FileStamp {
  std::filesystem::file_time_type changed;
  std::uintmax_t size;
  friend bool operator==(const FileStamp &, const FileStamp &) = default;
};
using Stamps = std::map<std::filesystem::path, FileStamp>;

/// All files in the folders of `paths` that are not hidden, of a named file its folder alone, and the configurations
/// above.  Without `ignored`, which a run writes itself.
Stamps stampsOf(const std::vector<std::string> &paths, const std::vector<std::string> &ignored);

} // namespace feedhold
