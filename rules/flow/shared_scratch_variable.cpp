// shared-scratch-variable: a macro counts with `#100`, and so does the macro that it calls.
#include "rules/flow/flow_view.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace feedhold::rules::shared_scratch_variable {
namespace {

/// Common variables that the called program writes before it reads them, and reads itself: for its own use.
std::set<std::uint32_t> scratchOf(const ProgramFile &file, ProgramId program) {
  std::set<std::uint32_t> written;
  std::set<std::uint32_t> readFirst;
  std::set<std::uint32_t> scratch;
  for (const VariableUse &use : file.model->variablesOf(program)) {
    if (!use.number || *use.number >= kFirstNamedVariable)
      continue;
    const VariableRange *range = findVariable(*file.dialect, *use.number);
    if (!range || range->kind != VariableKind::Common)
      continue;
    if (use.write)
      written.insert(*use.number);
    else if (!written.contains(*use.number))
      readFirst.insert(*use.number);
    else if (!readFirst.contains(*use.number))
      scratch.insert(*use.number);
  }
  return scratch;
}

/// Where the caller reads and writes a variable.
struct CallerUse {
  std::vector<NodeId> writes;
  std::vector<NodeId> reads;
  bool writesAt(NodeId node) const { return std::ranges::find(writes, node) != writes.end(); }
};

CallerUse usesIn(const FlowFacts &facts, std::uint32_t variable) {
  CallerUse found;
  for (const VariableUse &use : facts.file.model->variablesOf(facts.program)) {
    if (use.number != variable)
      continue;
    const auto node = use.write ? nodeOf(facts, use.block, use.expression) : reachedNode(facts, use.block);
    if (node)
      (use.write ? found.writes : found.reads).push_back(*node);
  }
  return found;
}

/// A path from `from` to some of the nodes that passes no write, and not the call.
std::optional<NodeId> reachesFrom(const FlowFacts &facts, NodeId from, const std::vector<NodeId> &to,
                                  const CallerUse &use, NodeId call) {
  for (const NodeId each : to)
    if (findPath(facts, from, each, [&](NodeId node) { return use.writesAt(node) || node == call; }))
      return each;
  return std::nullopt;
}

/// `#100=#100+1`: the caller counts with the variable, so what it finds there is not meant as a result of the call.
bool countsWith(const FlowFacts &facts, NodeId node, std::uint32_t variable) {
  return std::ranges::any_of(assignmentsOf(facts, node), [&](const Assignment &assignment) {
    if (variableOf(facts, assignment.target) != variable)
      return false;
    const auto reads = readsIn(facts.file, assignment.value, facts.node(node).block);
    return std::ranges::any_of(reads, [&](const Read &read) { return read.number == variable; });
  });
}

/// The value of the caller is used on both sides of the call: it is no result of the called program.
std::optional<NodeId> usedAfter(const FlowFacts &facts, const CallerUse &use, NodeId call) {
  const auto after = reachesFrom(facts, call, use.reads, use, call);
  if (!after)
    return std::nullopt;
  for (const NodeId write : use.writes) {
    const auto blocked = [&](NodeId node) { return use.writesAt(node); };
    if (findPath(facts, write, call, blocked) && reachesFrom(facts, write, use.reads, use, call))
      return after;
  }
  return std::nullopt;
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (isTooLarge(facts))
    return;
  std::set<std::uint32_t> done;
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next()) {
    const auto *instruction = std::get_if<CallProgram>(&facts.node(node).instruction);
    if (!instruction || !facts.isReached(node))
      continue;
    const Call &call = context.model.calls[instruction->call];
    const auto callee = context.callGraph.callee(context.file, call);
    if (!callee || callee == ProgramRef{context.file, facts.program})
      continue;
    const ProgramFile &file = facts.programs.file(callee->file);
    for (const std::uint32_t variable : scratchOf(file, callee->program)) {
      const CallerUse use = usesIn(facts, variable);
      const auto after = use.writes.empty() ? std::nullopt : usedAfter(facts, use, node);
      if (!after || !done.insert(variable).second)
        continue;
      reporter.report(
          {.message = fmt::format("{} overwrites `#{}`, whose value is still needed after the call",
                                  toString(file.model->programs[callee->program].name), variable),
           .span = call.span,
           .labels = {{context.tree.blocks[facts.node(*after).block].span(), "read here after the call"}},
           .notes = {"all programs share the common variables", "use a local variable: each macro has its own"}},
          countsWith(facts, *after, variable) ? Severity::Warning : Severity::Info);
    }
  }
}

} // namespace

extern const Rule sharedScratchVariable;
const Rule sharedScratchVariable{
    .info = {"shared-scratch-variable", Category::Flow, Severity::Warning,
             "Reports a call to a program that overwrites a common variable which the caller still needs."},
    .hooks = {.flow = check}};

} // namespace feedhold::rules::shared_scratch_variable
