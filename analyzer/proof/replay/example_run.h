// Example run: one call that a contract allows, for the picture in the release report.
#pragma once

#include "language/contract/contract.h"
#include "meaning/machine/machine.h"

#include <optional>

namespace feedhold {

/// The program has come to an end of its own.
bool hasEnded(RunEnd end);

namespace prove {

struct ExampleRun {
  RunOptions options;
  RunResult result;
};

/// Started as the contract says, on values in the middle of what it allows, or at its ends where those show more of the
/// program.  Without a contract: without arguments.  Absent: no run was found that satisfies the contract.
std::optional<ExampleRun> exampleRun(const ProgramSet &programs, Callee program, const FileContracts &contracts);

} // namespace prove

} // namespace feedhold
