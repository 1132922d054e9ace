// Entry clauses: `@PARAM`, `@GLOBAL` and `@REQUIRE` as the guards of a program ask for them.
#pragma once

#include "findings/draft/argument_notes.h"
#include "findings/draft/draft_clause.h"
#include "findings/draft/guard_table.h"

namespace feedhold::draft {

DraftClauses entryClauses(const Project &project, const FlowFacts &facts, const GuardTable &table);

} // namespace feedhold::draft
