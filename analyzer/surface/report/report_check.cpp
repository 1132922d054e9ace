// Checks a stored release report: whether it is consistent, and whether the same programs give the same report now.
#include "base/source/path_text.h"
#include "base/support/sha256.h"
#include "proof/obligation/obligation_kinds.h"
#include "surface/evidence/reading_json.h"
#include "surface/report/report_parts.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold {

namespace fs = std::filesystem;
using certificate::Json;

Result<Json> certificate::readDocument(const Bundle &report) {
  const auto text = report.find(std::string(kReportDocument));
  if (text == report.end())
    return Error{fmt::format("not a release report: it has no {}", kReportDocument)};
  Json document = Json::parse(text->second, nullptr, false);
  if (document.is_discarded() || !document.is_object())
    return Error{fmt::format("{} cannot be read", kReportDocument)};
  return document;
}

namespace {

/// Files are named together with their hashes, wherever that is.
void collectHashes(const Json &value, std::string_view folder, std::map<std::string, std::string> &hashes) {
  if (value.is_object() && value.contains("file") && value.contains("sha256"))
    hashes.emplace(std::string(folder) + value.at("file").get<std::string>(), value.at("sha256"));
  if (value.is_structured())
    for (const Json &part : value)
      collectHashes(part, folder, hashes);
}

/// The first place at which two documents are not alike, as a person finds it: `files[O1.nc].programs[O1].summary`.
class DocumentComparison {
public:
  std::vector<std::string> run(const Json &before, const Json &now) {
    compare("", before, now);
    return std::move(lines_);
  }

private:
  static constexpr std::size_t kMostLines = 20;

  void compare(const std::string &where, const Json &before, const Json &now) {
    if (before == now || lines_.size() >= kMostLines)
      return;
    if (before.is_object() && now.is_object())
      compareMembers(where, before, now);
    else if (before.is_array() && now.is_array() && before.size() == now.size())
      for (std::size_t i = 0; i < now.size(); ++i)
        compare(where + "[" + nameOf(now[i], i) + "]", before[i], now[i]);
    else
      lines_.push_back(fmt::format("`{}`: `{}` differs from a new proof", kReportDocument, where));
  }
  void compareMembers(const std::string &where, const Json &before, const Json &now) {
    const auto of = [&](const std::string &name) { return where.empty() ? name : where + "." + name; };
    for (const auto &[name, value] : now.items())
      compare(of(name), before.contains(name) ? before.at(name) : Json(), value);
    for (const auto &[name, value] : before.items())
      if (!now.contains(name))
        lines_.push_back(fmt::format("`{}`: `{}` is not expected there", kReportDocument, of(name)));
  }
  static std::string nameOf(const Json &row, std::size_t index) {
    for (const char *member : {"id", "path", "name", "file"})
      if (row.is_object() && row.contains(member) && row.at(member).is_string())
        return row.at(member);
    return std::to_string(index);
  }

  std::vector<std::string> lines_;
};

} // namespace

Result<ReportOrigin> reportOrigin(const Bundle &report, const fs::path &folder) {
  const Result<Json> document = certificate::readDocument(report);
  if (!document)
    return document.error();
  try {
    if (document.value().at("version") != 2)
      return Error{"the report has another format version"};
    const auto pathOf = [&](const Json &path) { return normalPath(absolutePath(folder) / path.get<std::string>()); };
    ReportOrigin origin{.version = document.value().at("feedhold"), .options = {}};
    const Json &reading = document.value().at("options");
    for (const Json &path : reading.at("paths"))
      origin.options.paths.push_back(pathOf(path));
    origin.options.reading = readingFrom(reading, absolutePath(folder));
    if (!document.value().at("date").is_null())
      origin.options.date = document.value().at("date").get<std::string>();
    return origin;
  } catch (const Json::exception &) {
    return Error{fmt::format("{} cannot be read", kReportDocument)};
  }
}

std::vector<std::string> inconsistencies(const Bundle &report) {
  std::vector<std::string> lines;
  const std::string &text = report.at(std::string(kReportDocument));
  try {
    const Json document = Json::parse(text);
    if (certificate::textOf(document) != text)
      lines.push_back(fmt::format("`{}` has been changed", kReportDocument));
    std::map<std::string, std::string> hashes;
    collectHashes(document, "", hashes);
    const std::string index = std::string(kEvidenceFolder) + std::string(kBundleIndex);
    if (const auto file = report.find(index); file != report.end())
      collectHashes(Json::parse(file->second, nullptr, false), kEvidenceFolder, hashes);
    for (const auto &[name, hash] : hashes)
      if (const auto file = report.find(name); file == report.end())
        lines.push_back(fmt::format("`{}` is missing", name));
      else if (sha256(file->second) != hash)
        lines.push_back(fmt::format("`{}` has been changed: its hash differs", name));
    for (const auto &[name, content] : report)
      if (name != kReportDocument && name != kReportPage && !hashes.contains(name))
        lines.push_back(fmt::format("`{}` does not belong to the report", name));
    const auto page = report.find(std::string(kReportPage));
    if (page == report.end())
      lines.push_back(fmt::format("`{}` is missing", kReportPage));
    else if (page->second != certificate::pageOf(text, report))
      lines.push_back(fmt::format("`{}` is not the page of this `{}`", kReportPage, kReportDocument));
  } catch (const Json::exception &) {
    lines.push_back(fmt::format("`{}` has been changed", kReportDocument));
  }
  return lines;
}

std::vector<std::string> reportDifferences(const Bundle &stored, const Bundle &now) {
  const Result<Json> before = certificate::readDocument(stored);
  const Result<Json> after = certificate::readDocument(now);
  if (!before || !after)
    return {fmt::format("`{}` has been changed", kReportDocument)};
  std::vector<std::string> lines = DocumentComparison().run(before.value(), after.value());
  for (const auto &[name, text] : now)
    if (const auto file = stored.find(name);
        name.starts_with("pictures/") && file != stored.end() && file->second != text)
      lines.push_back(fmt::format("`{}` differs from a new drawing", name));
  return lines;
}

} // namespace feedhold
