#include "findings/project/file_store.h"

#include "findings/project/config.h"

#include <algorithm>

namespace feedhold {

namespace {

bool isSame(const Sidecar &a, const Sidecar &b) {
  return a.source.path() == b.source.path() && a.source.text() == b.source.text() && a.program == b.program &&
         a.problem == b.problem;
}

} // namespace

bool FileStore::isAsBefore(const ProjectFile &known, const OpenedFile &file,
                           const std::shared_ptr<const OpenTexts> &open) const {
  if (lifetime_ == Lifetime::Run)
    return true;
  if (known.source.text() != file.source.text())
    return false;
  const std::vector<Sidecar> now = sidecarsOf(file.path, known.model, open);
  return std::equal(now.begin(), now.end(), known.sidecars.begin(), known.sidecars.end(), isSame);
}

std::shared_ptr<const Folder> FileStore::folder(const std::filesystem::path &folder,
                                                const std::function<Folder()> &list) {
  if (lifetime_ == Lifetime::Server)
    return std::make_shared<const Folder>(list());
  const std::lock_guard lock(mutex_);
  auto &known = folders_[folder];
  if (!known)
    known = std::make_shared<const Folder>(list());
  return known;
}

std::shared_ptr<const ProjectFile> FileStore::read(const OpenedFile &file,
                                                   const std::shared_ptr<const OpenTexts> &open) {
  if (file.path.empty())
    return readFile(file, open);
  const Key key{file.path, file.shown, std::string(file.dialect->id) + "\n" + textOf(file.dialect->switches)};
  std::shared_ptr<const ProjectFile> known;
  {
    const std::lock_guard lock(mutex_);
    known = files_[key];
  }
  if (known && isAsBefore(*known, file, open))
    return known;
  auto anew = readFile(file, open); // without the lock: two threads may parse one file, and either result serves
  const std::lock_guard lock(mutex_);
  return files_[key] = std::move(anew);
}

} // namespace feedhold
