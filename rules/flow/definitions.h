// Which assignments a variable may hold its value from, at a place of a program.
#pragma once

#include "rules/flow/flow_view.h"

#include <optional>
#include <vector>

namespace feedhold::rules {

struct Definitions {
  std::vector<NodeId> nodes; // of assignments, ascending
  bool fromEntry = false;    // as at the start of the program

  bool areOnly(NodeId node) const { return !fromEntry && nodes.size() == 1 && nodes.front() == node; }
  friend bool operator==(const Definitions &, const Definitions &) = default;
};

/// Before the node is executed.  Absent where something may set the variable that is no assignment to it by its number
/// or name, and for variables that the control sets.
std::optional<Definitions> definitionsOf(const FlowFacts &facts, std::uint32_t variable, NodeId at);

/// The value that an assignment of the node gives to the variable; absent where it has none.
std::optional<Assignment> assignmentTo(const FlowFacts &facts, NodeId node, std::uint32_t variable);

/// The node from which every run of the program comes to this one; absent where there are several, at its head, and at
/// a label to which a return may lead (`M99 P100`).
std::optional<NodeId> onlyPredecessor(const FlowFacts &facts, NodeId node);

/// A test that is passed on each path to a place, always to the same side.
struct PassedTest {
  NodeId node;
  bool isTrue;
};
/// The last first.
std::vector<PassedTest> testsBefore(const FlowFacts &facts, NodeId at);
/// No path from the head of the program to the place goes round the node.
bool isPassedAlways(const FlowFacts &facts, NodeId node, NodeId at);

} // namespace feedhold::rules
