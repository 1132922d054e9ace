// Programs made so that it is known what holds of them: no verdict is wrong, and nearly all claims are decided.
// FAMILY_ONLY names a part of the names of programs.
#include "proof/family/draft.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>

namespace feedhold::proof_tests {
namespace {

constexpr std::size_t kLeastPrograms = 300;
constexpr int kLeastDecided = 95; // of a hundred

Family wholeFamily() {
  Family family;
  for (const auto add : {addCountingLoops, addSpecialSteps, addGuards, addDomains, addNestedLoops, addVacancy,
                         addDispatch, addCalls, addPhases})
    add(family);
  return family;
}

TEST(Family, NoVerdictIsWrong) {
  Family family = wholeFamily();
  EXPECT_GE(family.size(), kLeastPrograms);
  const char *only = std::getenv("FAMILY_ONLY");
  if (only)
    std::erase_if(family, [&](const KnownProgram &program) { return program.name.find(only) == std::string::npos; });
  const Comparison comparison = compareWithVerdicts(family);
  std::cout << summary(comparison);
  EXPECT_TRUE(comparison.wrong.empty());
  if (!only) {
    EXPECT_GE(comparison.decidedPercent(), kLeastDecided);
  }
}

} // namespace
} // namespace feedhold::proof_tests
