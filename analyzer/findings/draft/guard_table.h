// Guard table: what the head of a program asks of its inputs before it goes on, as conditions over the values on entry.
//
// A guard is a test of which one side raises an alarm of the program (`#3000=`) whatever happens.  The table is found
// on the graph: paths are followed forward from the head; where all that go on meet again, what was asked on the way
// is forgotten.
//
// proof/guards answers another question: which conditions, written nowhere, would make an open claim hold.  It builds
// terms from the formulas of a proof; a clause of this table has the text and the line of the test in the program, and
// is there for programs of which nothing can be proved.  So the two share no code.
#pragma once

#include "findings/draft/conditions.h"

namespace feedhold::draft {

/// The program goes on only where one of the alternatives holds.
struct Guard {
  Alternatives needs;
  std::optional<std::uint32_t> alarm; // that is raised otherwise; absent: one of several, or computed
  BlockId test;
};

/// `IF[#9EQ#0]THEN#9=100`
struct Default {
  std::uint32_t variable;
  std::string value; // as the program writes it
  BlockId block;
};

struct GuardTable {
  std::vector<Guard> guards; // in the order in which they are come to
  std::vector<Default> defaults;

  /// Null: it has none.
  const Default *defaultOf(std::uint32_t variable) const;
};

GuardTable guardTableOf(const FlowFacts &facts);

} // namespace feedhold::draft
