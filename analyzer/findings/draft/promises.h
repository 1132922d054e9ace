// Promises: what a program may promise of its return, as its text and its flow suggest.  Each is proved before it is
// written.
#pragma once

#include "findings/draft/conditions.h"
#include "findings/draft/draft_clause.h"

namespace feedhold::draft {

/// Of each group the stronger ones first: of these the first that is proved is enough.
std::vector<DraftClauses> promiseGroups(const FlowFacts &facts);

} // namespace feedhold::draft
