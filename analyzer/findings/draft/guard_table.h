// Guard table: what the head of a program asks of its inputs before it goes on, as conditions over the values on entry.
//
// A guard is a test of which one side raises an alarm of the program (`#3000=`) whatever happens.  The table is found
// on the graph: paths are followed forward from the head; where all that go on meet again, what was asked on the way
// is forgotten.
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
  std::vector<Guard> guards;
  std::vector<Default> defaults;
};

GuardTable guardTableOf(const FlowFacts &facts);

} // namespace feedhold::draft
