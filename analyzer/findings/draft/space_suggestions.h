// Space suggestions: `@TOOL` and `@KEEPIN`, for the reader to complete.  What a tool may not touch stands in no
// program.
#pragma once

#include "findings/draft/draft_clause.h"
#include "findings/project/project.h"
#include "inference/absint/flow_facts.h"

namespace feedhold::draft {

/// Hints, or nothing: the tool where a comment names a variable as its diameter or radius; the region where, in all
/// calls that the contract allows, the program cuts along straight lines between known bounds.
DraftClauses spaceSuggestions(const Project &project, const FlowFacts &facts, const FileContracts &contracts);

} // namespace feedhold::draft
