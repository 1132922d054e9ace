#include "findings/session/file_memory.h"

#include "findings/session/config.h"

#include <algorithm>

namespace feedhold {

namespace {

bool isSame(const Sidecar &a, const Sidecar &b) {
  return a.source.path() == b.source.path() && a.source.text() == b.source.text() && a.program == b.program &&
         a.problem == b.problem;
}

} // namespace

std::shared_ptr<const LoadedFile> FileMemory::reading(const std::filesystem::path &path, const SourceFile &source,
                                                      const Dialect &dialect,
                                                      const std::shared_ptr<const OpenTexts> &open,
                                                      const std::function<Reading()> &read) {
  Reading &known = readings_[{path, std::string(dialect.id) + "\n" + textOf(dialect.switches)}];
  const auto isAsBefore = [&] {
    if (known.file->source.text() != source.text())
      return false;
    const std::vector<Sidecar> now = sidecarsOf(path, known.file->model, open);
    return std::equal(now.begin(), now.end(), known.sidecars.begin(), known.sidecars.end(), isSame);
  };
  if (known.file == nullptr || !isAsBefore())
    known = read();
  return known.file;
}

} // namespace feedhold
