// Turning samples: random lathe programs with a contract of their arguments, start, codes and tool, and claims about
// space for them.
#pragma once

#include "proof/space/space_clauses.h"

namespace feedhold::proof_tests {

/// Nothing is said of space yet.
soundness::Sample turningProgram(soundness::Random &random);

/// `way`: a programmed point to which the tool comes on some run, X as a diameter.
OpenClause openTurningClause(soundness::Random &random, std::string_view name, const geometry::Point<double> &way);

} // namespace feedhold::proof_tests
