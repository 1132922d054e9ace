#include "surface/report/release_report.h"

#include "base/support/parallel.h"
#include "base/support/sha256.h"
#include "surface/report/report_parts.h"

#include <fmt/format.h>

namespace feedhold {

namespace fs = std::filesystem;
using certificate::Json;
using certificate::ShownRun;

namespace {

using Runs = std::vector<std::vector<std::vector<ShownRun>>>; // by file and program

Runs runsOf(const ReportInput &input) {
  Runs runs;
  std::vector<std::pair<std::size_t, std::size_t>> jobs;
  for (const ProvedFile &file : input.proofs.files) {
    for (std::size_t program = 0; program < file.programs.size(); ++program)
      jobs.emplace_back(runs.size(), program);
    runs.emplace_back(file.programs.size());
  }
  parallelFor(jobs.size(), input.jobs, [&](std::size_t i) {
    const auto [file, program] = jobs[i];
    runs[file][program] = certificate::shownRuns(input.proofs.files[file], input.proofs.files[file].programs[program]);
  });
  return runs;
}

/// As the document names them: by path, then as they stand there.
void addPictures(Bundle &report, const Json &document, const Runs &runs) {
  std::map<std::string, const std::string *> bySha;
  for (const auto &file : runs)
    for (const auto &program : file)
      for (const ShownRun &run : program)
        bySha.emplace(sha256(run.svg), &run.svg);
  for (const Json &file : document.at("files"))
    for (const Json &program : file.at("programs"))
      for (const Json &run : program.at("runs"))
        report.emplace(run.at("picture").at("file"), *bySha.at(run.at("picture").at("sha256")));
}

} // namespace

Bundle makeReport(const ReportInput &input) {
  const Bundle evidence =
      makeBundle(input.proofs, input.options.reading, input.version, input.folder / kEvidenceFolder);
  const Runs runs = runsOf(input);
  const Json document = certificate::documentOf(input, evidence, runs);
  Bundle report;
  for (const auto &[name, text] : evidence)
    report.emplace(std::string(kEvidenceFolder) + name, text);
  addPictures(report, document, runs);
  const std::string text = certificate::textOf(document);
  const std::string page = certificate::pageOf(text, report);
  report.emplace(kReportDocument, text);
  report.emplace(kReportPage, page);
  return report;
}

Bundle evidenceOf(const Bundle &report) {
  Bundle evidence;
  for (const auto &[name, text] : report)
    if (name.starts_with(kEvidenceFolder))
      evidence.emplace(name.substr(kEvidenceFolder.size()), text);
  return evidence;
}

} // namespace feedhold
