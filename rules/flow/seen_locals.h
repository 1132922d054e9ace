// Whether the text of a program shows every read of its local variables.
#pragma once

#include "rules/flow/flow_view.h"

namespace feedhold::rules {

/// Nothing but the text of the program reads its local variables: it calls nobody that shares them, can be read
/// throughout, and computes no variable number that is not seen.
bool seesLocals(const FlowFacts &facts);

} // namespace feedhold::rules
