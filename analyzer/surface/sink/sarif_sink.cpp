// SARIF 2.1.0 (OASIS), as code scanning services and editors read it.
#include "surface/sink/shown.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <map>

namespace feedhold {

namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr std::string_view kSchema =
    "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json";
constexpr std::string_view kRoot = "%SRCROOT%";

/// RFC 3986: everything but unreserved characters and the separators of a path is escaped.
std::string uriPath(std::string_view path) {
  constexpr std::string_view kPlain = "-._~/";
  std::string uri;
  for (const char c : path) {
    const bool isPlain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                         kPlain.find(c) != std::string_view::npos;
    uri += isPlain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return uri;
}

/// A path below the root is relative to it, any other is absolute.
Json artifactLocation(const std::string &path, const fs::path &root) {
  const fs::path absolute = fs::path(path).is_absolute() ? fs::path(path) : root / path;
  const std::string relative = absolute.lexically_normal().lexically_relative(root).generic_string();
  if (relative.empty() || relative.starts_with(".."))
    return {{"uri", "file://" + uriPath(absolute.lexically_normal().generic_string())}};
  return {{"uri", uriPath(relative)}, {"uriBaseId", kRoot}};
}

Json regionToJson(const SourceFile &source, Span span) {
  const Position begin = source.positionUtf16(span.begin);
  const Position end = source.positionUtf16(span.end);
  return {{"startLine", begin.line}, {"startColumn", begin.column}, {"endLine", end.line}, {"endColumn", end.column}};
}

Json physicalLocation(const CheckedFile &file, Span span, const Report &report) {
  return {{"artifactLocation", artifactLocation(file.path, report.root)}, {"region", regionToJson(file.source, span)}};
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

Json fixToJson(const FixIt &fix, const CheckedFile &file, const Report &report) {
  Json replacements = Json::array();
  for (const Edit &edit : fix.edits)
    replacements.push_back(
        {{"deletedRegion", regionToJson(file.source, edit.span)}, {"insertedContent", {{"text", edit.replacement}}}});
  Json change = {{"artifactLocation", artifactLocation(file.path, report.root)},
                 {"replacements", std::move(replacements)}};
  return {{"description", {{"text", fix.title}}},
          {"artifactChanges", Json::array({std::move(change)})},
          {"properties", {{"safety", nameOf(fix.safety)}}}};
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
  for (const Label &step : finding.diagnostic.way)
    add(step.file ? report.result.files[step.file->index()] : file, step.span, step.text);
  add(file, finding.diagnostic.span, finding.diagnostic.message);
  Json thread = {{"locations", std::move(steps)}};
  return Json::array({Json{{"threadFlows", Json::array({std::move(thread)})}}});
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
  if (!finding.diagnostic.way.empty())
    row["codeFlows"] = codeFlows(finding, file, report);
  // Code scanning services compare only the first; any stable text will do.
  row["partialFingerprints"] = {{"primaryLocationLineHash", finding.fingerprint + ":1"},
                                {"feedhold/v1", finding.fingerprint}};
  for (const FixIt &fix : finding.diagnostic.fixes)
    row["fixes"].push_back(fixToJson(fix, file, report));
  if (finding.suppressed)
    row["suppressions"] = Json::array({Json{{"kind", "inSource"}}});
  return row;
}

Json notification(std::string_view level, const std::string &path, const std::string &message, const Report &report) {
  return {{"level", level},
          {"message", {{"text", message}}},
          {"locations",
           Json::array({Json{{"physicalLocation", {{"artifactLocation", artifactLocation(path, report.root)}}}}})}};
}

Json invocation(const Report &report) {
  Json notifications = Json::array();
  for (const PathProblem &problem : report.result.errors)
    notifications.push_back(notification("error", problem.path, problem.message, report));
  for (const SkippedFile &skipped : report.result.skipped)
    notifications.push_back(notification("note", skipped.path, "skipped: " + skipped.reason, report));
  return {{"executionSuccessful", report.result.errors.empty()},
          {"exitCode", report.exitCode},
          {"toolExecutionNotifications", std::move(notifications)}};
}

Json driver(const Report &report) {
  Json row = {{"name", "Feedhold"}, {"semanticVersion", report.version}, {"rules", Json::array()}};
  for (const RegisteredRule &entry : report.rules.rules)
    row["rules"].push_back(ruleToJson(entry));
  return row;
}

} // namespace

std::string writeSarif(const Report &report) {
  RuleIndex ruleIndex;
  for (const RegisteredRule &entry : report.rules.rules)
    ruleIndex.emplace(entry.rule->info.name, ruleIndex.size());
  Json run = {{"tool", {{"driver", driver(report)}}}, {"columnKind", "utf16CodeUnits"}};
  run["originalUriBaseIds"] = {{kRoot, {{"uri", "file://" + uriPath((report.root / "").generic_string())}}}};
  run["invocations"] = Json::array({invocation(report)});
  run["results"] = Json::array();
  forEachShown(report, [&](const CheckedFile &file, const Finding &finding) {
    run["results"].push_back(resultToJson(finding, file, report, ruleIndex));
  });
  const Json document = {{"$schema", kSchema}, {"version", "2.1.0"}, {"runs", Json::array({std::move(run)})}};
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace feedhold
