#include "findings/project/watched.h"

#include "base/source/path_text.h"
#include "findings/project/config.h"
#include "findings/project/discovery.h"

namespace feedhold {

namespace fs = std::filesystem;

namespace {

enum class Depth : std::uint8_t { FolderAlone, AllBelow };

// What goes away while we look is not there: the next look tells.
void addFile(const fs::path &path, Stamps &stamps) {
  std::error_code error;
  const FileStamp stamp{fs::last_write_time(path, error), fs::file_size(path, error)};
  if (!error)
    stamps[path] = stamp;
}

void addFolder(const fs::path &folder, Depth depth, Stamps &stamps) {
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    std::error_code ignored;
    const std::string name = pathText(at->path().filename());
    if (at->is_regular_file(ignored) && !isHiddenFileName(name))
      addFile(at->path(), stamps);
    else if (depth == Depth::AllBelow && !name.starts_with('.') && at->is_directory(ignored) &&
             !at->is_symlink(ignored))
      addFolder(at->path(), depth, stamps);
  }
}

} // namespace

Stamps stampsOf(const std::vector<std::string> &paths, const std::vector<std::string> &ignored) {
  Stamps stamps;
  for (const std::string &path : paths) {
    std::error_code error;
    const fs::path absolute = normalPath(absolutePath(path));
    const bool isFolder = fs::is_directory(absolute, error);
    const fs::path folder = isFolder ? absolute : absolute.parent_path();
    addFolder(folder, isFolder ? Depth::AllBelow : Depth::FolderAlone, stamps);
    for (fs::path above = folder; above != above.root_path(); above = above.parent_path())
      addFile(above / kConfigFileName, stamps);
  }
  for (const std::string &path : ignored)
    stamps.erase(normalPath(absolutePath(path)));
  return stamps;
}

} // namespace feedhold
