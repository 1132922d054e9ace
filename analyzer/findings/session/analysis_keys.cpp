#include "findings/session/analysis_keys.h"

#include "base/source/path_text.h"
#include "base/support/record.h"
#include "base/support/sha256.h"
#include "findings/project/config.h"
#include "findings/project/sidecars.h"

#include <filesystem>
#include <map>
#include <set>

namespace feedhold {

namespace fs = std::filesystem;

namespace {

/// Files of one folder share it.
std::string hashOf(const Profile &profile) {
  // Names every member, so that one that is new has to be thought of here.
  const auto &[dialect, rules, severities, errorOn, minSeverity] = profile;
  RecordWriter writer;
  writer.text(dialect.id);
  writer.text(textOf(dialect.switches));
  writer.list(rules, [&](const Rule *rule) { writer.text(rule->info.name); });
  writer.list(severities, [&](const SeveritySetting &setting) {
    writer.text(setting.rule);
    writer.number(static_cast<std::uint64_t>(setting.severity));
  });
  writer.number(static_cast<std::uint64_t>(errorOn));
  writer.number(static_cast<std::uint64_t>(minSeverity));
  return sha256(writer.finish());
}

/// The contracts beside the programs and in the folders above, where a set-up may lie.
std::set<fs::path> foldersOf(std::span<const WorkItem> items) {
  std::set<fs::path> folders;
  for (const WorkItem &item : items)
    for (fs::path folder = normalPath(absolutePath(item.path)).parent_path();
         folders.insert(folder).second && folder.has_relative_path();)
      folder = folder.parent_path();
  return folders;
}

void addContracts(RecordWriter &writer, const std::set<fs::path> &folders) {
  std::error_code ignored;
  for (const fs::path &folder : folders) {
    std::map<std::string, std::string> contracts;
    for (const fs::directory_entry &entry : fs::directory_iterator(folder, ignored))
      if (isSidecarName(entry.path()))
        if (const Result<SourceFile> file = SourceFile::open(entry.path()))
          contracts.emplace(pathText(entry.path().filename()), sha256(file.value().text()));
    if (contracts.empty())
      continue;
    writer.text(pathText(folder.lexically_proximate(fs::current_path())));
    writer.list(contracts, [&](const auto &row) {
      writer.text(row.first);
      writer.text(row.second);
    });
  }
}

} // namespace

AnalysisKeys::AnalysisKeys(std::span<const WorkItem> items) {
  std::map<const Profile *, std::string> profiles;
  RecordWriter writer;
  for (const WorkItem &item : items) {
    std::string &profile = profiles[item.profile.get()];
    if (profile.empty())
      profile = hashOf(*item.profile);
    writer.text(item.shown);
    writer.text(sha256(item.source.text()));
    writer.text(profile);
    writer.text(item.foreign == nullptr ? std::string_view() : item.foreign->name);
    writer.number(item.isNamed ? 1 : 0);
    writer.number(item.hasMarks ? 1 : 0);
  }
  addContracts(writer, foldersOf(items));
  run_ = sha256(writer.finish());
}

std::string AnalysisKeys::of(const WorkItem &item) const { return "check " + run_ + " " + item.shown; }

std::string AnalysisKeys::ofInferred() const { return "machines " + run_; }

} // namespace feedhold
