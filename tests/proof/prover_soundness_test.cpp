// Random programs: what is proved of them holds in runs on random inputs, from random states, and what is refuted is
// seen in a run on the witness.  PROOF_FIRST and PROOF_PROGRAMS choose other programs.
#include "base/support/parallel.h"
#include "proof/sample_proofs.h"
#include "proof/short_programs.h"
#include "proof/table_programs.h"
#include "soundness/macro_programs.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fmt/format.h>
#include <iostream>

namespace feedhold::proof_tests {
namespace {

using soundness::Random;
using soundness::Sample;

constexpr int kRuns = 30;

std::uint64_t fromEnvironment(const char *name, std::uint64_t otherwise) {
  const char *text = std::getenv(name);
  return text ? std::strtoull(text, nullptr, 10) : otherwise;
}

struct Tried {
  ProofTally tally;
  std::string wrong; // what is not as claimed, and of which program
};

Tried tryProgram(const SampleKind &kind, std::uint64_t seed) {
  Random random(seed);
  const Sample sample = exactSample(kind.make(random));
  const std::uint64_t inputs = random.next();
  Tried tried;
  if (!brokenClaim(kind, sample, inputs, kRuns, tried.tally))
    return tried;
  const Sample least = leastBroken(kind, sample, inputs, kRuns);
  ProofTally ignored;
  tried.wrong =
      fmt::format("{} program {}, {}: {}\n{}", kind.name, seed, least.dialect,
                  brokenClaim(kind, least, inputs, kRuns, ignored).value_or(""), soundness::textOf(least.lines));
  return tried;
}

ProofTally holdsOf(const SampleKind &kind, std::uint64_t usualPrograms) {
  const std::uint64_t first = fromEnvironment("PROOF_FIRST", 1);
  std::vector<Tried> tried(fromEnvironment("PROOF_PROGRAMS", usualPrograms));
  parallelFor(tried.size(), 0, [&](std::size_t i) {
    tried[i] = tryProgram(kind, first + i);
    if (!tried[i].wrong.empty() && std::getenv("PROOF_PROGRAMS")) // such runs are long
      std::cout << tried[i].wrong << std::endl;
  });
  ProofTally tally;
  for (const Tried &each : tried) {
    tally += each.tally;
    if (!each.wrong.empty())
      ADD_FAILURE() << each.wrong;
  }
  std::cout << kind.name << ": " << tally.programs << " programs, " << tally.incomplete << " not followed, "
            << tally.obligations << " obligations, " << tally.proved << " proved, " << tally.refuted << " refuted, "
            << tally.runs << " runs, " << tally.bounded << " loops with a bound, " << tally.stillRunning
            << " still running\n";
  return tally;
}

TEST(ProverSoundness, ShortPrograms) {
  const ProofTally tally = holdsOf({"short", shortSample, shortEntry}, 90);
  EXPECT_LT(tally.obligations / 2, tally.proved + tally.refuted);
}

/// Variables chosen by indices.
TEST(ProverSoundness, TablePrograms) {
  const ProofTally tally = holdsOf({"table", tableSample, tableEntry}, 60);
  EXPECT_LT(tally.obligations / 2, tally.proved + tally.refuted);
}

TEST(ProverSoundness, AnyPrograms) { holdsOf({"any", soundness::macroSample, soundness::randomEntry}, 6); }

} // namespace
} // namespace feedhold::proof_tests
