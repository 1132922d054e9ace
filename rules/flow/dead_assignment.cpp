// dead-assignment: `#3=5.` and then `#3=7.`, with nothing between that reads it.
#include "rules/flow/loop_view.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace feedhold::rules::dead_assignment {
namespace {

/// From one assignment; programs that people write read or overwrite a variable long before.
constexpr std::size_t kMostSteps = 300;

class DeadAssignments {
public:
  DeadAssignments(const FlowFacts &facts, const FileContext &context) : facts_(facts), context_(context) {}

  /// What overwrites the value on every path, none of which reads it; absent when it is read, or nothing overwrites it.
  std::optional<NodeId> overwriter(NodeId from, std::uint32_t variable) const {
    std::vector<NodeId> open{from};
    std::set<NodeId> seen;
    std::optional<NodeId> found;
    bool isRead = false;
    while (!open.empty() && !isRead && seen.size() < kMostSteps) {
      const NodeId node = open.back();
      open.pop_back();
      forEachSuccessor(facts_.file.cfg, *facts_.file.model, node, ProgramUse::Called, [&](NodeId next) {
        if (next < facts_.entry() || next >= facts_.end() || !seen.insert(next).second)
          return;
        if (mayRead(next, variable))
          isRead = true;
        else if (writes(next, variable))
          found = found ? std::min(*found, next) : next;
        else
          open.push_back(next);
      });
    }
    return isRead || seen.size() >= kMostSteps ? std::nullopt : found;
  }

private:
  bool mayRead(NodeId node, std::uint32_t variable) const {
    const auto &instruction = facts_.node(node).instruction;
    if (std::holds_alternative<Havoc>(instruction) || std::holds_alternative<ReturnFromProgram>(instruction))
      return true; // a caller by M98 sees it
    if (const auto *call = std::get_if<CallProgram>(&instruction))
      if (const CallKind kind = context_.model.calls[call->call].kind;
          kind != CallKind::Macro && kind != CallKind::Modal && kind != CallKind::ModalCancel)
        return true;
    return std::ranges::any_of(readsOf(facts_.file, facts_.node(node).block),
                               [&](const Read &read) { return read.number == variable; });
  }
  bool writes(NodeId node, std::uint32_t variable) const {
    const auto assignments = assignmentsOf(facts_, node);
    return std::ranges::any_of(assignments, [&](const Assignment &assignment) {
      return variableNumber(context_.tree, unwrapped(context_.tree, assignment.target)) == variable;
    });
  }

  const FlowFacts &facts_;
  const FileContext &context_;
};

/// Nothing but the text of the program reads its local variables by number.
bool isTransparent(const FlowFacts &facts) {
  const auto uses = facts.file.model->variablesOf(facts.program);
  return std::ranges::all_of(uses, [&](const VariableUse &use) {
    return (use.number || use.write) && !facts.file.tree->blocks[use.block].has(Block::kBroken);
  });
}

/// A habit at the head of a program: nothing is lost.
bool isCleared(const FileContext &context, const Assignment &assignment) {
  const auto literal = literalValue(context.tree, assignment.value);
  return isVacant(context, assignment.value) || (literal && literal->isZero());
}

/// `#106=250.` alone in a block that is always executed.
struct Setting {
  Span target;
  std::uint32_t variable;
  Decimal value;
};

std::optional<Setting> settingIn(const FlowFacts &facts, const FileContext &context, BlockId id) {
  const Block &block = context.tree.blocks[id];
  const auto statements = context.tree.statementsOf(id);
  const auto *assignment = statements.size() == 1 ? std::get_if<Assignment>(&statements.front().node) : nullptr;
  const bool isAlone =
      std::ranges::all_of(context.tree.wordsOf(id), [](const Word &word) { return word.address() == 'N'; });
  if (!assignment || !isAlone || block.has(Block::kSkip) || block.has(Block::kSkipInside) || block.has(Block::kBroken))
    return std::nullopt;
  const auto variable = variableOf(facts, assignment->target);
  const auto value = literalValue(context.tree, assignment->value);
  if (!variable || !value || !isPlain(facts.file, *variable))
    return std::nullopt;
  return Setting{context.tree.expressions[assignment->target].span, *variable, *value};
}

/// The next block that holds more than a comment.
BlockId contentBehind(const FileContext &context, BlockId block, BlockId end) {
  block = block.next();
  while (block < end && isEmpty(context.tree, block))
    block = block.next();
  return block;
}

/// `#106=250.` and, as the next thing, `#106=62.5`: of any variable that only programs read.
void checkSettings(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  const Program &program = context.model.programs[facts.program];
  const auto targets = context.model.jumpTargetsOf(facts.program);
  for (const BlockId block : blocksOf(facts.file, facts.program)) {
    const auto first = settingIn(facts, context, block);
    if (!first || first->value.isZero() || !reachedNode(facts, block))
      continue;
    const BlockId next = contentBehind(context, block, program.last);
    const auto second = next < program.last && !targets.contains(next) ? settingIn(facts, context, next) : std::nullopt;
    if (!second || second->variable != first->variable || second->value == first->value)
      continue;
    reporter.report(
        {.message = fmt::format("this value of {} is overwritten by the next block", context.quoted(first->target)),
         .span = first->target,
         .labels = {{context.tree.blocks[next].span(), "overwritten here"}},
         .notes = {"nothing reads the first value; one of the two may have the wrong variable number"}});
  }
}

/// By checkSettings.
bool isTold(const FlowFacts &facts, const FileContext &context, NodeId first, NodeId second) {
  const BlockId block = facts.node(first).block;
  const BlockId next = facts.node(second).block;
  const auto one = settingIn(facts, context, block);
  const auto two = settingIn(facts, context, next);
  return one && two && one->value != two->value && !context.model.jumpTargetsOf(facts.program).contains(next) &&
         contentBehind(context, block, context.model.programs[facts.program].last) == next;
}

void checkLocals(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (isTooLarge(facts) || !isTransparent(facts))
    return;
  const DeadAssignments dead(facts, context);
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next())
    for (const Assignment &assignment : assignmentsOf(facts, node)) {
      const auto variable = variableNumber(context.tree, unwrapped(context.tree, assignment.target));
      if (!facts.isReached(node) || !variable || !isLocal(facts.file, *variable) || isCleared(context, assignment))
        continue;
      const auto overwriter = dead.overwriter(node, *variable);
      if (!overwriter || *overwriter == node || isTold(facts, context, node, *overwriter))
        continue;
      const Span span = context.tree.expressions[assignment.target].span;
      reporter.report(
          {.message = fmt::format("this value of {} is overwritten before it is read", context.quoted(span)),
           .span = span,
           .labels = {{context.tree.blocks[facts.node(*overwriter).block].span(), "overwritten here"}},
           .notes = {"one of the two assignments may have the wrong variable number"}});
    }
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  checkSettings(facts, context, reporter);
  checkLocals(facts, context, reporter);
}

} // namespace

extern const Rule deadAssignment;
const Rule deadAssignment{.info = {"dead-assignment", Category::Flow, Severity::Warning,
                                   "Reports a value of a variable that is overwritten before it is read."},
                          .hooks = {.flow = check}};

} // namespace feedhold::rules::dead_assignment
