// How rules look at loops, whichever way they are written: WHILE, DO, or a GOTO backwards.
#pragma once

#include "findings/rule/flow_path.h"
#include "rules/flow/flow_view.h"

#include <algorithm>
#include <set>
#include <string_view>
#include <vector>

namespace feedhold::rules {

/// A test that leaves a loop on one side.
struct LoopExit {
  NodeId test;
  ExpressionId condition;
  bool leavesWhenTrue;
};

/// Nodes that lead back to their head: all that do so together, and where several edges lead back, those of each alone.
struct LoopFlow {
  NodeId head;
  std::vector<NodeId> nodes;
  std::vector<LoopExit> exits;
  /// Tests are the only ways out, and all of them are in `exits`.
  bool exitsAreKnown = true;
  /// A call, a stop for the operator, or something that could not be read: variables may change unseen.
  bool changesUnseen = false;
  /// The only such things are calls of programs that have local variables of their own and always return.
  bool keepsLocals = true;
  /// The control may stop with an alarm in it, in some pass of some run.
  bool mayStop = false;
};

/// What a message may say of a loop without a way out: `this loop never ends`, unless an alarm may stop it.
std::string_view endlessnessOf(const LoopFlow &loop);

/// The one way out of a loop in which nothing changes unseen; null: there are others, or not all are known.
const LoopExit *onlyExit(const LoopFlow &loop);

/// The loops of a program, outer ones before those inside.
const std::vector<LoopFlow> &loopsOf(const FlowFacts &facts);

/// There is a way from one node to another past those where `isOver`, also if each loop with a node where `sets`, and
/// without the other one, runs at least once: to do nothing is not what a loop is for.
template <typename Sets, typename IsOver>
bool reachesPastLoops(const FlowFacts &facts, NodeId from, NodeId to, Sets &&sets, IsOver &&isOver) {
  std::set<NodeId> heads;
  for (const LoopFlow &loop : isTooLarge(facts) ? std::vector<LoopFlow>{} : loopsOf(facts))
    if (std::ranges::any_of(loop.nodes, sets) && std::ranges::find(loop.nodes, to) == loop.nodes.end())
      heads.insert(loop.head);
  return heads.empty() ||
         findPath(facts, from, to, [&](NodeId node) { return isOver(node) || heads.contains(node); }).has_value();
}

/// An assignment in the loop that may give the variable another value.
struct LoopWrite {
  NodeId node;
  Assignment assignment;
};
/// Absent: something in the loop may write it that is not an assignment to it by its number.
std::optional<std::vector<LoopWrite>> writesTo(const FlowFacts &facts, const LoopFlow &loop, std::uint32_t variable);

/// `#1=#1-#2`: by what, and which way.
struct LoopStep {
  ExpressionId size;
  bool isMinus;
};
std::optional<LoopStep> stepOf(const FlowFacts &facts, const Assignment &assignment, std::uint32_t variable);

/// Whose value stays as long as nobody writes it: local, common and retentive variables.
bool isPlain(const ProgramFile &file, std::uint32_t variable);

/// The condition asks what the control reports of itself, or a setting: it is there to be sure, and may have one
/// outcome.
bool isAskedToBeSure(const FlowFacts &facts, ExpressionId condition, BlockId block);

} // namespace feedhold::rules
