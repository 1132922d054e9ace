// Reaching definitions, one question at a time: a program asks few.
#include "rules/flow/definitions.h"

#include "base/support/dominators.h"
#include "rules/flow/loop_view.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace feedhold::rules {
namespace {

struct Predecessors {
  std::vector<std::vector<NodeId>> of; // from the entry on
};

const Predecessors &predecessorsOf(const FlowFacts &facts) {
  return facts.derived<Predecessors>([&] {
    Predecessors all{std::vector<std::vector<NodeId>>(facts.end().index() - facts.entry().index())};
    std::vector<bool> stops(all.of.size()); // `#3000=`: nothing follows
    for (const UserAlarmFact &alarm : facts.userAlarms())
      stops[alarm.node.index() - facts.entry().index()] = true;
    for (NodeId node = facts.entry(); node < facts.end(); node = node.next())
      if (facts.isReached(node) && !stops[node.index() - facts.entry().index()])
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

/// Who dominates whom: the nodes from the entry on, and behind them the two ways out of each test as nodes of their
/// own. A test is passed always to one side where that way out dominates.
class PassedTests {
public:
  explicit PassedTests(const FlowFacts &facts)
      : entry_(facts.entry()), size_(facts.end().index() - facts.entry().index()), dominators_(graphOf(facts)),
        nearest_(findNearest()) {}

  bool isPassedAlways(NodeId node, NodeId at) const { return dominators_.isDominated(indexOf(at), indexOf(node)); }

  /// The last first.
  std::vector<PassedTest> before(NodeId at) const {
    std::vector<PassedTest> passed;
    for (std::uint32_t way = nearest_[indexOf(at)]; way != kNone; way = nearest_[indexOf(passed.back().node)])
      passed.push_back(ways_[way]);
    return passed;
  }

private:
  static constexpr std::uint32_t kNone = 0xffffffff;

  std::uint32_t indexOf(NodeId node) const { return node.index() - entry_.index(); }

  std::vector<std::vector<std::uint32_t>> graphOf(const FlowFacts &facts) {
    std::vector<std::vector<std::uint32_t>> successors(size_);
    const auto &predecessors = predecessorsOf(facts).of;
    for (std::uint32_t next = 0; next < predecessors.size(); ++next)
      for (const NodeId node : predecessors[next])
        successors[indexOf(node)].push_back(next);
    for (NodeId node = facts.entry(); node < facts.end(); node = node.next())
      if (const auto *test = std::get_if<Test>(&facts.node(node).instruction); test && test->condition)
        divide(node, indexOf(test->taken), successors);
    return successors;
  }

  void divide(NodeId node, std::uint32_t taken, std::vector<std::vector<std::uint32_t>> &successors) {
    std::vector<std::uint32_t> ways;
    bool wasTaken = false; // both ways may lead to one node
    for (const std::uint32_t next : std::exchange(successors[indexOf(node)], {})) {
      const bool isTaken = next == taken && !std::exchange(wasTaken, true);
      ways.push_back(size_ + static_cast<std::uint32_t>(ways_.size()));
      ways_.push_back({node, isTaken});
      successors.push_back({next});
    }
    successors[indexOf(node)] = std::move(ways);
  }

  /// By node: the nearest way out of a test that dominates it.
  std::vector<std::uint32_t> findNearest() const {
    std::vector<std::uint32_t> nearest(size_ + ways_.size(), kNone);
    for (const std::uint32_t node : dominators_.reached())
      if (const auto before = dominators_.immediate(node))
        nearest[node] = *before < size_ ? nearest[*before] : *before - size_;
    return nearest;
  }

  NodeId entry_;
  std::uint32_t size_;
  std::vector<PassedTest> ways_;
  Dominators dominators_;
  std::vector<std::uint32_t> nearest_;
};

const PassedTests &passedTestsOf(const FlowFacts &facts) {
  return facts.derived<PassedTests>([&] { return PassedTests(facts); });
}

} // namespace

bool isPassedAlways(const FlowFacts &facts, NodeId node, NodeId at) {
  return passedTestsOf(facts).isPassedAlways(node, at);
}

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

std::vector<PassedTest> testsBefore(const FlowFacts &facts, NodeId at) { return passedTestsOf(facts).before(at); }

} // namespace feedhold::rules
