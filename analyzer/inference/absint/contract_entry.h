// ContractEntry: what the contract of a program says of the state in which it is called.
#pragma once

#include "inference/absint/abstract_state.h"
#include "language/contract/contract.h"
#include "meaning/cfg/program_set.h"

namespace feedhold {

/// The contract says something of the state at entry, not only of what comes after.
bool speaksOfEntry(const Contract &contract);

/// Cuts the state of an entry down to the calls that the contract allows.  A clause that no call can keep is left out:
/// what is wrong with it is told elsewhere.
void assumeContract(AbstractInterpretation &interpretation, const ProgramSet &programs, FileId file,
                    const FileContracts &contracts, const Contract &contract, AbstractState &entry);

} // namespace feedhold
