// MemoryMap on Windows: a copy of the bytes, because a file that is mapped there cannot be replaced.
#include "base/source/memory_map.h"

#include "base/source/path_text.h"
#include "base/support/system_words.h"

#include <fmt/format.h>

#include <array>
#include <memory>
#include <system_error>
#include <utility>

#include <windows.h>

namespace feedhold {

namespace {

class FileHandle {
public:
  explicit FileHandle(const std::filesystem::path &path)
      : handle_(::CreateFileW(path.c_str(), GENERIC_READ, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE,
                              nullptr, OPEN_EXISTING, FILE_ATTRIBUTE_NORMAL, nullptr)) {}
  FileHandle(const FileHandle &) = delete;
  FileHandle &operator=(const FileHandle &) = delete;
  ~FileHandle() {
    if (isOpen())
      ::CloseHandle(handle_);
  }
  bool isOpen() const { return handle_ != INVALID_HANDLE_VALUE; }
  HANDLE get() const { return handle_; }

private:
  HANDLE handle_;
};

Error systemError(const std::filesystem::path &path, std::string_view what) {
  const std::error_code code(static_cast<int>(::GetLastError()), std::system_category());
  return {fmt::format("cannot {} `{}`: {}", what, pathText(path), inWords(code))};
}

bool readAll(HANDLE file, char *bytes, std::uint64_t size) {
  constexpr std::uint64_t kLargestPiece = 1U << 30U;
  while (size > 0) {
    DWORD count = 0;
    const auto piece = static_cast<DWORD>(size < kLargestPiece ? size : kLargestPiece);
    if (::ReadFile(file, bytes, piece, &count, nullptr) == 0 || count == 0)
      return false;
    bytes += count;
    size -= count;
  }
  return true;
}

} // namespace

Result<MemoryMap> MemoryMap::open(const std::filesystem::path &path, std::uint64_t largestSize) {
  const DWORD attributes = ::GetFileAttributesW(path.c_str());
  if (attributes == INVALID_FILE_ATTRIBUTES)
    return systemError(path, "open");
  if ((attributes & FILE_ATTRIBUTE_DIRECTORY) != 0)
    return Error{fmt::format("`{}` is a folder, not a program", pathText(path))};
  const FileHandle file(path);
  LARGE_INTEGER size = {};
  if (!file.isOpen())
    return systemError(path, "open");
  if (::GetFileType(file.get()) != FILE_TYPE_DISK || ::GetFileSizeEx(file.get(), &size) == 0)
    return Error{fmt::format("`{}` is not a regular file", pathText(path))};
  const auto length = static_cast<std::uint64_t>(size.QuadPart);
  if (length > largestSize)
    return Error{fmt::format("`{}` is larger than {} MiB; split it", pathText(path), largestSize >> 20)};
  if (length == 0)
    return MemoryMap();
  auto bytes = std::make_unique<char[]>(length);
  if (!readAll(file.get(), bytes.get(), length))
    return systemError(path, "read");
  return MemoryMap(std::string_view(bytes.release(), length));
}

MemoryMap::MemoryMap(MemoryMap &&other) noexcept : bytes_(std::exchange(other.bytes_, {})) {}

MemoryMap &MemoryMap::operator=(MemoryMap &&other) noexcept {
  std::swap(bytes_, other.bytes_);
  return *this;
}

MemoryMap::~MemoryMap() { delete[] bytes_.data(); }

} // namespace feedhold
