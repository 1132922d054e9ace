// diskPath on Windows, which finds `O1.NC` where the file is named `o1.nc`.
#include "base/source/disk_path.h"

#include "base/source/path_text.h"

#include <string>

#include <windows.h>

namespace feedhold {

namespace {

/// Without `\\?\`, which stands in front of all.
std::filesystem::path plain(const std::wstring &path) {
  constexpr std::wstring_view kShare = L"\\\\?\\UNC\\";
  constexpr std::wstring_view kLocal = L"\\\\?\\";
  if (path.starts_with(kShare))
    return L"\\\\" + path.substr(kShare.size());
  return path.starts_with(kLocal) ? path.substr(kLocal.size()) : path;
}

} // namespace

std::filesystem::path diskPath(const std::filesystem::path &path) {
  constexpr DWORD kAll = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;
  constexpr DWORD kFoldersAndLinks = FILE_FLAG_BACKUP_SEMANTICS | FILE_FLAG_OPEN_REPARSE_POINT;
  const HANDLE file = ::CreateFileW(path.c_str(), 0, kAll, nullptr, OPEN_EXISTING, kFoldersAndLinks, nullptr);
  if (file == INVALID_HANDLE_VALUE)
    return normalPath(absolutePath(path));
  std::wstring text(32767, L'\0'); // the longest path there is
  const DWORD size = ::GetFinalPathNameByHandleW(file, text.data(), static_cast<DWORD>(text.size()), 0);
  ::CloseHandle(file);
  if (size == 0 || size >= text.size())
    return normalPath(absolutePath(path));
  text.resize(size);
  return plain(text);
}

} // namespace feedhold
