// Guard fix: the blocks that make a program raise an alarm where its inputs are not what it needs.
#pragma once

#include "base/diag/diagnostic.h"
#include "language/contract/contract.h"
#include "meaning/cfg/program_set.h"
#include "proof/guards/guard_atoms.h"

#include <optional>
#include <vector>

namespace feedhold::prove {

/// `IF[#22LE0]GOTO9001` at the head of the program and `N9001#3000=101(STEP MUST BE ABOVE 0)` behind its last block,
/// for each condition.  Where a run may come to the end of the text, all of it stands at the head.  Absent where the
/// control has no alarm to raise, or no numbers are left.
std::optional<FixIt> guardFix(const ProgramFile &file, ProgramId program, const Contract *contract,
                              const std::vector<GuardAtom> &atoms);

} // namespace feedhold::prove
