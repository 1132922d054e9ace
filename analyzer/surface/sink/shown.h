// What several sinks need: the findings that are shown and where they are.  Internal to sink/.
#pragma once

#include "findings/project/sidecars.h"
#include "surface/sink/sink.h"

namespace feedhold {

inline bool isShown(const Finding &finding, const Report &report) {
  return !finding.suppressed || report.showSuppressed == ShowSuppressed::Yes;
}

/// Not one in another language, nor a file with contracts beside a program.
inline bool isReadProgram(const CheckedFile &file) { return file.foreign.empty() && !isSidecarName(file.path); }

/// Calls `visit(file, finding)` for every finding that is shown, in order.
template <typename Visit> void forEachShown(const Report &report, Visit visit) {
  for (const CheckedFile &file : report.result.files)
    for (const Finding &finding : file.findings)
      if (isShown(finding, report))
        visit(file, finding);
}

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
