// Names that configuration files and outputs depend on.
#include "base/diag/diagnostic.h"

#include <gtest/gtest.h>

namespace feedhold {
namespace {

TEST(Diagnostic, SeveritiesHaveNames) {
  EXPECT_EQ(nameOf(Severity::Info), "info");
  EXPECT_EQ(severityFromName("warning"), Severity::Warning);
  EXPECT_EQ(severityFromName("error"), Severity::Error);
  EXPECT_EQ(severityFromName("Error"), std::nullopt);
  EXPECT_EQ(severityFromName(""), std::nullopt);
}

TEST(Diagnostic, FixSafetyHasNames) {
  EXPECT_EQ(nameOf(FixSafety::Safe), "safe");
  EXPECT_EQ(nameOf(FixSafety::NeedsReview), "needs-review");
}

} // namespace
} // namespace feedhold
