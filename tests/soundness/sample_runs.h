// Sample runs: one program, analysed once and run on many inputs.
#pragma once

#include "soundness/macro_programs.h"

#include <optional>

namespace feedhold::soundness {

struct Tally {
  std::uint64_t runs = 0;
  std::uint64_t steps = 0;
  std::uint64_t abandoned = 0; // runs of programs that the analysis gave up
  std::uint64_t overflown = 0;
};

/// What the analysis did not foresee; absent when it foresaw all.
std::optional<std::string> unforeseen(const Sample &sample, std::uint64_t inputSeed, int runs, Tally &tally);

/// Without the lines that are not needed for the analysis to be wrong.
Sample shrunk(Sample sample, std::uint64_t inputSeed, int runs);

} // namespace feedhold::soundness
