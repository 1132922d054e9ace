// FlowPath: how a run comes from one place of a program to another, block by block.
#pragma once

#include "findings/rule/rule.h"

#include <functional>

namespace feedhold {

/// The shortest path over instructions that are reached, from behind `from` to `to`, not over those that `blocked`
/// names. Absent when there is none.
std::optional<std::vector<NodeId>> findPath(const FlowFacts &facts, NodeId from, NodeId to,
                                            const std::function<bool(NodeId)> &blocked);

/// The first of some nodes, which ascend, to which there is such a path; one search for all of them.
std::optional<NodeId> firstReached(const FlowFacts &facts, NodeId from, std::span<const NodeId> wanted,
                                   const std::function<bool(NodeId)> &blocked);

/// The places of a path where something is decided: branches with what they decided, jumps, calls.  For
/// Diagnostic::flow.
std::vector<Label> describePath(const FlowFacts &facts, std::span<const NodeId> path);
/// Only those that pass over one of some nodes: the jumps and false conditions for which it is not executed.  All where
/// none does.
std::vector<Label> describePathPast(const FlowFacts &facts, std::span<const NodeId> path,
                                    const std::function<bool(NodeId)> &isPassed);

/// Both: the path from the head of the program to a node; empty where there is nothing to tell.
std::vector<Label> pathFromEntry(
    const FlowFacts &facts, NodeId to, const std::function<bool(NodeId)> &blocked = [](NodeId) { return false; });

/// The first node of the program that is of a block and is reached; absent when none is.
std::optional<NodeId> reachedNode(const FlowFacts &facts, BlockId block);

} // namespace feedhold
