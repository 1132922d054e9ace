// SARIF 2.1.0 (OASIS), as code scanning services and editors read it.
#include "surface/sink/sarif_parts.h"
#include "surface/sink/shown.h"

#include <map>

namespace feedhold {

namespace {

using sarif::Json;

Json physicalLocation(const CheckedFile &file, Span span, const Report &report) {
  return sarif::physicalLocation(file.path, file.source, span, report.root);
}

std::string_view levelOf(Severity severity) {
  switch (severity) {
  case Severity::Error: return "error";
  case Severity::Warning: return "warning";
  case Severity::Info: return "note";
  }
  FEEDHOLD_UNREACHABLE("a severity without a level");
}

std::string_view problemSeverityOf(Severity severity) {
  switch (severity) {
  case Severity::Error: return "error";
  case Severity::Warning: return "warning";
  case Severity::Info: return "recommendation";
  }
  FEEDHOLD_UNREACHABLE("a severity without a problem severity");
}

Json ruleToJson(const RegisteredRule &entry) {
  const RuleInfo &info = entry.rule->info;
  Json row = {{"id", info.name},
              {"shortDescription", {{"text", info.summary}}},
              {"fullDescription", {{"text", info.summary}}},
              {"help", {{"text", info.summary}, {"markdown", entry.page}}},
              {"defaultConfiguration", {{"level", levelOf(info.severity)}}}};
  row["properties"] = {{"tags", Json::array({nameOf(info.category)})},
                       {"problem.severity", problemSeverityOf(info.severity)}};
  return row;
}

Json relatedLocations(const Finding &finding, const CheckedFile &file, const Report &report) {
  Json rows = Json::array();
  for (const Label &label : finding.diagnostic.labels) {
    const CheckedFile &there = label.file ? report.result.files[label.file->index()] : file;
    rows.push_back({{"id", rows.size() + 1},
                    {"physicalLocation", physicalLocation(there, label.span, report)},
                    {"message", {{"text", label.text}}}});
  }
  return rows;
}

/// The way that leads to the finding, and the finding itself as its last step.
Json codeFlows(const Finding &finding, const CheckedFile &file, const Report &report) {
  Json steps = Json::array();
  const auto add = [&](const CheckedFile &there, Span span, const std::string &text) {
    steps.push_back(
        {{"location", {{"physicalLocation", physicalLocation(there, span, report)}, {"message", {{"text", text}}}}}});
  };
  for (const Label &step : finding.diagnostic.flow)
    add(step.file ? report.result.files[step.file->index()] : file, step.span, step.text);
  add(file, finding.diagnostic.span, finding.diagnostic.message);
  Json thread = {{"locations", std::move(steps)}};
  return Json::array({Json{{"threadFlows", Json::array({std::move(thread)})}}});
}

Json suppressionOf(const Finding &finding) {
  Json row = {{"kind", finding.allowedIn.empty() ? "inSource" : "external"}};
  if (!finding.reason.empty())
    row["justification"] = finding.reason;
  return row;
}

using RuleIndex = std::map<std::string_view, std::size_t>;

Json resultToJson(const Finding &finding, const CheckedFile &file, const Report &report, const RuleIndex &ruleIndex) {
  Json row = {{"ruleId", finding.rule->name}};
  if (const auto index = ruleIndex.find(finding.rule->name); index != ruleIndex.end())
    row["ruleIndex"] = index->second;
  row["kind"] = "fail";
  row["level"] = levelOf(finding.severity);
  row["message"] = {{"text", messageWithNotes(finding.diagnostic)}};
  row["locations"] = Json::array({Json{{"physicalLocation", physicalLocation(file, finding.diagnostic.span, report)}}});
  if (!finding.diagnostic.labels.empty())
    row["relatedLocations"] = relatedLocations(finding, file, report);
  if (!finding.diagnostic.flow.empty())
    row["codeFlows"] = codeFlows(finding, file, report);
  // Code scanning services compare only the first; any stable text will do.
  row["partialFingerprints"] = {{"primaryLocationLineHash", finding.fingerprint + ":1"},
                                {"feedhold/v1", finding.fingerprint}};
  for (const FixIt &fix : finding.diagnostic.fixes)
    row["fixes"].push_back(sarif::fixToJson(fix, file.path, file.source, report.root));
  if (finding.suppressed)
    row["suppressions"] = Json::array({suppressionOf(finding)});
  return row;
}

Json driver(const Report &report) {
  Json row = {{"name", "Feedhold"}, {"semanticVersion", report.version}, {"rules", Json::array()}};
  for (const RegisteredRule &entry : report.rules.rules)
    row["rules"].push_back(ruleToJson(entry));
  return row;
}

/// The files that were read, each with its dialect.
Json artifacts(const Report &report) {
  Json rows = Json::array();
  for (const CheckedFile &file : report.result.files)
    if (isReadProgram(file))
      rows.push_back({{"location", sarif::artifactLocation(file.path, report.root)},
                      {"properties", {{"dialect", file.dialect}, {"chosenBy", nameOf(file.choice)}}}});
  return rows;
}

} // namespace

std::string writeSarif(const Report &report) {
  RuleIndex ruleIndex;
  for (const RegisteredRule &entry : report.rules.rules)
    ruleIndex.emplace(entry.rule->info.name, ruleIndex.size());
  Json results = Json::array();
  forEachShown(report, [&](const CheckedFile &file, const Finding &finding) {
    results.push_back(resultToJson(finding, file, report, ruleIndex));
  });
  return sarif::documentText({driver(report), artifacts(report), std::move(results)},
                             {report.result.errors, report.result.skipped, report.exitCode}, report.root);
}

} // namespace feedhold
