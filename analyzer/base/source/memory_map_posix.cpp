// MemoryMap on POSIX systems.
#include "base/source/memory_map.h"

#include <fmt/format.h>

#include <cerrno>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace feedhold {

namespace {

class Descriptor {
public:
  // O_NONBLOCK: opening a pipe must not wait for its writer; it is refused below.
  explicit Descriptor(const char *path) : number_(::open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {}
  Descriptor(const Descriptor &) = delete;
  Descriptor &operator=(const Descriptor &) = delete;
  ~Descriptor() {
    if (number_ >= 0)
      ::close(number_);
  }
  int number() const { return number_; }

private:
  int number_;
};

Error systemError(const std::filesystem::path &path, std::string_view what) {
  return {fmt::format("cannot {} `{}`: {}", what, path.string(), std::generic_category().message(errno))};
}

} // namespace

Result<MemoryMap> MemoryMap::open(const std::filesystem::path &path, std::uint64_t largestSize) {
  const Descriptor file(path.c_str());
  struct stat status = {};
  if (file.number() < 0 || ::fstat(file.number(), &status) != 0)
    return systemError(path, "open");
  if (S_ISDIR(status.st_mode))
    return Error{fmt::format("`{}` is a folder, not a program", path.string())};
  if (!S_ISREG(status.st_mode))
    return Error{fmt::format("`{}` is not a regular file", path.string())};
  const auto size = static_cast<std::uint64_t>(status.st_size);
  if (size > largestSize)
    return Error{fmt::format("`{}` is larger than {} MiB; split it", path.string(), largestSize >> 20)};
  if (size == 0) // mmap refuses an empty range
    return MemoryMap();
  void *address = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file.number(), 0);
  if (address == MAP_FAILED)
    return systemError(path, "read");
  return MemoryMap(std::string_view(static_cast<const char *>(address), size));
}

MemoryMap::MemoryMap(MemoryMap &&other) noexcept : bytes_(std::exchange(other.bytes_, {})) {}

MemoryMap &MemoryMap::operator=(MemoryMap &&other) noexcept {
  std::swap(bytes_, other.bytes_);
  return *this;
}

MemoryMap::~MemoryMap() {
  if (!bytes_.empty())
    ::munmap(const_cast<char *>(bytes_.data()), bytes_.size());
}

} // namespace feedhold
