#include "mutation/packages.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <regex>
#include <set>

namespace feedhold::mutation {

namespace fs = std::filesystem;
using soundness::ProgramLines;

namespace {

constexpr std::string_view kPackages = "packages/";

struct ManifestEntry {
  std::string path;
  std::string dialect = {};
  bool isProved = false;
  bool isOpen = false;    // some claim is refuted, or unknown
  bool hasAlarms = false; // it can raise some
};

std::vector<ManifestEntry> manifest(const fs::path &corpus) {
  constexpr std::string_view kPath = "path = \"";
  constexpr std::string_view kDialect = "dialect = \"";
  const auto quoted = [](const std::string &line, std::string_view key) {
    return line.substr(key.size(), line.size() - key.size() - 1);
  };
  std::vector<ManifestEntry> entries;
  std::ifstream file(corpus / "manifest.toml");
  bool isOpenList = false;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with(kPath))
      entries.push_back({quoted(line, kPath)});
    if (entries.empty())
      continue;
    if (line.find(" = ") != std::string::npos)
      isOpenList = line.starts_with("refuted") || line.starts_with("unknown");
    ManifestEntry &entry = entries.back();
    if (line.starts_with(kDialect))
      entry.dialect = quoted(line, kDialect);
    entry.isProved = entry.isProved || line.starts_with("proved");
    const bool isAlarm = line.find(".alarm-unreachable.") != std::string::npos;
    entry.hasAlarms = entry.hasAlarms || (isOpenList && isAlarm);
    entry.isOpen = entry.isOpen || (isOpenList && !isAlarm && line.find("\"O") != std::string::npos);
  }
  return entries;
}

/// The file of a program, in the folder of its caller or around it.
std::optional<fs::path> fileOf(int number, const fs::path &folder) {
  std::vector<fs::path> files;
  for (const fs::path &place : {folder, folder.parent_path()})
    for (const auto &entry : fs::directory_iterator(place)) {
      const std::string name = entry.path().stem().string();
      if (entry.path().extension() == ".nc" && name.starts_with('O') && std::stoi(name.substr(1)) == number)
        return entry.path();
    }
  return std::nullopt;
}

void appendWithCalled(ProgramLines &lines, std::set<fs::path> &known, const fs::path &path) {
  if (!known.insert(path).second)
    return;
  static const std::regex call("(?:G65|G66|M98) ?P([0-9]+)");
  const ProgramLines own = linesOf(path.string());
  std::ranges::copy(own, std::back_inserter(lines));
  for (const std::string &line : own) {
    const std::string block = line.substr(0, line.find('('));
    if (std::smatch match; std::regex_search(block, match, call))
      if (const auto file = fileOf(std::stoi(match[1]), path.parent_path()))
        appendWithCalled(lines, known, *file);
  }
}

} // namespace

ProgramLines linesOf(const std::string &path) {
  std::ifstream file(path);
  ProgramLines lines;
  for (std::string line; std::getline(file, line);)
    if (line != "%")
      lines.push_back(line);
  return lines;
}

std::vector<PackageText> provedPackages() {
  const fs::path corpus = fs::path(FEEDHOLD_ROOT) / "corpus";
  std::vector<PackageText> packages;
  for (const ManifestEntry &entry : manifest(corpus)) {
    if (!entry.path.starts_with(kPackages) || !entry.isProved || entry.isOpen)
      continue;
    const fs::path path = corpus / entry.path;
    const std::string name = (fs::path(entry.path).parent_path() / path.stem()).string().substr(kPackages.size());
    PackageText package{name.substr(0, name.find('/')), name, entry.dialect, {}};
    std::set<fs::path> known;
    appendWithCalled(package.lines, known, path);
    const bool promisesAlarms =
        std::ranges::any_of(package.lines, [](const std::string &line) { return line.starts_with("(@ALARM"); });
    if (entry.hasAlarms && !promisesAlarms)
      continue;
    packages.push_back(std::move(package));
  }
  return packages;
}

} // namespace feedhold::mutation
