// JSON for programs; its shape is docs/schemas/check.schema.json.
#include "surface/sink/json_parts.h"
#include "surface/sink/shown.h"

namespace feedhold {

namespace {

using json::fixToJson;
using json::Json;
using json::placeOf;

Json flowToJson(const Finding &finding, const CheckedFile &file, const Report &report) {
  Json flow = Json::array();
  for (const Label &step : finding.diagnostic.flow) {
    const CheckedFile &there = step.file ? report.result.files[step.file->index()] : file;
    Json row = {{"path", there.path}};
    row.update(placeOf(there.source, step.span));
    row["message"] = step.text;
    flow.push_back(std::move(row));
  }
  return flow;
}

const std::string &allowedIn(const Finding &finding, const CheckedFile &file) {
  return finding.allowedIn.empty() ? file.path : finding.allowedIn;
}

Json findingToJson(const Finding &finding, const CheckedFile &file, const Report &report) {
  Json row = {{"path", file.path}};
  row.update(placeOf(file.source, finding.diagnostic.span));
  row["rule"] = finding.rule->name;
  row["severity"] = nameOf(finding.severity);
  row["message"] = finding.diagnostic.message;
  row["fingerprint"] = finding.fingerprint;
  row["flow"] = flowToJson(finding, file, report);
  row["notes"] = finding.diagnostic.notes;
  row["fixes"] = Json::array();
  for (const FixIt &fix : finding.diagnostic.fixes)
    row["fixes"].push_back(fixToJson(fix, file.source));
  if (finding.suppressed)
    row.update({{"suppressed", true}, {"reason", finding.reason}, {"allowedIn", allowedIn(finding, file)}});
  return row;
}

Json readFileToJson(const CheckedFile &file) {
  return {{"path", file.path}, {"dialect", file.dialect}, {"chosenBy", nameOf(file.choice)}, {"reasons", file.reasons}};
}

} // namespace

std::string writeJson(const Report &report) {
  Json document = {{"version", 2},
                   {"findings", Json::array()},
                   {"files", Json::array()},
                   {"skipped", Json::array()},
                   {"errors", Json::array()}};
  forEachShown(report, [&](const CheckedFile &file, const Finding &finding) {
    document["findings"].push_back(findingToJson(finding, file, report));
  });
  std::size_t hidden = 0;
  for (const CheckedFile &file : report.result.files) {
    hidden += hiddenIn(file);
    if (isReadProgram(file))
      document["files"].push_back(readFileToJson(file));
    else if (!file.foreign.empty())
      document["skipped"].push_back(
          {{"path", file.path}, {"reason", file.foreign}, {"kind", nameOf(SkipKind::Refused)}});
  }
  document["hidden"] = hidden;
  document["inferred"] = Json::array();
  for (const InferredSetting &setting : report.result.inferred)
    document["inferred"].push_back({{"folder", setting.folder},
                                    {"dialect", setting.dialect},
                                    {"table", setting.table},
                                    {"line", setting.line},
                                    {"evidence", setting.evidence}});
  for (const SkippedFile &skipped : report.result.skipped)
    document["skipped"].push_back({{"path", skipped.path}, {"reason", skipped.reason}, {"kind", nameOf(skipped.kind)}});
  for (const PathProblem &problem : report.result.errors)
    document["errors"].push_back({{"path", problem.path}, {"message", problem.message}});
  // A path or a replacement may hold bytes that are no UTF-8; they become U+FFFD.
  return json::documentText(document);
}

} // namespace feedhold
