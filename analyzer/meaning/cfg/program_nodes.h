// The nodes of one program, and what they show without values: where they stand, which raise an alarm of the program,
// and which tests decide about that alone.
#pragma once

#include "meaning/cfg/program_set.h"

#include <vector>

namespace feedhold {

/// The nodes of a program stand together from its entry on: how many they are.
std::size_t nodesOf(const ProgramFile &file, ProgramId program);

/// The variable that the text reads or writes there, by its number or its name.  Absent: the number is computed, or the
/// name means nothing in the set.
std::optional<std::uint32_t> variableOf(const ProgramSet &programs, FileId file, const VariableUse &use);

/// The assignment of the node that raises an alarm of the program (`#3000=`); null: there is none.
const Assignment *ownAlarmAt(const ProgramFile &file, NodeId node);

/// A test of which one side raises an alarm of the program at once.  Guards on a longer way to their alarm, and as
/// conditions over the inputs: findings/draft/guard_table.h.
struct GuardTest {
  NodeId test;
  bool refuses; // the outcome of the test that leads to the alarm
  NodeId alarm;
};
/// In the order of the nodes, which is that of the text.
std::vector<GuardTest> guardTestsOf(const ProgramFile &file, ProgramId program);

} // namespace feedhold
