#include "findings/project/open_texts.h"

namespace feedhold {

namespace fs = std::filesystem;

fs::path placeOf(const fs::path &path) {
  std::error_code error;
  const fs::path place = fs::weakly_canonical(path, error);
  return error ? fs::absolute(path).lexically_normal() : place;
}

Result<SourceFile> openSource(const fs::path &path, const std::shared_ptr<const OpenTexts> &open) {
  if (!open)
    return SourceFile::open(path);
  auto known = open->find(fs::absolute(path).lexically_normal());
  if (known == open->end() && !open->empty())
    known = open->find(placeOf(path));
  if (known != open->end())
    return SourceFile::fromText(path.generic_string(), *known->second);
  Result<SourceFile> onDisk = SourceFile::open(path);
  return onDisk ? SourceFile::fromText(path.generic_string(), std::string(onDisk.value().text())) : onDisk;
}

} // namespace feedhold
