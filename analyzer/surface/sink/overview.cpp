// The programs with findings, worst first: what a foreman reads in ten seconds.
#include "surface/sink/counts.h"
#include "surface/sink/shown.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace feedhold {

namespace {

constexpr std::size_t kProgramsShown = 10;

struct ProgramRow {
  std::string program;
  SeverityCounts counts;
};

/// The file, and the program where the file holds several.  Subroutines of o-words are parts of one program.
std::string programOf(const CheckedFile &file, const Finding &finding) {
  const auto after = std::find_if(file.programs.begin(), file.programs.end(), [&](const ProgramHead &head) {
    return finding.diagnostic.span.begin < head.header.begin;
  });
  const bool hasOWords = std::any_of(file.programs.begin(), file.programs.end(),
                                     [](const ProgramHead &head) { return head.name.starts_with('o'); });
  if (file.programs.size() < 2 || hasOWords || after == file.programs.begin() || std::prev(after)->name.empty())
    return file.path;
  return fmt::format("{} in {}", std::prev(after)->name, file.path);
}

bool isWorse(const ProgramRow &a, const ProgramRow &b) {
  for (const Severity severity : {Severity::Error, Severity::Warning, Severity::Info})
    if (a.counts.of(severity) != b.counts.of(severity))
      return a.counts.of(severity) > b.counts.of(severity);
  return false;
}

} // namespace

std::string programsOverview(const Report &report) {
  std::map<std::string, SeverityCounts> byProgram;
  forEachShown(report, [&](const CheckedFile &file, const Finding &finding) {
    if (!finding.suppressed && file.foreign.empty())
      byProgram[programOf(file, finding)].add(finding.severity);
  });
  if (byProgram.size() < 2)
    return "";
  std::vector<ProgramRow> rows;
  for (const auto &[program, counts] : byProgram)
    rows.push_back({program, counts});
  std::stable_sort(rows.begin(), rows.end(), isWorse);
  const std::size_t shown = std::min(rows.size(), kProgramsShown);
  std::size_t width = 0;
  for (std::size_t i = 0; i < shown; ++i)
    width = std::max(width, rows[i].counts.inWords().size());
  std::string text = "worst first:\n";
  for (std::size_t i = 0; i < shown; ++i)
    text += fmt::format("  {:<{}}  {}\n", rows[i].counts.inWords(), width, rows[i].program);
  if (rows.size() > shown)
    text += fmt::format("  and {} more program{} with findings\n", rows.size() - shown,
                        rows.size() - shown == 1 ? "" : "s");
  return text + "\n";
}

} // namespace feedhold
