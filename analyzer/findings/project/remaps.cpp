// Reads `REMAP=` lines.  Files that an `.ini` includes are not read, nor remaps of T, S and F, which have no number.
#include "findings/project/remaps.h"

#include "base/source/path_text.h"
#include "base/source/source_file.h"
#include "base/support/text.h"

#include <set>

namespace feedhold {

namespace {

constexpr std::string_view kSection = "[RS274NGC]";
constexpr std::string_view kKey = "REMAP";

void addRemaps(const SourceFile &ini, std::vector<CodeName> &codes) {
  bool isInSection = false;
  for (std::uint32_t i = 1; i <= ini.lineCount(); ++i) {
    const std::string_view line = trimmed(ini.text(ini.lineSpan(i)));
    if (line.starts_with('['))
      isInSection = line.starts_with(kSection);
    const std::size_t equals = line.find('=');
    if (!isInSection || equals == std::string_view::npos || trimmed(line.substr(0, equals)) != kKey)
      continue;
    const std::string_view value = trimmed(line.substr(equals + 1));
    if (const auto code = codeNamed(value.substr(0, value.find_first_of(" \t")), "GM"))
      codes.push_back(*code);
  }
}

std::vector<CodeName> remapsIn(const std::filesystem::path &folder) {
  std::vector<CodeName> codes;
  std::error_code error; // a folder that cannot be listed has no settings for us
  for (std::filesystem::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    std::error_code ignored;
    if (!isRemapFileName(at->path()) || !at->is_regular_file(ignored))
      continue;
    if (Result<SourceFile> ini = SourceFile::open(at->path()))
      addRemaps(ini.value(), codes);
  }
  return codes;
}

} // namespace

bool isRemapFileName(const std::filesystem::path &path) { return toLower(pathText(path.extension())) == ".ini"; }

std::vector<CodeName> RemapFinder::inFolders(const std::vector<std::filesystem::path> &folders) {
  std::set<CodeName> all;
  for (const std::filesystem::path &folder : folders) {
    auto known = byFolder_.find(folder);
    if (known == byFolder_.end())
      known = byFolder_.emplace(folder, remapsIn(folder)).first;
    all.insert(known->second.begin(), known->second.end());
  }
  return {all.begin(), all.end()};
}

} // namespace feedhold
