// TerminationExplanation: why a loop ends and after how many iterations, in words for the report.
#pragma once

#include "proof/termination/termination.h"

namespace feedhold::prove {

struct TerminationExplanation {
  std::string why;   // "`#10` falls by 1 at every iteration, and the loop stops at 0"; empty: no plain words
  std::string bound; // "FUP[ABS[#21/#22]]": the iterations at most, from the values at the call; empty: not known
};

/// Of a loop that is proved to end.
TerminationExplanation explain(SymbolicInterpretation &interpretation, const ProgramSet &programs,
                               const LoopInstance &loop, const Termination &end);

} // namespace feedhold::prove
