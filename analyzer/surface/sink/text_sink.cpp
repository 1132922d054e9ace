// For people at a terminal: the program text with carets, or one line for each finding.
#include "base/diag/render.h"
#include "surface/sink/causes.h"
#include "surface/sink/shown.h"

#include <fmt/format.h>

namespace feedhold {

namespace {

/// One line: what is in the file does not matter.
std::string refusal(const CheckedFile &file, const Finding &finding) {
  const std::string reasons = file.reasons.empty() ? "" : fmt::format(" ({})", fmt::join(file.reasons, "; "));
  return fmt::format("{}: {}: {}{} [{}]\n", nameOf(finding.severity), file.path, finding.diagnostic.message, reasons,
                     finding.rule->name);
}

} // namespace

std::string writeText(const Report &report) {
  std::string text;
  std::string refusals; // behind the findings, where they are seen
  const auto fileOf = [&](FileId id) -> const SourceFile & { return report.result.files[id.index()].source; };
  const RenderOptions options{.colour = report.colour};
  for (const Cause &cause : causesOf(report)) {
    const CheckedFile &file = *cause.places.front().file;
    const Finding &finding = *cause.places.front().finding;
    const std::string others = otherPlaces(cause);
    if (!file.foreign.empty()) {
      refusals += refusal(file, finding) + (others.empty() ? "" : fmt::format("   = note: {}\n", others)) + "\n";
      continue;
    }
    const std::string severity = std::string(nameOf(finding.severity)) + (finding.suppressed ? ", allowed" : "");
    Diagnostic diagnostic = finding.diagnostic;
    if (!others.empty())
      diagnostic.notes.push_back(others);
    text += render(diagnostic, {severity, finding.rule->name}, file.source, fileOf, options);
    text += '\n';
  }
  return text + refusals;
}

std::string writeConcise(const Report &report) {
  std::string text;
  forEachShown(report, [&](const CheckedFile &file, const Finding &finding) {
    const Position at = file.source.position(finding.diagnostic.span.begin);
    text += fmt::format("{}:{}:{}: {}: {} [{}]{}\n", file.path, at.line, at.column, nameOf(finding.severity),
                        finding.diagnostic.message, finding.rule->name, finding.suppressed ? " (allowed)" : "");
  });
  return text;
}

} // namespace feedhold
