// Reaching definitions, one question at a time: a program asks few.
#include "rules/flow/definitions.h"

#include "rules/flow/loop_view.h"

#include <algorithm>
#include <functional>

namespace feedhold::rules {
namespace {

struct Predecessors {
  std::vector<std::vector<NodeId>> of; // from the entry on
};

const Predecessors &predecessorsOf(const FlowFacts &facts) {
  return facts.derived<Predecessors>([&] {
    Predecessors all{std::vector<std::vector<NodeId>>(facts.end().index() - facts.entry().index())};
    for (NodeId node = facts.entry(); node < facts.end(); node = node.next())
      if (facts.isReached(node))
        forEachSuccessor(facts.file.cfg, *facts.file.model, node, ProgramUse::Called, [&](NodeId next) {
          if (next != node && next >= facts.entry() && next < facts.end() && facts.isReached(next))
            all.of[next.index() - facts.entry().index()].push_back(node);
        });
    return all;
  });
}

enum class Effect : std::uint8_t { None, Sets, Unknown };

bool callMaySet(const FlowFacts &facts, const CallProgram &call, std::uint32_t variable) {
  if (facts.programs.isLocalName(variable))
    return false;
  const CallKind kind = facts.file.model->calls[call.call].kind;
  return !isLocal(facts.file, variable) || kind == CallKind::Subprogram || kind == CallKind::Local ||
         kind == CallKind::External;
}

Effect effectOf(const FlowFacts &facts, NodeId node, std::uint32_t variable) {
  const Instruction &instruction = facts.node(node).instruction;
  if (std::holds_alternative<Havoc>(instruction))
    return Effect::Unknown;
  if (const auto *call = std::get_if<CallProgram>(&instruction))
    return callMaySet(facts, *call, variable) ? Effect::Unknown : Effect::None;
  Effect effect = Effect::None;
  for (const Assignment &assignment : assignmentsOf(facts, node)) {
    const auto target = variableOf(facts, assignment.target);
    if (!target)
      return Effect::Unknown;
    if (*target == variable)
      effect = effect == Effect::Sets ? Effect::Unknown : Effect::Sets;
  }
  return effect;
}

/// Walks backwards from a node, not beyond those for which `goesOn` is false.
void walkBack(const FlowFacts &facts, NodeId from, const std::function<bool(NodeId)> &goesOn) {
  const Predecessors &predecessors = predecessorsOf(facts);
  const auto indexOf = [&](NodeId node) { return node.index() - facts.entry().index(); };
  std::vector<bool> seen(predecessors.of.size());
  std::vector<NodeId> open{from};
  while (!open.empty()) {
    const NodeId node = open.back();
    open.pop_back();
    for (const NodeId before : predecessors.of[indexOf(node)]) {
      if (seen[indexOf(before)])
        continue;
      seen[indexOf(before)] = true;
      if (goesOn(before))
        open.push_back(before);
    }
  }
}

/// The place is reached from the node without passing the test.
bool leadsTo(const FlowFacts &facts, NodeId from, NodeId at, NodeId test) {
  bool found = from == at;
  if (!found && from != test)
    walkBack(facts, at, [&](NodeId node) {
      found = found || node == from;
      return !found && node != test;
    });
  return found;
}

} // namespace

bool isPassedAlways(const FlowFacts &facts, NodeId node, NodeId at) { return !leadsTo(facts, facts.entry(), at, node); }

std::optional<Definitions> definitionsOf(const FlowFacts &facts, std::uint32_t variable, NodeId at) {
  if (isTooLarge(facts) || (variable < kFirstNamedVariable && !isPlain(facts.file, variable)))
    return std::nullopt;
  Definitions found;
  bool isKnown = true;
  found.fromEntry = at == facts.entry();
  walkBack(facts, at, [&](NodeId node) {
    const Effect effect = effectOf(facts, node, variable);
    isKnown = isKnown && effect != Effect::Unknown;
    if (effect == Effect::Sets)
      found.nodes.push_back(node);
    else if (node == facts.entry())
      found.fromEntry = true;
    return isKnown && effect == Effect::None;
  });
  std::ranges::sort(found.nodes);
  return isKnown ? std::optional(found) : std::nullopt;
}

std::optional<Assignment> assignmentTo(const FlowFacts &facts, NodeId node, std::uint32_t variable) {
  for (const Assignment &assignment : assignmentsOf(facts, node))
    if (variableOf(facts, assignment.target) == variable)
      return assignment;
  return std::nullopt;
}

std::optional<NodeId> onlyPredecessor(const FlowFacts &facts, NodeId node) {
  const auto &before = predecessorsOf(facts).of[node.index() - facts.entry().index()];
  if (node == facts.entry() || before.size() != 1)
    return std::nullopt;
  const auto words = facts.file.tree->wordsOf(facts.node(node).block);
  const bool isLabel = std::ranges::any_of(words, [](const Word &word) { return word.address() == 'N'; });
  const ProgramModel &model = *facts.file.model;
  const bool mayReturnHere = !model.callsOf(facts.program).empty() || model.programs[facts.program].returns;
  return isLabel && mayReturnHere ? std::nullopt : std::optional(before.front());
}

std::vector<PassedTest> testsBefore(const FlowFacts &facts, NodeId at) {
  std::vector<NodeId> tests;
  walkBack(facts, at, [&](NodeId node) {
    const auto *test = std::get_if<Test>(&facts.node(node).instruction);
    if (node != at && test && test->condition)
      tests.push_back(node);
    return true;
  });
  std::vector<PassedTest> passed;
  for (const NodeId node : tests) {
    const bool byTaken = leadsTo(facts, std::get<Test>(facts.node(node).instruction).taken, at, node);
    const bool byNext = leadsTo(facts, facts.node(node).next, at, node);
    if (byTaken != byNext && isPassedAlways(facts, node, at))
      passed.push_back({node, byTaken});
  }
  return passed;
}

} // namespace feedhold::rules
