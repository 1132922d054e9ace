// Random programs on random inputs: every state of every run lies in a state that the analysis tells of its place, and
// every alarm that stops a run is foreseen.  SOUNDNESS_FIRST and SOUNDNESS_PROGRAMS choose other programs.
#include "soundness/sample_runs.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>

namespace feedhold::soundness {
namespace {

constexpr int kRuns = 30;
constexpr int kMostShown = 6;

std::uint64_t fromEnvironment(const char *name, std::uint64_t otherwise) {
  const char *text = std::getenv(name);
  return text ? std::strtoull(text, nullptr, 10) : otherwise;
}

TEST(Soundness, EveryRunIsForeseen) {
  const std::uint64_t first = fromEnvironment("SOUNDNESS_FIRST", 1);
  const std::uint64_t programs = fromEnvironment("SOUNDNESS_PROGRAMS", 1200);
  Tally tally;
  int wrong = 0;
  for (std::uint64_t seed = first; seed < first + programs; ++seed) {
    Random random(seed);
    const Sample sample = macroSample(random);
    const std::uint64_t inputs = random.next();
    if (!unforeseen(sample, inputs, kRuns, tally))
      continue;
    const Sample least = shrunk(sample, inputs, kRuns);
    Tally ignored;
    ADD_FAILURE() << "program " << seed << ", " << least.dialect << ": "
                  << unforeseen(least, inputs, kRuns, ignored).value_or("") << "\n"
                  << textOf(least.lines);
    if (++wrong == kMostShown)
      return;
  }
  std::cout << tally.runs << " runs, " << tally.steps << " steps, " << tally.overflown << " overflows, "
            << tally.abandoned << " not analysed\n";
  EXPECT_GE(tally.runs, programs * kRuns * 95 / 100);
  EXPECT_LE(tally.overflown, tally.runs / 20);
}

} // namespace
} // namespace feedhold::soundness
