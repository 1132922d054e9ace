// JUnit XML: a suite for each file, a failure for each finding, so that any build server can show them.
#include "surface/sink/shown.h"
#include "surface/sink/xml.h"

#include <fmt/format.h>

namespace feedhold {

namespace {

std::string failureOf(const CheckedFile &file, const Finding &finding) {
  const Position at = file.source.position(finding.diagnostic.span.begin);
  const std::string place = fmt::format("{}:{}:{}", file.path, at.line, at.column);
  const std::string name = fmt::format("{} {}:{}", finding.rule->name, at.line, at.column);
  if (finding.suppressed)
    return fmt::format("    <testcase classname=\"{}\" name=\"{}\"><skipped message=\"allowed: {}\"/></testcase>\n",
                       xml(file.path), xml(name), xml(finding.diagnostic.message));
  return fmt::format(
      "    <testcase classname=\"{}\" name=\"{}\">\n      <failure type=\"{}\" message=\"{}\">{}</failure>\n"
      "    </testcase>\n",
      xml(file.path), xml(name), nameOf(finding.severity), xml(finding.diagnostic.message),
      xml(place + "\n" + messageWithNotes(finding.diagnostic)));
}

std::string propertiesOf(const CheckedFile &file) {
  if (!isReadProgram(file))
    return "";
  return fmt::format("    <properties>\n      <property name=\"dialect\" value=\"{}\"/>\n      <property "
                     "name=\"chosenBy\" value=\"{}\"/>\n    </properties>\n",
                     file.dialect, nameOf(file.choice));
}

std::string suiteOf(const CheckedFile &file, const Report &report) {
  std::string cases;
  std::size_t tests = 0;
  std::size_t failures = 0;
  for (const Finding &finding : file.findings) {
    if (!isShown(finding, file, report))
      continue;
    cases += failureOf(file, finding);
    ++tests;
    failures += finding.suppressed ? 0U : 1U;
  }
  if (tests == 0)
    cases = fmt::format("    <testcase classname=\"{}\" name=\"no findings\"/>\n", xml(file.path));
  return fmt::format("  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"0\">\n{}{}  </testsuite>\n",
                     xml(file.path), std::max<std::size_t>(tests, 1), failures, propertiesOf(file), cases);
}

} // namespace

std::string writeJunit(const Report &report) {
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"feedhold\">\n";
  for (const CheckedFile &file : report.result.files)
    if (!file.isOnlyCalled)
      text += suiteOf(file, report);
  for (const PathProblem &problem : report.result.errors)
    text += fmt::format(
        "  <testsuite name=\"{0}\" tests=\"1\" failures=\"0\" errors=\"1\">\n    <testcase classname=\"{0}\" "
        "name=\"reading\">\n      <error message=\"{1}\"/>\n    </testcase>\n  </testsuite>\n",
        xml(problem.path), xml(problem.message));
  for (const SkippedFile &skipped : report.result.skipped)
    text +=
        fmt::format("  <testsuite name=\"{0}\" tests=\"1\" failures=\"0\" errors=\"0\" skipped=\"1\">\n    <testcase "
                    "classname=\"{0}\" name=\"reading\">\n      <skipped message=\"{1}\"/>\n    </testcase>\n"
                    "  </testsuite>\n",
                    xml(skipped.path), xml(skipped.reason));
  return text + "</testsuites>\n";
}

} // namespace feedhold
