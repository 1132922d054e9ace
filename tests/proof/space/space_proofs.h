// Space proofs: claims about space of one random program, proved, and judged by many runs.
#pragma once

#include "proof/prove/prove.h"
#include "soundness/macro_programs.h"

#include <optional>

namespace feedhold::proof_tests {

struct SpaceTally {
  std::uint64_t programs = 0;
  std::uint64_t incomplete = 0; // of which not all paths were explored
  std::uint64_t unread = 0;     // whose contract has an error
  std::uint64_t claims = 0;
  std::uint64_t proved = 0;
  std::uint64_t refuted = 0;
  std::uint64_t unreachable = 0;
  std::uint64_t margins = 0; // of claims that are proved
  std::uint64_t runs = 0;
  std::uint64_t moves = 0;  // in them
  std::uint64_t missed = 0; // claims that are not refuted, and that a run breaks

  SpaceTally &operator+=(const SpaceTally &other);
};

/// With clauses of space put round its way.
soundness::Sample withSpaceClauses(soundness::Sample program, soundness::Random &random);

struct SpaceTrial {
  SpaceTally tally;
  std::optional<std::string> wrong; // a run that breaks what is proved, or a witness that breaks nothing
  std::vector<std::string> reasons; // of claims that are neither proved nor refuted
};
SpaceTrial trySpaceProofs(const soundness::Sample &sample, std::uint64_t seed, int runs, const prove::Budget &budget);

/// Without the lines that are not needed for it to be wrong.
soundness::Sample leastWrong(soundness::Sample sample, std::uint64_t seed, int runs, const prove::Budget &budget);

} // namespace feedhold::proof_tests
