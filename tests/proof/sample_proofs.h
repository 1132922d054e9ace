// Sample proofs: one random program, each of its programs proved and then run on many inputs.
#pragma once

#include "proof/prove/prove.h"
#include "soundness/sample_start.h"

#include <optional>

namespace feedhold::proof_tests {

struct ProofTally {
  std::uint64_t programs = 0;
  std::uint64_t incomplete = 0; // of which not all paths were explored
  std::uint64_t obligations = 0;
  std::uint64_t proved = 0; // or unreachable
  std::uint64_t refuted = 0;
  std::uint64_t runs = 0;
  std::uint64_t bounded = 0;      // loops of a known number of passes in runs
  std::uint64_t stillRunning = 0; // runs without an end in sight, of programs that are claimed to end

  ProofTally &operator+=(const ProofTally &other);
};

/// A kind of program, and how its runs start.
struct SampleKind {
  std::string_view name;
  soundness::Sample (*make)(soundness::Random &);
  soundness::EntryValues (*entry)(const soundness::LoadedSample &, soundness::Random &);
};

/// Small budgets: what is tested is what is claimed, not how much.
prove::Budget smallBudget();

/// Numbers that doubles hold exactly, in place of others: proofs are over exact numbers, runs are not.
soundness::Sample exactSample(soundness::Sample sample);

/// A run that breaks what was proved, or stops where nothing was claimed at all, or a witness that shows nothing;
/// absent when there is none.
std::optional<std::string> brokenClaim(const SampleKind &kind, const soundness::Sample &sample, std::uint64_t inputSeed,
                                       int runs, ProofTally &tally);

/// What became of all claims, and of all runs.
struct ProofTrial {
  ProofTally tally;
  std::optional<std::string> wrong; // as brokenClaim
  std::size_t explained = 0;        // claims that are not proved, with a witness or a reason
  std::vector<std::string> ends;    // of the runs that the contracts allow
};
ProofTrial tryProofs(const SampleKind &kind, const soundness::Sample &sample, std::uint64_t inputSeed, int runs);

/// Without the lines that are not needed for a claim to be broken.
soundness::Sample leastBroken(const SampleKind &kind, soundness::Sample sample, std::uint64_t inputSeed, int runs);

} // namespace feedhold::proof_tests
