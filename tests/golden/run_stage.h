// The stage `run`: a program in the concrete machine, told as `feedhold run` tells it.
#pragma once

#include "golden/stages.h"

namespace feedhold::golden {

/// `wishes`: what follows the name of the stage, one word each: `A=10` an argument, `#500=3` a variable, `X10` where
/// the tool stands, `fuel=1000`, `block-skip`, `trace`, `numbers=mantissa32`.  The first file is run, from its first
/// program.
std::string runStageOf(const Input &input, std::string_view wishes);

} // namespace feedhold::golden
