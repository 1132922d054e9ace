// Windows takes paths of more than 260 characters from a process that says so.  The application manifest says it, and
// counts only where an administrator has set LongPathsEnabled; a bit of the process says the same and needs nobody.  It
// is not documented: it is what the runtime of Go sets when it starts (initLongPathSupport in runtime/os_windows.go).
//
// Beside that, mingw-w64 lists folders by way of a buffer of 260 characters (_wopendir), and std::filesystem with it.
// The functions of the same names below take their place.
#include "base/source/long_paths.h"

#include <cerrno>
#include <cwchar>
#include <dirent.h>
#include <filesystem>
#include <memory>

#include <windows.h>
#include <winternl.h>

namespace feedhold {

namespace {

/// What `_WDIR *` points to, and what is read next behind it.
struct Folder {
  _WDIR handed = {};
  HANDLE search = INVALID_HANDLE_VALUE;
  WIN32_FIND_DATAW next = {};
  bool hasNext = false;

  Folder() = default;
  Folder(const Folder &) = delete;
  Folder &operator=(const Folder &) = delete;
  ~Folder() {
    if (search != INVALID_HANDLE_VALUE)
      ::FindClose(search);
  }
};

Folder *folderOf(_WDIR *handed) { return reinterpret_cast<Folder *>(handed); }

int errnoOfLastError() { return ::GetLastError() == ERROR_ACCESS_DENIED ? EACCES : ENOENT; }

/// What windows.h does not declare, or answers as the manifest asks it to.
template <typename Function> Function inNtdll(const char *name) {
  return reinterpret_cast<Function>(reinterpret_cast<void *>(::GetProcAddress(::GetModuleHandleW(L"ntdll.dll"), name)));
}

bool hasLongPaths() {
  constexpr DWORD kMajor = 10;
  constexpr DWORD kBuild = 15063;
  OSVERSIONINFOW about = {};
  about.dwOSVersionInfoSize = sizeof about;
  const auto version = inNtdll<LONG(WINAPI *)(OSVERSIONINFOW *)>("RtlGetVersion");
  if (version == nullptr || version(&about) != 0)
    return false;
  return about.dwMajorVersion > kMajor || (about.dwMajorVersion == kMajor && about.dwBuildNumber >= kBuild);
}

} // namespace

void allowLongPaths() {
  constexpr BYTE kIsLongPathAwareProcess = 0x80;
  const auto block = inNtdll<PEB *(WINAPI *)()>("RtlGetCurrentPeb");
  if (hasLongPaths() && block != nullptr)
    block()->Reserved2[0] |= kIsLongPathAwareProcess; // BitField
}

} // namespace feedhold

extern "C" {

_WDIR *_wopendir(const wchar_t *path) {
  const DWORD attributes = ::GetFileAttributesW(path);
  if (attributes == INVALID_FILE_ATTRIBUTES || (attributes & FILE_ATTRIBUTE_DIRECTORY) == 0) {
    errno = attributes == INVALID_FILE_ATTRIBUTES ? feedhold::errnoOfLastError() : ENOTDIR;
    return nullptr;
  }
  auto folder = std::make_unique<feedhold::Folder>();
  folder->search = ::FindFirstFileW((std::filesystem::path(path) / L"*").c_str(), &folder->next);
  folder->hasNext = folder->search != INVALID_HANDLE_VALUE;
  if (!folder->hasNext && ::GetLastError() != ERROR_FILE_NOT_FOUND) {
    errno = feedhold::errnoOfLastError();
    return nullptr;
  }
  return &folder.release()->handed;
}

_wdirent *_wreaddir(_WDIR *handed) {
  feedhold::Folder *folder = feedhold::folderOf(handed);
  if (!folder->hasNext)
    return nullptr;
  _wdirent &entry = handed->dd_dir;
  std::wmemcpy(entry.d_name, folder->next.cFileName, MAX_PATH);
  entry.d_namlen = static_cast<unsigned short>(std::wcslen(entry.d_name));
  folder->hasNext = ::FindNextFileW(folder->search, &folder->next) != 0;
  return &entry;
}

int _wclosedir(_WDIR *handed) {
  const std::unique_ptr<feedhold::Folder> closed(feedhold::folderOf(handed));
  return 0;
}
}
