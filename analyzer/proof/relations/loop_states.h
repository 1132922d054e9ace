// LoopStates: the numbers of variables at the heads of loops, in runs of the machine.
#pragma once

#include "proof/context/proof_context.h"

#include <map>
#include <vector>

namespace feedhold::prove {

/// Variables of programs, by number, at the head of one loop.
struct LoopStates {
  std::vector<std::uint32_t> variables;
  std::vector<std::vector<smt::Number>> visits = {}; // each state once
};

/// By the head of the loop.
using StatesOfLoops = std::map<Place, LoopStates>;

/// Runs on the sampled inputs and on small whole numbers, which are followed for a short time.  States in which one of
/// the variables is vacant, or no number of few digits, are left out.
void addStatesOfRuns(const ProofContext &context, StatesOfLoops &states);

} // namespace feedhold::prove
