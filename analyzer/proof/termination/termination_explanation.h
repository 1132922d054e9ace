// Loop accounts: why a loop ends and after how many iterations, in shop words.
#pragma once

#include "proof/termination/termination.h"

namespace feedhold::prove {

struct TerminationExplanation {
  std::string why;   // "`#10` falls by 1 each pass and the loop stops at 0"; empty: there are no plain words for it
  std::string bound; // "FUP[ABS[#21/#22]]": the iterations at most, from the values at the call; empty: not known
};

/// Of a loop that is proved to end.
TerminationExplanation accountOf(SymbolicInterpretation &reading, const ProgramSet &programs, const LoopInstance &loop,
                                 const Termination &end);

} // namespace feedhold::prove
