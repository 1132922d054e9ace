// Workflow commands of GitHub Actions: each finding becomes an annotation of the pull request.
#include "surface/sink/causes.h"
#include "surface/sink/shown.h"

#include <fmt/format.h>

namespace feedhold {

namespace {

std::string escaped(std::string_view text, std::string_view alsoEscaped) {
  std::string result;
  for (const char c : text) {
    if (c == '%' || c == '\r' || c == '\n' || alsoEscaped.find(c) != std::string_view::npos)
      result += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    else
      result += c;
  }
  return result;
}

std::string asMessage(std::string_view text) { return escaped(text, ""); }
std::string asProperty(std::string_view text) { return escaped(text, ":,"); }

std::string_view commandFor(Severity severity) {
  switch (severity) {
  case Severity::Error: return "error";
  case Severity::Warning: return "warning";
  case Severity::Info: return "notice";
  }
  FEEDHOLD_UNREACHABLE("a severity without an annotation");
}

} // namespace

std::string writeGithub(const Report &report) {
  std::string text;
  for (const Cause &cause : causesOf(report)) { // a step may show ten annotations of a severity
    const CheckedFile &file = *cause.places.front().file;
    const Finding &finding = *cause.places.front().finding;
    const std::string others = otherPlaces(cause);
    const TextRegion region = regionOf(file.source, finding.diagnostic.span);
    text += fmt::format("::{} file={},line={},endLine={},col={},endColumn={},title={}::{}\n",
                        finding.suppressed ? "notice" : commandFor(finding.severity), asProperty(file.path),
                        region.begin.line, region.end.line, region.begin.column, region.end.column,
                        asProperty(finding.rule->name),
                        asMessage(messageWithNotes(finding.diagnostic) + (others.empty() ? "" : "\n" + others)));
  }
  for (const PathProblem &problem : report.result.errors)
    text += fmt::format("::error file={}::{}\n", asProperty(problem.path), asMessage(problem.message));
  return text;
}

} // namespace feedhold
