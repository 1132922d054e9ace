// The self-check: built-in programs with known answers, through every engine, as this build does it on this machine.
#pragma once

#include "surface/report/qualification.h"

namespace feedhold {

/// In order.  Reads and writes no files.
std::vector<SelfCheckStep> selfCheck();

} // namespace feedhold
