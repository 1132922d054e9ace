// The straight cuts of a program of a lathe, those in the contours of its cycles included.
#pragma once

#include "rules/motion/turning_walk.h"

#include <map>

namespace feedhold::rules {

struct StraightCut {
  TurningPoint from;
  TurningPoint to;
};

/// By block; those whose ends are known.  A block with the angle of a line, or with a corner behind it, has none.
std::map<BlockId, StraightCut> straightCutsOf(ProgramId program, const FileContext &context);

} // namespace feedhold::rules
