#include "findings/project/open_texts.h"

#include "base/source/path_text.h"

namespace feedhold {

namespace fs = std::filesystem;

fs::path placeOf(const fs::path &path) {
  std::error_code error;
  const fs::path place = canonicalPath(path, error);
  return error ? normalPath(absolutePath(path)) : place;
}

Result<SourceFile> openSource(const fs::path &path, const std::shared_ptr<const OpenTexts> &open) {
  if (!open)
    return SourceFile::open(path);
  auto known = open->find(normalPath(absolutePath(path)));
  if (known == open->end() && !open->empty())
    known = open->find(placeOf(path));
  if (known != open->end())
    return SourceFile::fromText(pathText(path), *known->second);
  Result<SourceFile> onDisk = SourceFile::open(path);
  return onDisk ? SourceFile::fromText(pathText(path), std::string(onDisk.value().text())) : onDisk;
}

} // namespace feedhold
