// Modal needs: `@MODAL` for the modes that a program takes over from its callers.
#pragma once

#include "findings/draft/draft_clause.h"
#include "inference/absint/flow_facts.h"

namespace feedhold::draft {

/// Where all callers agree on the mode, a clause; else a hint.  `contracts`: of the file of the program.
DraftClauses modalNeeds(const FlowFacts &facts, const FileContracts &contracts);

} // namespace feedhold::draft
