// The names of severities and of fix safety, as configuration and outputs write them.
#include "base/diag/diagnostic.h"

#include "base/support/check.h"

namespace feedhold {

std::string_view nameOf(Severity severity) {
  switch (severity) {
  case Severity::Info: return "info";
  case Severity::Warning: return "warning";
  case Severity::Error: return "error";
  }
  FEEDHOLD_UNREACHABLE("a severity without a name");
}

std::optional<Severity> severityFromName(std::string_view name) {
  for (const Severity severity : {Severity::Info, Severity::Warning, Severity::Error})
    if (nameOf(severity) == name)
      return severity;
  return std::nullopt;
}

std::string_view nameOf(FixSafety safety) {
  switch (safety) {
  case FixSafety::Safe: return "safe";
  case FixSafety::NeedsReview: return "needs-review";
  }
  FEEDHOLD_UNREACHABLE("a fix safety without a name");
}

} // namespace feedhold
