// Paths through a program on which no two conditions contradict each other.
#pragma once

#include "rules/flow/flow_view.h"

#include <functional>

namespace feedhold::rules {

/// A path from the head of the program to `to`, not over nodes that are `blocked`, whose conditions can all hold as
/// they are decided, as far as comparisons of one text with numbers or with another text say.  What the machine reports
/// of itself is taken to stay as it is; a WHILE runs at least once.  Absent: there is none, or the search gave up.
std::optional<std::vector<NodeId>> findConsistentPath(const FlowFacts &facts, NodeId to,
                                                      const std::function<bool(NodeId)> &blocked);

} // namespace feedhold::rules
