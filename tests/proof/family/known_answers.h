// Known answers: programs of which it is known what holds, and how the verdicts compare with it.
#pragma once

#include "proof/prove/prove.h"

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace feedhold::proof_tests {

/// Variables and what they hold on entry; all others are vacant.
using Inputs = std::vector<std::pair<std::uint32_t, double>>;

struct KnownAnswer {
  std::string claim;            // the id of an obligation without its program: `loop-ends.N20`
  prove::Verdict::Kind verdict; // Proved, also where the place is never reached, or Refuted
  Inputs shownBy = {};          // of Refuted: a run on them breaks the claim
};

struct KnownProgram {
  std::string name;
  std::string text; // the first program is the one that is proved
  std::vector<KnownAnswer> answers;
  std::vector<Inputs> trials = {}; // inputs that its contract allows: no run on them breaks a claim that holds
};

struct Comparison {
  int programs = 0;
  int right = 0;
  std::vector<std::string> undecided = {};
  std::vector<std::string> wrong = {}; // verdicts, and answers that a run contradicts

  int claims() const { return right + static_cast<int>(undecided.size() + wrong.size()); }
  int decidedPercent() const { return claims() == 0 ? 0 : 100 * right / claims(); }
};

/// With a line for each verdict that is not as it is known to be.
Comparison compareWithVerdicts(std::span<const KnownProgram> programs);

/// What a test prints of it.
std::string summary(const Comparison &comparison);

} // namespace feedhold::proof_tests
