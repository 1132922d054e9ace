#include "findings/session/open_texts.h"

namespace feedhold {

Result<SourceFile> openSource(const std::filesystem::path &path, const std::shared_ptr<const OpenTexts> &open) {
  if (open && !open->empty()) {
    const auto known = open->find(std::filesystem::absolute(path).lexically_normal());
    if (known != open->end())
      return SourceFile::fromText(path.generic_string(), *known->second);
  }
  return SourceFile::open(path);
}

} // namespace feedhold
