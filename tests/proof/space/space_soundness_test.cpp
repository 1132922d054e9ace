// Random programs of machining centres and lathes: what is proved of their space is kept in runs on random arguments,
// and what is refuted is broken by the witness.  SPACE_FIRST and SPACE_PROGRAMS choose other programs, SPACE_SHOW=1
// shows them, SPACE_REASONS=1 what is said of claims that are neither proved nor refuted.
#include "base/support/parallel.h"
#include "proof/space/space_programs.h"
#include "proof/space/space_proofs.h"
#include "proof/space/turning_samples.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fmt/format.h>
#include <iostream>
#include <map>

namespace feedhold::proof_tests {
namespace {

using soundness::Random;
using soundness::Sample;

constexpr int kRuns = 24;

std::uint64_t fromEnvironment(const char *name, std::uint64_t otherwise) {
  const char *text = std::getenv(name);
  return text ? std::strtoull(text, nullptr, 10) : otherwise;
}

struct ProgramKind {
  std::string_view name;
  Sample (*make)(Random &);
  prove::Budget budget;
};

SpaceTrial tryProgram(const ProgramKind &kind, std::uint64_t seed) {
  Random random(seed);
  const Sample sample = withSpaceClauses(kind.make(random), random);
  const std::uint64_t inputs = random.next();
  if (std::getenv("SPACE_SHOW"))
    std::cout << fmt::format("--- {}\n{}\n", seed, soundness::textOf(sample.lines)) << std::flush;
  SpaceTrial trial = trySpaceProofs(sample, inputs, kRuns, kind.budget);
  if (!trial.wrong)
    return trial;
  const Sample least = leastWrong(sample, inputs, kRuns, kind.budget);
  trial.wrong = fmt::format("{} {}: {}\n{}", kind.name, seed,
                            trySpaceProofs(least, inputs, kRuns, kind.budget).wrong.value_or(*trial.wrong),
                            soundness::textOf(least.lines));
  return trial;
}

SpaceTally holdsOf(const ProgramKind &kind, std::uint64_t usualPrograms) {
  const std::uint64_t first = fromEnvironment("SPACE_FIRST", 1);
  std::vector<SpaceTrial> trials(fromEnvironment("SPACE_PROGRAMS", usualPrograms));
  parallelFor(trials.size(), 0, [&](std::size_t i) {
    trials[i] = tryProgram(kind, first + i);
    if (trials[i].wrong && std::getenv("SPACE_PROGRAMS")) // such runs are long
      std::cout << *trials[i].wrong << std::endl;
  });
  SpaceTally tally;
  std::map<std::string, int> reasons;
  for (const SpaceTrial &each : trials) {
    tally += each.tally;
    for (const std::string &reason : each.reasons)
      ++reasons[reason];
    if (each.wrong)
      ADD_FAILURE() << *each.wrong;
  }
  std::cout << kind.name << ": " << tally.programs << " programs, " << tally.incomplete << " not followed, "
            << tally.claims << " claims, " << tally.proved << " proved (" << tally.margins << " with a margin), "
            << tally.unreachable << " unreachable, " << tally.refuted << " refuted, " << tally.missed
            << " broken and not refuted, " << tally.runs << " runs, " << tally.moves << " moves\n";
  if (std::getenv("SPACE_REASONS"))
    for (const auto &[reason, count] : reasons)
      std::cout << count << "  " << reason << "\n";
  EXPECT_EQ(tally.unread, 0U);
  return tally;
}

TEST(SpaceSoundness, MillingPrograms) {
  const SpaceTally tally = holdsOf({"milling", millingProgram, {.search = 100'000, .z3 = 0, .cvc5 = 0}}, 24);
  EXPECT_GT(tally.proved, tally.claims / 5);
}

TEST(SpaceSoundness, TurningPrograms) {
  const SpaceTally tally = holdsOf({"turning", turningProgram, {.search = 100'000, .z3 = 0, .cvc5 = 0}}, 16);
  EXPECT_GT(tally.proved, tally.claims / 5);
}

TEST(SpaceSoundness, SingleMovements) {
  const SpaceTally tally = holdsOf({"single", oneMovement, {.search = 20'000, .z3 = 0, .cvc5 = 0}}, 40);
  EXPECT_GT(tally.proved, tally.claims / 5);
}

} // namespace
} // namespace feedhold::proof_tests
