// Between which variables the indices of a program choose, as the abstract interpretation has it.
#pragma once

#include "language/contract/contract.h"
#include "meaning/cfg/program_set.h"
#include "proof/symbolic/region_memory.h"

namespace feedhold::prove {

/// Of the program, started as its contract allows, and of those that it calls.  Nothing is believed of it: a proof
/// shows each range again where it uses it.  Empty where there are no indices.
IndexRanges indexRangesOf(const ProgramSet &programs, Callee program, const FileContracts *contracts);

} // namespace feedhold::prove
