// The rows of cutter compensation: who answers for the alarms of one, and what is asked.
//
// The program with the G41 or G42, by its contract.  If it has none, nothing is known of its offset, and of the way to
// it; its callers know both, and claims of theirs rest on its not stopping.
#pragma once

#include "proof/families/families.h"

namespace feedhold::prove {

/// No cutter compensation begins in the program or in one that it comes to: M72 and a return can restore none but that
/// which was in force at the start, and for that the caller answers, where it begins.
bool beginsNoCompensation(const ProofSubject &subject);

/// It has no contract, and all programs that call it have one, or are such programs themselves.
bool isCoveredByCallers(const ProofSubject &subject, ProgramRef program);

/// One for each G41 and G42 of the programs without a contract that the program calls, for all calls of it.
Questions calledCompensations(const ExploredProgram &program);

/// On each path where the compensation is followed the control does not stop.  False: it is not followed at all.
bool askCompensation(const Exploration &found, Place began, Question &question);

/// What a run does that stops in the compensation; absent: it does not.
std::optional<std::string> stopInCompensation(const RunResult &run, Place began);

} // namespace feedhold::prove
