// What the proofs of a called program assume of the numbers in its variables, whatever its contract says.
#pragma once

#include "proof/families/families.h"

namespace feedhold::prove {

/// At each call, the variables that the called program reads hold numbers that can be typed.
Questions inputQuestions(const ExploredProgram &program);

} // namespace feedhold::prove
