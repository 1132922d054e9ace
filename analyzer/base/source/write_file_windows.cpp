// Writing files on Windows: beside the file, brought to the disk, then moved over it.
#include "base/source/write_file.h"

#include "base/source/path_text.h"
#include "base/support/system_words.h"

#include <fmt/format.h>

#include <atomic>
#include <system_error>

#include <windows.h>

namespace feedhold {

namespace fs = std::filesystem;

namespace {

Error systemError(std::string_view what) {
  const std::error_code code(static_cast<int>(::GetLastError()), std::system_category());
  return {fmt::format("{}: {}", what, inWords(code))};
}

bool writeAll(HANDLE file, std::string_view text) {
  constexpr std::size_t kLargestPiece = 1U << 30U;
  while (!text.empty()) {
    DWORD count = 0;
    if (::WriteFile(file, text.data(), static_cast<DWORD>(std::min(text.size(), kLargestPiece)), &count, nullptr) == 0)
      return false;
    text.remove_prefix(count);
  }
  return true;
}

/// A file beside another one, gone again unless it was moved.
class TemporaryFile {
public:
  explicit TemporaryFile(const fs::path &beside) : name_(beside) {
    static std::atomic<unsigned> number = 0;
    name_ += fmt::format(".feedhold-{}-{}", ::GetCurrentProcessId(), ++number);
    handle_ = ::CreateFileW(name_.c_str(), GENERIC_WRITE, 0, nullptr, CREATE_NEW, FILE_ATTRIBUTE_NORMAL, nullptr);
  }
  TemporaryFile(const TemporaryFile &) = delete;
  TemporaryFile &operator=(const TemporaryFile &) = delete;
  ~TemporaryFile() {
    if (!isOpen())
      return;
    close();
    if (!moved_)
      ::DeleteFileW(name_.c_str());
  }

  bool isOpen() const { return handle_ != INVALID_HANDLE_VALUE; }
  bool write(std::string_view text) const { return writeAll(handle_, text); }
  bool flush() const { return ::FlushFileBuffers(handle_) != 0; }

  bool moveTo(const fs::path &path) {
    close();
    moved_ = ::MoveFileExW(name_.c_str(), path.c_str(), MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH) != 0;
    return moved_;
  }
  /// The file that is replaced hands on its permissions.
  bool replace(const fs::path &path) {
    close();
    moved_ =
        ::ReplaceFileW(path.c_str(), name_.c_str(), nullptr, REPLACEFILE_IGNORE_MERGE_ERRORS, nullptr, nullptr) != 0;
    return moved_;
  }

private:
  void close() {
    if (isClosed_)
      return;
    ::CloseHandle(handle_);
    isClosed_ = true;
  }

  fs::path name_;
  HANDLE handle_ = INVALID_HANDLE_VALUE;
  bool isClosed_ = false;
  bool moved_ = false;
};

} // namespace

std::optional<Error> replaceFile(const fs::path &path, std::string_view text) {
  std::error_code error;
  if (!fs::exists(path, error))
    return Error{"no longer exists"};
  const fs::path target = canonicalPath(path, error);
  if (!fs::is_regular_file(target, error))
    return Error{"is not a regular file"};
  if (const DWORD attributes = ::GetFileAttributesW(target.c_str()); (attributes & FILE_ATTRIBUTE_READONLY) != 0) {
    ::SetLastError(ERROR_ACCESS_DENIED);
    return systemError("cannot be written");
  }
  TemporaryFile file(target);
  if (!file.isOpen())
    return systemError("no file can be created in its folder");
  if (!file.write(text) || !file.flush())
    return systemError("the new text cannot be written");
  if (!file.replace(target))
    return systemError("the file cannot be replaced");
  return std::nullopt;
}

std::optional<Error> putFile(const fs::path &path, std::string_view text) {
  TemporaryFile file(path);
  if (!file.isOpen())
    return systemError("no file can be created in its folder");
  if (!file.write(text) || !file.moveTo(path))
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
  if (!file.write(text) || !file.flush())
    return systemError("the text cannot be written");
  if (!file.moveTo(path))
    return systemError("the file cannot be replaced");
  return std::nullopt;
}

std::optional<Error> writeFile(const fs::path &path, std::string_view text) {
  const HANDLE file = ::CreateFileW(path.c_str(), GENERIC_WRITE, FILE_SHARE_READ, nullptr, CREATE_ALWAYS,
                                    FILE_ATTRIBUTE_NORMAL, nullptr);
  if (file == INVALID_HANDLE_VALUE)
    return systemError("cannot be written");
  std::optional<Error> result;
  if (!writeAll(file, text))
    result = systemError("cannot be written");
  ::CloseHandle(file);
  return result;
}

} // namespace feedhold
