// ReachedPrograms: which programs a program may come to by its calls.
#pragma once

#include "meaning/cfg/program_set.h"

#include <set>

namespace feedhold {

/// What a program calls, and what those call, itself included.
struct ReachedPrograms {
  std::set<ProgramRef> programs;
  bool orAny = false; // one of them calls a program whose number is computed
};

/// Adds to what is known already.
void collectReached(const ProgramSet &programs, ProgramRef from, ReachedPrograms &reached);

} // namespace feedhold
