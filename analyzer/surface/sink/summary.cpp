// The last lines of a run: counts and what to do next.
#include "surface/sink/shown.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

namespace feedhold {

namespace {

constexpr std::size_t kSkippedShown = 5;

std::string counted(std::size_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

struct Counts {
  std::array<std::size_t, 3> bySeverity{};
  std::size_t safeFixes = 0;
  std::size_t otherFixes = 0;
  std::size_t suppressed = 0;

  std::size_t of(Severity severity) const { return bySeverity[static_cast<std::size_t>(severity)]; }
  std::size_t all() const { return bySeverity[0] + bySeverity[1] + bySeverity[2]; }
};

Counts count(const Report &report) {
  Counts counts;
  for (const CheckedFile &file : report.result.files) {
    for (const Finding &finding : file.findings) {
      if (finding.suppressed) {
        ++counts.suppressed;
        continue;
      }
      ++counts.bySeverity[static_cast<std::size_t>(finding.severity)];
      const std::vector<FixIt> &fixes = finding.diagnostic.fixes;
      const bool isSafe =
          std::any_of(fixes.begin(), fixes.end(), [](const FixIt &fix) { return fix.safety == FixSafety::Safe; });
      ++(isSafe ? counts.safeFixes : counts.otherFixes);
      if (fixes.empty())
        --counts.otherFixes;
    }
  }
  return counts;
}

std::string findingsPart(const Counts &counts) {
  if (counts.all() == 0)
    return "no findings";
  std::vector<std::string> parts;
  for (const Severity severity : {Severity::Error, Severity::Warning, Severity::Info})
    if (counts.of(severity) != 0)
      parts.push_back(severity == Severity::Info ? fmt::format("{} info", counts.of(severity))
                                                 : counted(counts.of(severity), nameOf(severity)));
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string fixesPart(const Counts &counts) {
  std::string text;
  if (counts.safeFixes != 0)
    text += fmt::format("{} can be fixed with --fix\n", counted(counts.safeFixes, "finding"));
  if (counts.otherFixes != 0)
    text += fmt::format("{} a fix that needs your review: --diff --unsafe-fixes shows {}\n",
                        counts.otherFixes == 1 ? "1 finding has" : fmt::format("{} findings have", counts.otherFixes),
                        counts.otherFixes == 1 ? "it" : "them");
  return text;
}

std::string guessesPart(const CheckResult &result) {
  std::map<std::string_view, std::size_t> guessed;
  for (const CheckedFile &file : result.files)
    if (!file.isOnlyCalled && (file.choice == DialectChoice::Guess || file.choice == DialectChoice::Fallback))
      ++guessed[file.dialect];
  std::string text;
  for (const auto &[dialect, files] : guessed)
    text += fmt::format("guessed dialect {} for {}; set `dialect` in feedhold.toml or give --dialect\n", dialect,
                        counted(files, "file"));
  return text;
}

} // namespace

std::string summary(const Report &report) {
  const Counts counts = count(report);
  const CheckResult &result = report.result;
  const auto checked = std::count_if(result.files.begin(), result.files.end(),
                                     [](const CheckedFile &file) { return !file.isOnlyCalled; });
  std::string head = fmt::format("{} in {}", findingsPart(counts), counted(static_cast<std::size_t>(checked), "file"));
  if (counts.suppressed != 0)
    head += fmt::format(", {} allowed", counts.suppressed);
  if (!result.skipped.empty())
    head += fmt::format(", {} skipped", counted(result.skipped.size(), "file"));
  if (!result.errors.empty())
    head += fmt::format(", {} not checked", counted(result.errors.size(), "file"));
  return head + "\n" + fixesPart(counts) + guessesPart(result);
}

std::string skippedFiles(const Report &report) {
  const CheckResult &result = report.result;
  std::string text;
  for (std::size_t i = 0; i < std::min(result.skipped.size(), kSkippedShown); ++i)
    text += fmt::format("skipped {}: {}\n", result.skipped[i].path, result.skipped[i].reason);
  if (result.skipped.size() > kSkippedShown)
    text += fmt::format("skipped {} more; --format json lists all\n", result.skipped.size() - kSkippedShown);
  return text;
}

std::string statistics(const Report &report) {
  std::map<std::string_view, std::size_t> byRule;
  forEachShown(report, [&](const CheckedFile &, const Finding &finding) { ++byRule[finding.rule->name]; });
  std::vector<std::pair<std::string_view, std::size_t>> rows(byRule.begin(), byRule.end());
  std::stable_sort(rows.begin(), rows.end(), [](const auto &a, const auto &b) { return a.second > b.second; });
  std::string text;
  for (const auto &[rule, findings] : rows)
    text += fmt::format("{:>7} {}\n", findings, rule);
  return text;
}

} // namespace feedhold
