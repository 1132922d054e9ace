// Each assumption of a proof has a row in docs/soundness.md, and the obligation that shows it exists.
#include "proof/obligation/obligation_kinds.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>

namespace feedhold::prove {
namespace {

struct Assumption {
  std::string_view name;
  std::string_view obligation;
};
constexpr Assumption kAssumptions[] = {
#define ASSUMPTION(name, obligation) {name, obligation},
#include "proof/obligation/assumptions.def"
};

std::string soundnessPage() {
  std::ifstream stream(std::string(FEEDHOLD_SOURCE_DIR) + "/docs/soundness.md");
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(Assumptions, EachHasARowThatSaysWhoShowsIt) {
  const std::string page = soundnessPage();
  for (const auto &[name, obligation] : kAssumptions) {
    const std::string by = obligation.empty() ? "nobody" : fmt::format("`{}`", obligation);
    EXPECT_NE(page.find(fmt::format("| {} | {} |", name, by)), std::string::npos) << name;
  }
}

TEST(Assumptions, EachIsShownByAnObligationThatExists) {
  for (const auto &[name, obligation] : kAssumptions)
    EXPECT_TRUE(obligation.empty() ||
                std::any_of(kObligationKinds.begin(), kObligationKinds.end(),
                            [wanted = obligation](ObligationKind kind) { return nameOf(kind) == wanted; }))
        << name;
}

} // namespace
} // namespace feedhold::prove
