// Plain space: the geometry clauses of a contract in numbers, for given arguments.
#pragma once

#include "language/contract/contract.h"
#include "proof/geometry/gouge.h"

namespace feedhold::prove {

/// Regions of one name together, in the order of namesOf (region_shapes.h).
geometry::PlainSpace plainSpace(const ProgramSet &programs, Callee program, const FileContracts &contracts,
                                const RunOptions &run);

/// An expression of the contract, for the arguments of a run.
double numberOf(const ProgramSet &programs, Callee program, const FileContracts &contracts, const RunOptions &run,
                ExpressionId expression);

/// The same run, started as the contract says: with its modal codes, and where it says.
RunOptions startedAsSaid(const ProgramSet &programs, Callee program, const FileContracts &contracts, RunOptions run);

/// Of `@FIXED`.
AxisSet fixedAxes(const Contract &contract);

/// The same run, with the path of the tool's centre, and with the axes of `@FIXED`.  The radius of `@TOOL` is taken for
/// an offset that nothing gives.  What it is given has to live as long as the options.
RunOptions followedAsSaid(const ProgramSet &programs, Callee program, const FileContracts *contracts, RunOptions run);

} // namespace feedhold::prove
