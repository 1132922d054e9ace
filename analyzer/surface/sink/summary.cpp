// The last lines of a run: counts and what to do next.
#include "surface/sink/counts.h"
#include "surface/sink/shown.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace feedhold {

namespace {

constexpr std::size_t kSkippedShown = 5;
constexpr std::size_t kFilesShown = 5; // of a dialect

struct Counts {
  SeverityCounts findings;
  std::size_t safeFixes = 0;
  std::size_t otherFixes = 0;
  std::size_t suppressed = 0;
  std::size_t hidden = 0; // below the severity that is shown
};

void countFixes(const Finding &finding, Counts &counts) {
  const std::vector<FixIt> &fixes = finding.diagnostic.fixes;
  if (fixes.empty())
    return;
  const bool isSafe =
      std::any_of(fixes.begin(), fixes.end(), [](const FixIt &fix) { return fix.safety == FixSafety::Safe; });
  ++(isSafe ? counts.safeFixes : counts.otherFixes);
}

Counts count(const Report &report) {
  Counts counts;
  for (const CheckedFile &file : report.result.files) {
    counts.hidden += hiddenIn(file);
    for (const Finding &finding : file.findings) {
      if (finding.suppressed) {
        ++counts.suppressed;
      } else if (isReported(finding, file)) {
        counts.findings.add(finding.severity);
        countFixes(finding, counts);
      }
    }
  }
  return counts;
}

std::size_t countOf(const CheckResult &result, SkipKind kind) {
  return static_cast<std::size_t>(std::count_if(result.skipped.begin(), result.skipped.end(),
                                                [kind](const SkippedFile &skipped) { return skipped.kind == kind; }));
}

std::string hiddenPart(const Counts &counts) {
  return counts.hidden == 0 ? ""
                            : fmt::format("{} of lower severity {} not shown: --severity info shows {}\n",
                                          counted(counts.hidden, "finding"), counts.hidden == 1 ? "is" : "are",
                                          counts.hidden == 1 ? "it" : "them");
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

std::string_view choiceInWords(DialectChoice choice) {
  switch (choice) {
  case DialectChoice::Option: return "by --dialect";
  case DialectChoice::FilePattern: return "by a pattern of feedhold.toml";
  case DialectChoice::Config: return "by feedhold.toml";
  case DialectChoice::Guess: return "by its text";
  case DialectChoice::FolderVote: return "by the other files of its folder";
  case DialectChoice::Fallback: break; // has a line of its own
  }
  FEEDHOLD_UNREACHABLE("a way to choose a dialect");
}

using FilesByChoice = std::map<DialectChoice, std::vector<std::string_view>>;

/// Where all files have one dialect, their number says it.
std::string filesInWords(const std::vector<std::string_view> &files, bool isOnlyDialect) {
  if (isOnlyDialect)
    return "";
  const std::vector<std::string_view> first(
      files.begin(), files.begin() + static_cast<std::ptrdiff_t>(std::min(files.size(), kFilesShown)));
  const std::string more = files.size() > kFilesShown ? fmt::format(" and {} more", files.size() - kFilesShown) : "";
  return fmt::format(" ({}{})", fmt::join(first, ", "), more);
}

/// Nothing in these files shows their control: what is said of them may be wrong throughout.
std::string unshownPart(std::string_view dialect, const std::vector<std::string_view> &files) {
  return fmt::format("{} not show which control {} for, and {} checked as {}{}: set the right one\n",
                     files.size() == 1 ? "1 file does" : fmt::format("{} files do", files.size()),
                     files.size() == 1 ? "it is" : "they are", files.size() == 1 ? "was" : "were", dialect,
                     filesInWords(files, false));
}

/// A line for each dialect: how many files, or which where there are several dialects, and who chose it.
std::string dialectsInWords(const CheckResult &result) {
  std::map<std::string_view, FilesByChoice> chosen;
  bool isGuessed = false;
  for (const CheckedFile &file : result.files) {
    if (file.isOnlyCalled || !isReadProgram(file))
      continue;
    chosen[file.dialect][file.choice].push_back(file.path);
    isGuessed = isGuessed || file.choice >= DialectChoice::Guess;
  }
  std::string text;
  for (const auto &[dialect, choices] : chosen) {
    std::vector<std::string> parts;
    for (const auto &[choice, files] : choices)
      if (choice == DialectChoice::Fallback)
        text += unshownPart(dialect, files);
      else
        parts.push_back(
            fmt::format("{} {}{}", files.size(), choiceInWords(choice), filesInWords(files, chosen.size() == 1)));
    if (!parts.empty())
      text += fmt::format("dialect {}: {}\n", dialect, fmt::join(parts, ", "));
  }
  return isGuessed ? text + "to choose another dialect, set `dialect` in feedhold.toml or give --dialect\n" : text;
}

/// What was concluded from the programs, with the line that settles it.
std::string inferredPart(const CheckResult &result) {
  std::string text;
  for (const InferredSetting &setting : result.inferred) {
    const std::string folder = setting.folder.empty() ? "." : setting.folder;
    const std::string where = setting.table.empty() ? "" : fmt::format(" under [{}]", setting.table);
    text += fmt::format("{}: read as a machine with `{}` ({}); to settle it, write this line{} in feedhold.toml\n",
                        folder, setting.line, setting.evidence, where);
  }
  return text;
}

} // namespace

std::string summary(const Report &report) {
  const Counts counts = count(report);
  const CheckResult &result = report.result;
  const auto checked = std::count_if(result.files.begin(), result.files.end(),
                                     [](const CheckedFile &file) { return !file.isOnlyCalled && isReadProgram(file); });
  std::string head =
      fmt::format("{} in {}", counts.findings.inWords(), counted(static_cast<std::size_t>(checked), "file"));
  if (counts.suppressed != 0)
    head += fmt::format(", {} allowed", counts.suppressed);
  const auto foreign = std::count_if(result.files.begin(), result.files.end(),
                                     [](const CheckedFile &file) { return !file.foreign.empty(); });
  const std::size_t refused = countOf(result, SkipKind::Refused) + static_cast<std::size_t>(foreign);
  const std::size_t others = countOf(result, SkipKind::NoProgram);
  if (refused != 0)
    head += fmt::format(", {} refused", counted(refused, "file"));
  if (others != 0)
    head += fmt::format(", {} {}", counted(others, "file"), others == 1 ? "is no NC program" : "are no NC programs");
  if (!result.errors.empty())
    head += fmt::format(", {} not checked", counted(result.errors.size(), "file"));
  return programsOverview(report) + head + "\n" + hiddenPart(counts) + fixesPart(counts) + dialectsInWords(result) +
         inferredPart(result);
}

std::string skippedFiles(const std::vector<SkippedFile> &files) {
  std::string text;
  std::size_t shown = 0;
  for (const SkippedFile &skipped : files)
    if (skipped.kind == SkipKind::Refused && ++shown <= kSkippedShown)
      text += fmt::format("refused {}: {}\n", skipped.path, skipped.reason);
  if (shown > kSkippedShown)
    text += fmt::format("refused {} more; --format json lists all\n", shown - kSkippedShown);
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
