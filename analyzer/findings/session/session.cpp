// Checking without repairing, and what its result says as a whole.
#include "findings/session/session.h"

#include "findings/session/analyse.h"

#include <algorithm>
#include <iterator>

namespace feedhold {

bool isReported(const Finding &finding, const CheckedFile &file) { return finding.severity >= file.minSeverity; }

bool fails(const Finding &finding, const CheckedFile &file) {
  return !finding.suppressed && finding.severity >= file.errorOn;
}

bool anyFails(const CheckResult &result) {
  return std::any_of(result.files.begin(), result.files.end(), [](const CheckedFile &file) {
    return std::any_of(file.findings.begin(), file.findings.end(),
                       [&](const Finding &finding) { return fails(finding, file); });
  });
}

CheckResult check(const CheckOptions &options, const KnownNames &known, const AnswerUse &answers) {
  Workload workload = loadWorkload(options, known);
  AnalysedFiles analysis =
      analyse(workload.items, known,
              {options.jobs, options.progress, options.open, options.only ? &*options.only : nullptr, answers});
  std::move(analysis.errors.begin(), analysis.errors.end(), std::back_inserter(workload.errors));
  return {std::move(analysis.files), std::move(workload.skipped), std::move(workload.errors),
          std::move(analysis.inferred)};
}

} // namespace feedhold
