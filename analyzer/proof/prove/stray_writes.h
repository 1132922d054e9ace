// Writes in the text that `@ASSIGNS` does not name: of the program and of all programs that it may call.
#pragma once

#include "proof/prove/proof_start.h"

#include <optional>
#include <string>

namespace feedhold::prove {

/// A write counts wherever it stands: before an alarm, in a loop without end, or undone before the return.  What is
/// found is in the text, whether a path comes there or not.  `#0`, local variables and those that stop the program
/// (#3000, #3006) are no assignments.  Absent: there is none.
std::optional<std::string> strayWrite(const ProofSubject &subject);

} // namespace feedhold::prove
