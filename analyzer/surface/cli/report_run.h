// Making a certificate: what `certify` and `recheck` do alike.
#pragma once

#include "findings/project/shards.h"
#include "findings/session/answers.h"
#include "surface/report/release_report.h"
#include "surface/sink/prove_shown.h"

#include <optional>
#include <set>
#include <string>

namespace feedhold {

struct ReportRun {
  Bundle report; // empty when something could not be read
  VerdictCounts counts;
  std::size_t programs = 0;
  ReleaseStatus status = ReleaseStatus::Ready; // the worst of all programs
  FileCosts costs = {};                        // of the proofs
  bool isProved = false;                       // what could be read; not where this installation is at fault
  std::vector<PathProblem> problems;
};

/// A run over a part of the files has verdicts, and no report.
struct ReportPart {
  std::optional<std::set<std::string>> files = {}; // as shown; absent: all
  AnswerUse answers = {};
};

/// The files of which a report tells, by their absolute paths.
CheckOptions filesOfReport(const ReportOptions &options, unsigned jobs);

/// Checks and proves; what is open is proved once more in search of a clause that would help.
ReportRun runReport(const ReportOptions &options, const std::filesystem::path &folder, unsigned jobs,
                    const ReportPart &part = {});

} // namespace feedhold
