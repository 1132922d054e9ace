// Making a certificate: what `certify` and `recheck` do alike.
#pragma once

#include "surface/report/release_report.h"
#include "surface/sink/prove_shown.h"

namespace feedhold {

struct ReportRun {
  Bundle report; // empty when something could not be read
  VerdictCounts counts;
  std::size_t programs = 0;
  ReleaseStatus status = ReleaseStatus::Ready; // the worst of all programs
  std::vector<PathProblem> problems;
};

/// Checks and proves; what is open is proved once more in search of a clause that would help.
ReportRun runReport(const ReportOptions &options, const std::filesystem::path &folder, unsigned jobs);

} // namespace feedhold
