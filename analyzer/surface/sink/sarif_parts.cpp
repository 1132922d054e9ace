#include "surface/sink/sarif_parts.h"

#include "base/source/file_uri.h"
#include "base/source/path_text.h"
#include "surface/sink/json_parts.h"

namespace feedhold::sarif {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSchema =
    "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json";
constexpr std::string_view kRoot = "%SRCROOT%";

Json notification(std::string_view level, const std::string &path, const std::string &message, const fs::path &root) {
  return {
      {"level", level},
      {"message", {{"text", message}}},
      {"locations", Json::array({Json{{"physicalLocation", {{"artifactLocation", artifactLocation(path, root)}}}}})}};
}

Json toJson(const Invocation &invocation, const fs::path &root) {
  Json notifications = Json::array();
  for (const PathProblem &problem : invocation.errors)
    notifications.push_back(notification("error", problem.path, problem.message, root));
  for (const SkippedFile &skipped : invocation.skipped)
    notifications.push_back(notification("note", skipped.path, "skipped: " + skipped.reason, root));
  return {{"executionSuccessful", invocation.errors.empty()},
          {"exitCode", invocation.exitCode},
          {"toolExecutionNotifications", std::move(notifications)}};
}

} // namespace

Json artifactLocation(const std::string &path, const fs::path &root) {
  const fs::path absolute = isAbsolutePath(path) ? fs::path(path) : root / path;
  const std::string relative = pathText(normalPath(absolute).lexically_relative(root));
  if (relative.empty() || relative.starts_with(".."))
    return {{"uri", uriOfPath(absolute)}};
  return {{"uri", escapedForUri(relative)}, {"uriBaseId", kRoot}};
}

Json regionOf(const SourceFile &source, Span span) {
  const Position begin = source.positionUtf16(span.begin);
  const Position end = source.positionUtf16(span.end);
  return {{"startLine", begin.line}, {"startColumn", begin.column}, {"endLine", end.line}, {"endColumn", end.column}};
}

Json physicalLocation(const std::string &path, const SourceFile &source, Span span, const fs::path &root) {
  return {{"artifactLocation", artifactLocation(path, root)}, {"region", regionOf(source, span)}};
}

Json fixToJson(const FixIt &fix, const std::string &path, const SourceFile &source, const fs::path &root) {
  Json replacements = Json::array();
  for (const Edit &edit : fix.edits)
    replacements.push_back(
        {{"deletedRegion", regionOf(source, edit.span)}, {"insertedContent", {{"text", edit.replacement}}}});
  Json change = {{"artifactLocation", artifactLocation(path, root)}, {"replacements", std::move(replacements)}};
  return {{"description", {{"text", fix.title}}},
          {"artifactChanges", Json::array({std::move(change)})},
          {"properties", {{"safety", nameOf(fix.safety)}}}};
}

std::string documentText(Document document, const Invocation &invocation, const fs::path &root) {
  Json run = {{"tool", {{"driver", std::move(document.driver)}}}, {"columnKind", "utf16CodeUnits"}};
  run["originalUriBaseIds"] = {{kRoot, {{"uri", uriOfPath(root / "")}}}};
  run["invocations"] = Json::array({toJson(invocation, root)});
  if (!document.artifacts.is_null())
    run["artifacts"] = std::move(document.artifacts);
  run["results"] = std::move(document.results);
  const Json whole = {{"$schema", kSchema}, {"version", "2.1.0"}, {"runs", Json::array({std::move(run)})}};
  return json::documentText(whole);
}

} // namespace feedhold::sarif
