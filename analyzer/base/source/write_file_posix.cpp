// On POSIX systems: writes beside the file, brings the bytes to the disk, then renames.
#include "base/source/write_file.h"

#include "base/support/system_words.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace feedhold {

namespace fs = std::filesystem;

namespace {

Error systemError(std::string_view what) { return {fmt::format("{}: {}", what, std::strerror(errno))}; }

/// A file beside another one, gone again unless it was renamed.
class TemporaryFile {
public:
  explicit TemporaryFile(const fs::path &beside) : name_(beside.string() + ".feedhold-XXXXXX") {
    descriptor_ = ::mkstemp(name_.data());
  }
  TemporaryFile(const TemporaryFile &) = delete;
  TemporaryFile &operator=(const TemporaryFile &) = delete;
  ~TemporaryFile() {
    if (descriptor_ >= 0)
      ::close(descriptor_);
    if (descriptor_ >= 0 && !renamed_)
      ::unlink(name_.c_str());
  }

  bool isOpen() const { return descriptor_ >= 0; }

  bool write(std::string_view text) const {
    while (!text.empty()) {
      const ssize_t written = ::write(descriptor_, text.data(), text.size());
      if (written < 0 && errno != EINTR)
        return false;
      text.remove_prefix(written < 0 ? 0 : static_cast<std::size_t>(written));
    }
    return true;
  }

  /// The owner is kept where we may set it; where not, the file is ours and the permissions still hold.
  bool takeOwnerAndMode(const struct stat &original) const {
    const bool ownerKept = ::fchown(descriptor_, original.st_uid, original.st_gid) == 0;
    const mode_t mode = original.st_mode & (ownerKept ? 07777U : 0777U);
    return ::fchmod(descriptor_, mode) == 0;
  }

  /// What the mask of the process leaves; it can only be read by setting it.
  bool takeUsualMode() const {
    const mode_t mask = ::umask(0077);
    ::umask(mask);
    return ::fchmod(descriptor_, 0666U & ~mask) == 0;
  }

  bool flush() const { return ::fsync(descriptor_) == 0; }

  bool renameTo(const fs::path &path) {
    renamed_ = ::rename(name_.c_str(), path.c_str()) == 0;
    return renamed_;
  }

private:
  std::string name_;
  int descriptor_ = -1;
  bool renamed_ = false;
};

} // namespace

std::optional<Error> replaceFile(const fs::path &path, std::string_view text) {
  std::error_code error;
  const fs::path target = fs::canonical(path, error);
  if (error)
    return Error{fmt::format("no longer exists: {}", inWords(error))};
  struct stat original {};
  if (::stat(target.c_str(), &original) != 0)
    return systemError("its permissions cannot be read");
  if (!S_ISREG(original.st_mode)) // a device would be gone behind the rename
    return Error{"is not a regular file"};
  if (::access(target.c_str(), W_OK) != 0)
    return systemError("cannot be written");
  TemporaryFile file(target);
  if (!file.isOpen())
    return systemError("no file can be created in its folder");
  if (!file.write(text) || !file.takeOwnerAndMode(original) || !file.flush())
    return systemError("the new text cannot be written");
  if (!file.renameTo(target))
    return systemError("the file cannot be replaced");
  return std::nullopt;
}

std::optional<Error> putFile(const fs::path &path, std::string_view text) {
  TemporaryFile file(path);
  if (!file.isOpen())
    return systemError("no file can be created in its folder");
  if (!file.write(text) || !file.renameTo(path))
    return systemError("the file cannot be replaced");
  return std::nullopt;
}

std::optional<Error> saveFile(const fs::path &path, std::string_view text) {
  std::error_code ignored;
  if (fs::exists(path, ignored))
    return replaceFile(path, text);
  TemporaryFile file(path);
  if (!file.isOpen())
    return systemError("no file can be created in its folder");
  if (!file.write(text) || !file.takeUsualMode() || !file.flush())
    return systemError("the text cannot be written");
  if (!file.renameTo(path))
    return systemError("the file cannot be replaced");
  return std::nullopt;
}

std::optional<Error> writeFile(const fs::path &path, std::string_view text) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor < 0)
    return systemError("cannot be written");
  bool good = true;
  while (good && !text.empty()) {
    const ssize_t written = ::write(descriptor, text.data(), text.size());
    good = written >= 0 || errno == EINTR;
    text.remove_prefix(written < 0 ? 0 : static_cast<std::size_t>(written));
  }
  std::optional<Error> result;
  if (!good)
    result = systemError("cannot be written");
  if (::close(descriptor) != 0 && good)
    result = systemError("cannot be written");
  return result;
}

} // namespace feedhold
