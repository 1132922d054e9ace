// Certificates: a report of proofs for people who release programs: `certificate.json`, which says everything
// (docs/schemas/certificate.schema.json), a page made of it and of nothing else, pictures of runs, and the evidence.
#pragma once

#include "findings/session/result.h"
#include "surface/evidence/evidence_bundle.h"
#include "surface/report/qualification.h"

#include <functional>

namespace feedhold {

inline constexpr std::string_view kReportDocument = "certificate.json";
inline constexpr std::string_view kReportPage = "index.html";
inline constexpr std::string_view kEvidenceFolder = "certificate/"; // holds a bundle of proofs

/// How a certificate was asked for, beside how programs are read.
struct ReportOptions {
  std::vector<std::filesystem::path> paths; // that were named
  BundleReading reading;
  std::optional<std::string> date; // as it is shown; absent: no date, so that the same input gives the same bytes
};

/// Whether a program may be released by what was proved, the worst last.
enum class ReleaseStatus : std::uint8_t {
  Ready,  // every claim holds
  Open,   // something is neither proved nor refuted, or cannot be read
  Alarms, // a call raises an alarm that the contract does not foresee
  Broken, // a call breaks a claim
};
std::string_view nameOf(ReleaseStatus status);
ReleaseStatus releaseStatusOf(const ProvedFile &file, const ProvedProgram &program);
/// The worst of all programs.  Where nothing at all is claimed, nothing is proved.
ReleaseStatus releaseStatusOf(const ProofsResult &proofs);

struct ReportInput {
  const ReportOptions &options;
  const ProofsResult &proofs;
  const CheckResult &findings; // of the same files
  const DialectRegistry &dialects;
  /// The configuration that speaks for a file; absent: none does.
  std::function<std::optional<std::filesystem::path>(const std::filesystem::path &)> configOf;
  std::string version;
  std::vector<std::string> solvers;
  std::vector<SelfCheckStep> selfCheck; // of the program that makes the report, which has passed it
  std::filesystem::path folder;         // where it will lie
  unsigned jobs = 0;
};

/// All files of the report.  The same input gives the same bytes.
Bundle makeReport(const ReportInput &input);

/// How a report says that it was asked for.
struct ReportOrigin {
  std::string version;
  ReportOptions options; // paths as seen from here
};
Result<ReportOrigin> reportOrigin(const Bundle &report, const std::filesystem::path &folder);

/// Whether the report fits together: every file is the one that `certificate.json` names, and the page says what it
/// says.  A line for each difference.
std::vector<std::string> inconsistencies(const Bundle &report);

/// The files that were read for a report, against those that are there now; with `place` those below that folder whose
/// paths end alike.
struct SourceCheck {
  std::size_t same = 0;
  std::vector<std::string> changed; // a line for each, also where it cannot be told which file it is
  std::vector<std::string> gone;    // by name
};
SourceCheck checkSources(const Bundle &report, const std::filesystem::path &folder,
                         const std::optional<std::filesystem::path> &place);

/// How a report differs from the one that the same programs give now, beside what differences() tells of its evidence.
std::vector<std::string> reportDifferences(const Bundle &stored, const Bundle &now);

/// The bundle of proofs in a report.
Bundle evidenceOf(const Bundle &report);

} // namespace feedhold
