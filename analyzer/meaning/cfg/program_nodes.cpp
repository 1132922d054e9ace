#include "meaning/cfg/program_nodes.h"

#include <algorithm>

namespace feedhold {

namespace {

constexpr int kMostPasses = 8; // sequence numbers and GOTO between the test and the alarm

std::optional<NodeId> alarmFrom(const ProgramFile &file, NodeId node) {
  for (int i = 0; i < kMostPasses; ++i) {
    if (ownAlarmAt(file, node))
      return node;
    const Node &at = file.cfg.nodes[node];
    if (!std::holds_alternative<Pass>(at.instruction) || at.next == node)
      break;
    node = at.next;
  }
  return std::nullopt;
}

} // namespace

std::size_t nodesOf(const ProgramFile &file, ProgramId program) {
  const std::size_t first = file.cfg.entryOf(program).index();
  const std::size_t next = program.index() + 1;
  if (next == file.cfg.entries.size())
    return file.cfg.nodes.size() - first;
  if (file.cfg.entries[next].index() > first && !file.model->programs[ProgramId(next)].within)
    return file.cfg.entries[next].index() - first;
  std::size_t end = file.cfg.nodes.size(); // subroutines stand behind the program around them
  for (const NodeId entry : file.cfg.entries)
    if (entry.index() > first)
      end = std::min<std::size_t>(end, entry.index());
  return end - first;
}

std::optional<std::uint32_t> variableOf(const ProgramSet &programs, FileId file, const VariableUse &use) {
  const auto *named = std::get_if<NamedVariable>(&programs.file(file).tree->expressions[use.expression].node);
  return named ? programs.variableOf(file, named->name) : use.number;
}

const Assignment *ownAlarmAt(const ProgramFile &file, NodeId node) {
  const auto *assign = std::get_if<Assign>(&file.cfg.nodes[node].instruction);
  if (!assign)
    return nullptr;
  for (std::uint32_t i = 0; i < assign->count; ++i) {
    const Statement &statement = file.tree->statements[StatementId(assign->first.index() + i)];
    const auto *assignment = std::get_if<Assignment>(&statement.node);
    const auto target = assignment ? variableNumber(*file.tree, assignment->target) : std::nullopt;
    if (target && raisesAlarm(*file.dialect, *target))
      return assignment;
  }
  return nullptr;
}

std::vector<GuardTest> guardTestsOf(const ProgramFile &file, ProgramId program) {
  std::vector<GuardTest> tests;
  const std::size_t count = nodesOf(file, program);
  NodeId node = file.cfg.entryOf(program);
  for (std::size_t i = 0; i < count; ++i, node = node.next()) {
    const auto *test = std::get_if<Test>(&file.cfg.nodes[node].instruction);
    if (!test || !test->condition)
      continue;
    const auto taken = alarmFrom(file, test->taken);
    const auto next = alarmFrom(file, file.cfg.nodes[node].next);
    if (taken.has_value() != next.has_value()) // else nothing goes on, or nothing is refused
      tests.push_back({node, taken.has_value(), taken ? *taken : *next});
  }
  return tests;
}

} // namespace feedhold
