// Whether a called program leaves its caller in no other way than by a return, an alarm, or a run without end, and
// nothing behind that is not of the parts of a state.
#pragma once

#include "meaning/cfg/program_set.h"

namespace feedhold {

/// By its text, and those of all programs that it may come to: no block ends the run (M02, M30, the end of the file),
/// none returns to a sequence number (`M99 P`) and none is unreadable; none begins a modal call or a macro interrupt,
/// begins or cancels a mapping or sets parameters (G10), and no code is computed or may do anything; and all that is
/// called are programs of the files.
bool returnsBehindItsCall(const ProgramSet &programs, const Callee &callee);

} // namespace feedhold
