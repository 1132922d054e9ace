// Loops as components of the graph.
#include "rules/flow/loop_view.h"

#include "language/model/block_facts.h"
#include "meaning/cfg/wto.h"

#include <algorithm>
#include <map>
#include <set>

namespace feedhold::rules {
namespace {

bool contains(const LoopFlow &loop, NodeId node) { return std::ranges::binary_search(loop.nodes, node); }

/// A stop gives the operator the time to change variables; an M code that the tables do not know may be a call.
bool mayChangeUnseen(const FlowFacts &facts, NodeId node) {
  const Instruction &instruction = facts.node(node).instruction;
  if (std::holds_alternative<Havoc>(instruction) || std::holds_alternative<CallProgram>(instruction))
    return true;
  if (!std::holds_alternative<ExecuteWords>(instruction))
    return false;
  const BlockId block = facts.node(node).block;
  const SyntaxTree &tree = *facts.file.tree;
  return findCode(tree, block, *facts.file.dialect, CodeRole::ProgramStop) ||
         std::ranges::any_of(tree.wordsOf(block), [&](const Word &word) {
           return word.address() == 'M' && word.isCode() && !codeOf(word, *facts.file.dialect);
         });
}

/// Where calls of calls are not followed, they may not.
bool alwaysReturns(const FlowFacts &facts, ProgramRef callee) {
  const ProgramFile &file = facts.programs.file(callee.file);
  if (!file.model->callsOf(callee.program).empty())
    return false;
  return std::ranges::none_of(blocksOf(file, callee.program), [&](BlockId block) {
    return findCode(*file.tree, block, *file.dialect, CodeRole::ProgramEnd) != nullptr;
  });
}

/// `G65 P9100`: its assignments do not reach the local variables of the caller.
bool keepsLocals(const FlowFacts &facts, NodeId node) {
  const auto *program = std::get_if<CallProgram>(&facts.node(node).instruction);
  if (!program)
    return false;
  const Call &call = facts.file.model->calls[program->call];
  const bool isOwnLevel = call.kind == CallKind::Macro || call.kind == CallKind::OWord || call.kind == CallKind::Code;
  const auto callee = isOwnLevel ? facts.programs.callGraph().callee(facts.file.file, call) : std::nullopt;
  return callee && alwaysReturns(facts, *callee);
}

/// The program that is called here may raise one.
bool mayCallAlarm(const FlowFacts &facts, NodeId node) {
  const auto *program = std::get_if<CallProgram>(&facts.node(node).instruction);
  if (!program)
    return false;
  const auto callee = facts.programs.callGraph().callee(facts.file.file, facts.file.model->calls[program->call]);
  if (!callee)
    return true;
  const ProgramFile &file = facts.programs.file(callee->file);
  return !file.model->callsOf(callee->program).empty() ||
         std::ranges::any_of(file.model->variablesOf(callee->program), [&](const VariableUse &use) {
           return use.write && use.number && raisesAlarm(*file.dialect, *use.number);
         });
}

void addExits(const FlowFacts &facts, LoopFlow &loop, NodeId node) {
  const Node &here = facts.node(node);
  const auto *test = std::get_if<Test>(&here.instruction);
  bool leaves = false;
  forEachSuccessor(facts.file.cfg, *facts.file.model, node, ProgramUse::Called,
                   [&](NodeId next) { leaves = leaves || (!contains(loop, next) && next != node); });
  if (!leaves)
    return;
  if (!test || !test->condition) {
    loop.exitsAreKnown = false;
    return;
  }
  loop.exits.push_back({node, *test->condition, !contains(loop, test->taken)});
}

LoopFlow described(const FlowFacts &facts, LoopFlow loop) {
  for (const NodeId node : loop.nodes) {
    addExits(facts, loop, node);
    const bool isUnseen = mayChangeUnseen(facts, node);
    loop.changesUnseen = loop.changesUnseen || isUnseen;
    loop.keepsLocals = loop.keepsLocals && (!isUnseen || keepsLocals(facts, node));
  }
  const auto isInside = [&](const auto &alarm) { return contains(loop, alarm.node); };
  loop.mayStop = std::ranges::any_of(facts.alarms(), isInside) || std::ranges::any_of(facts.userAlarms(), isInside) ||
                 std::ranges::any_of(loop.nodes, [&](NodeId node) { return mayCallAlarm(facts, node); });
  return loop;
}

/// A component, and the natural loop of each edge to its head where there are several: what leads to the start of the
/// edge without passing the head.  Nothing when no edge leads back: its passes are never reached.
std::vector<std::vector<NodeId>> partsOf(const FlowFacts &facts, NodeId head, const std::vector<NodeId> &all) {
  std::map<NodeId, std::vector<NodeId>> predecessors;
  for (const NodeId node : all)
    forEachSuccessor(facts.file.cfg, *facts.file.model, node, ProgramUse::Called, [&](NodeId next) {
      if (std::ranges::binary_search(all, next))
        predecessors[next].push_back(node);
    });
  const std::vector<NodeId> tails = predecessors[head];
  if (tails.empty())
    return {};
  std::vector<std::vector<NodeId>> parts{all};
  for (const NodeId tail : tails) {
    std::vector<NodeId> open{tail};
    std::set<NodeId> inside{head, tail};
    while (!open.empty()) {
      const NodeId node = open.back();
      open.pop_back();
      for (const NodeId before : node == head ? std::vector<NodeId>{} : predecessors[node])
        if (inside.insert(before).second)
          open.push_back(before);
    }
    if (inside.size() < all.size())
      parts.emplace_back(inside.begin(), inside.end());
  }
  return parts;
}

std::vector<LoopFlow> findLoops(const FlowFacts &facts) {
  std::vector<LoopFlow> loops;
  const Wto wto(facts.file.cfg, *facts.file.model, facts.entry());
  for (const NodeId head : wto.order()) {
    if (!wto.isHead(head) || !facts.isReached(head))
      continue;
    std::vector<NodeId> all;
    for (std::uint32_t i = wto.positionOf(head); i < wto.endOf(head); ++i)
      if (facts.isReached(wto.order()[i]))
        all.push_back(wto.order()[i]);
    std::ranges::sort(all);
    for (std::vector<NodeId> &nodes : partsOf(facts, head, all))
      loops.push_back(described(facts, {head, std::move(nodes), {}}));
  }
  return loops;
}

} // namespace

std::string_view endlessnessOf(const LoopFlow &loop) {
  return loop.mayStop ? "only an alarm ends this loop" : "this loop never ends";
}

const LoopExit *onlyExit(const LoopFlow &loop) {
  const bool isKnown = loop.exitsAreKnown && loop.exits.size() == 1 && !loop.changesUnseen;
  return isKnown ? &loop.exits.front() : nullptr;
}

const std::vector<LoopFlow> &loopsOf(const FlowFacts &facts) {
  return facts.derived<std::vector<LoopFlow>>([&] { return findLoops(facts); });
}

std::optional<std::vector<LoopWrite>> writesTo(const FlowFacts &facts, const LoopFlow &loop, std::uint32_t variable) {
  std::vector<LoopWrite> writes;
  for (const NodeId node : loop.nodes)
    for (const Assignment &assignment : assignmentsOf(facts, node)) {
      const auto target = variableOf(facts, assignment.target);
      if (!target)
        return std::nullopt;
      const bool toItself = variableOf(facts, assignment.value) == target;
      if (*target == variable && !toItself)
        writes.push_back({node, assignment});
    }
  return writes;
}

std::optional<LoopStep> stepOf(const FlowFacts &facts, const Assignment &assignment, std::uint32_t variable) {
  const SyntaxTree &tree = *facts.file.tree;
  const auto *sum = asInside<BinaryOperation>(tree, assignment.value);
  if (!sum || (sum->op != OperatorKind::Add && sum->op != OperatorKind::Subtract))
    return std::nullopt;
  const auto isVariable = [&](ExpressionId id) { return variableOf(facts, id) == variable; };
  if (isVariable(sum->left) && !isVariable(sum->right))
    return LoopStep{sum->right, sum->op == OperatorKind::Subtract};
  if (isVariable(sum->right) && !isVariable(sum->left) && sum->op == OperatorKind::Add)
    return LoopStep{sum->left, false};
  return std::nullopt;
}

bool isPlain(const ProgramFile &file, std::uint32_t variable) {
  const VariableRange *range = variable >= kFirstNamedVariable ? nullptr : findVariable(*file.dialect, variable);
  return range && range->kind != VariableKind::System && range->kind != VariableKind::Vacant;
}

namespace {

/// A setting, or what the control reports of itself, or a copy of it.
bool comesFromControl(const FlowFacts &facts, std::uint32_t variable) {
  if (variable != kVacantVariable && !isPlain(facts.file, variable))
    return true;
  const SyntaxTree &tree = *facts.file.tree;
  for (const VariableUse &use : facts.file.model->variablesOf(facts.program)) {
    if (!use.write || use.number != variable)
      continue;
    const auto reads = readsOf(facts.file, use.block);
    for (const Read &read : reads)
      if (read.use != ReadUse::Equality && read.number && *read.number != kVacantVariable &&
          !isPlain(facts.file, *read.number))
        return true;
    const bool isDefault = std::ranges::any_of(
        reads, [&](const Read &read) { return read.use == ReadUse::Equality && read.number == variable; });
    for (const Statement &statement : tree.statementsOf(use.block))
      if (const auto *assignment = std::get_if<Assignment>(&statement.node);
          assignment && !isDefault && literalValue(tree, assignment->value))
        return true; // a setting
  }
  return false;
}

} // namespace

bool isAskedToBeSure(const FlowFacts &facts, ExpressionId condition, BlockId block) {
  const auto reads = readsIn(facts.file, condition, block);
  return std::ranges::any_of(reads,
                             [&](const Read &read) { return !read.number || comesFromControl(facts, *read.number); });
}

} // namespace feedhold::rules
