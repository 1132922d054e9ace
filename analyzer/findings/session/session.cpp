// Checking without repairing, and what its result says as a whole.
#include "findings/session/session.h"

#include "findings/session/analyse.h"

#include <algorithm>

namespace feedhold {

std::string_view nameOf(DialectChoice choice) {
  switch (choice) {
  case DialectChoice::Option: return "option";
  case DialectChoice::FilePattern: return "file-pattern";
  case DialectChoice::Config: return "config";
  case DialectChoice::Guess: return "guess";
  case DialectChoice::Fallback: return "fallback";
  }
  FEEDHOLD_UNREACHABLE("a way to choose a dialect without a name");
}

bool fails(const Finding &finding, const CheckedFile &file) {
  return !finding.suppressed && finding.severity >= file.errorOn;
}

bool anyFails(const CheckResult &result) {
  return std::any_of(result.files.begin(), result.files.end(), [](const CheckedFile &file) {
    return std::any_of(file.findings.begin(), file.findings.end(),
                       [&](const Finding &finding) { return fails(finding, file); });
  });
}

CheckResult check(const CheckOptions &options, const KnownNames &known) {
  Workload workload = loadWorkload(options, known);
  std::vector<CheckedFile> files =
      analyse(workload.items, known.rules,
              {options.jobs, options.progress, options.open, options.only ? &*options.only : nullptr});
  return {std::move(files), std::move(workload.skipped), std::move(workload.errors)};
}

} // namespace feedhold
