#include "findings/session/analysis_keys.h"

#include "base/support/record.h"
#include "base/support/sha256.h"
#include "findings/project/config.h"

#include <map>

namespace feedhold {

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
  }
  run_ = sha256(writer.finish());
}

std::string AnalysisKeys::of(const WorkItem &item) const { return "check " + run_ + " " + item.shown; }

std::string AnalysisKeys::ofInferred() const { return "machines " + run_; }

} // namespace feedhold
