// Guard promises: what guards say as `@ALARM` clauses, which runs and proofs can judge.
#pragma once

#include "findings/draft/draft_clause.h"
#include "findings/draft/guard_table.h"

namespace feedhold::draft {

/// Where a variable has a default, the guard asks of a given one alone.
Alternatives needsOf(const GuardTable &table, const Guard &guard);

/// `@ALARM 121 IF #18 LT 0.1`: the calls that this guard refuses, and no earlier one with another alarm.  Absent: the
/// number of the alarm is computed, or the clause would be too long.
std::optional<std::string> refusalOf(const GuardTable &table, const Guard &guard);

/// `@ALARM 11 IFF [#501 LE 0] OR [#501 GT 80]` of all guards with one alarm; with IF where that alone is proved.  By
/// number: alternatives, the strongest first.  `lineOf`: of the block of a test.
struct AlarmClauses {
  std::uint32_t alarm;
  DraftClauses alternatives;
};
std::vector<AlarmClauses> alarmClauses(const GuardTable &table, const SourceFile &source, const SyntaxTree &tree);

} // namespace feedhold::draft
