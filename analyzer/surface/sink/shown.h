// What several sinks need: the findings that are shown and where they are.  Internal to sink/.
#pragma once

#include "findings/project/sidecars.h"
#include "surface/sink/sink.h"

#include <algorithm>

namespace feedhold {

inline bool isShown(const Finding &finding, const CheckedFile &file, const Report &report) {
  return isReported(finding, file) && (!finding.suppressed || report.showSuppressed == ShowSuppressed::Yes);
}

/// Not one in another language, nor a file with contracts beside a program.
inline bool isReadProgram(const CheckedFile &file) { return file.foreign.empty() && !isSidecarName(file.path); }

/// Findings that are left out because of their severity.
inline std::size_t hiddenIn(const CheckedFile &file) {
  return static_cast<std::size_t>(
      std::count_if(file.findings.begin(), file.findings.end(),
                    [&](const Finding &finding) { return !finding.suppressed && !isReported(finding, file); }));
}

/// Calls `visit(file, finding)` for every finding that is shown, in order.
template <typename Visit> void forEachShown(const Report &report, Visit visit) {
  for (const CheckedFile &file : report.result.files)
    for (const Finding &finding : file.findings)
      if (isShown(finding, file, report))
        visit(file, finding);
}

/// The programs with findings, worst first; empty for fewer than two.
std::string programsOverview(const Report &report);

struct TextRegion {
  Position begin;
  Position end; // just behind the last character
};
/// Columns in characters.
inline TextRegion regionOf(const SourceFile &source, Span span) {
  return {source.position(span.begin), source.position(span.end)};
}

/// The message and its notes, a line for each.
inline std::string messageWithNotes(const Diagnostic &diagnostic) {
  std::string text = diagnostic.message;
  for (const std::string &note : diagnostic.notes)
    text += "\n" + note;
  return text;
}

} // namespace feedhold
