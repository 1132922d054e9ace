// The platform on Windows.
#include "surface/cli/platform.h"

#include "base/source/long_paths.h"
#include "base/source/source_file.h"
#include "base/support/sha256.h"

#include <array>
#include <cstdio>
#include <fcntl.h>
#include <io.h>

#include <windows.h>

/// The words of the command line, as every C program for Windows gets them (msvcrt.dll); with `expand`, a word with `*`
/// or `?` becomes the files that it names, as no shell of Windows does it.
extern "C" int __cdecl __wgetmainargs(int *count, wchar_t ***words, wchar_t ***environment, int expand, int *newMode);

namespace feedhold {

namespace {

std::string utf8From(const wchar_t *text) {
  const int size = ::WideCharToMultiByte(CP_UTF8, 0, text, -1, nullptr, 0, nullptr, nullptr);
  std::string result(static_cast<std::size_t>(size > 0 ? size : 1), '\0');
  ::WideCharToMultiByte(CP_UTF8, 0, text, -1, result.data(), size, nullptr, nullptr);
  result.pop_back(); // the 0 at the end
  return result;
}

/// Escape sequences work, which old consoles print as they are.
bool takesSequences(DWORD name) {
  const HANDLE console = ::GetStdHandle(name);
  DWORD mode = 0;
  return ::GetConsoleMode(console, &mode) != 0 &&
         ::SetConsoleMode(console, mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING) != 0;
}

} // namespace

std::vector<std::string> beginProgram(int, char **) {
  allowLongPaths();
  for (std::FILE *stream : {stdin, stdout, stderr})
    ::_setmode(::_fileno(stream), _O_BINARY);
  ::SetConsoleOutputCP(CP_UTF8);
  int count = 0;
  int newMode = 0;
  wchar_t **words = nullptr;
  wchar_t **environment = nullptr;
  std::vector<std::string> result;
  if (::__wgetmainargs(&count, &words, &environment, 1, &newMode) != 0)
    return result;
  for (int i = 1; i < count; ++i)
    result.push_back(utf8From(words[i]));
  return result;
}

bool isTerminal(Stream stream) {
  return takesSequences(stream == Stream::Output ? STD_OUTPUT_HANDLE : STD_ERROR_HANDLE);
}

std::uint64_t processId() { return ::GetCurrentProcessId(); }

std::string buildId() {
  std::array<wchar_t, 32767> path{};
  if (::GetModuleFileNameW(nullptr, path.data(), static_cast<DWORD>(path.size())) == 0)
    return "";
  const Result<SourceFile> program = SourceFile::open(std::filesystem::path(path.data()));
  return program ? sha256(program.value().text()) : "";
}

std::optional<std::filesystem::path> userCache() {
  const wchar_t *folder = ::_wgetenv(L"LOCALAPPDATA");
  if (folder == nullptr || !std::filesystem::path(folder).is_absolute())
    return std::nullopt;
  return std::filesystem::path(folder) / "feedhold" / "cache";
}

} // namespace feedhold
