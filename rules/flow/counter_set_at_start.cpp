// counter-set-at-start: `#500=1`, and at the end of the program `#500=#500+1`.
#include "rules/flow/definitions.h"
#include "rules/flow/system_variables.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules::counter_set_at_start {
namespace {

/// `#500=#500+1` as the last thing that a program does with a variable that others do not see.
struct Count {
  std::uint32_t variable;
  Span span;
  ExpressionId read; // of the variable itself
};

std::optional<Count> countAt(const FlowFacts &facts, const FileContext &context, NodeId node) {
  for (const Assignment &assignment : assignmentsOf(facts, node)) {
    const auto *sum = asInside<BinaryOperation>(context.tree, assignment.value);
    if (!sum || (sum->op != OperatorKind::Add && sum->op != OperatorKind::Subtract))
      continue;
    const auto target = variableOf(facts, assignment.target);
    const ExpressionId read = unwrapped(context.tree, sum->left);
    if (!target || isLocal(facts.file, *target) || roleOf(context, *target) != VariableRole::Plain ||
        variableOf(facts, read) != target || !literalValue(context.tree, sum->right))
      continue;
    return Count{
        *target,
        cover(context.tree.expressions[assignment.target].span, context.tree.expressions[assignment.value].span), read};
  }
  return std::nullopt;
}

/// What happens behind the count, up to the ends of the program: nothing that may look at the variable.
bool isLastUse(const FlowFacts &facts, const Count &count, NodeId from) {
  std::vector<bool> seen(facts.end().index() - facts.entry().index());
  std::vector<NodeId> open{from};
  while (!open.empty()) {
    const NodeId at = open.back();
    open.pop_back();
    bool isQuiet = true;
    forEachSuccessor(facts.file.cfg, *facts.file.model, at, ProgramUse::Called, [&](NodeId next) {
      const std::size_t index = next.index() - facts.entry().index();
      if (seen[index])
        return;
      seen[index] = true;
      const Node &node = facts.node(next);
      const auto uses = facts.file.model->variablesIn(node.block, node.block.next());
      const bool reads = std::ranges::any_of(
          uses, [&](const VariableUse &use) { return !use.number || *use.number == count.variable; });
      const bool calls = std::holds_alternative<CallProgram>(node.instruction) ||
                         std::holds_alternative<Havoc>(node.instruction) ||
                         std::holds_alternative<HavocVariables>(node.instruction);
      isQuiet = isQuiet && !reads && !calls;
      open.push_back(next);
    });
    if (!isQuiet)
      return false;
  }
  return true;
}

/// Some other program of the run reads it, or this one a variable whose number it computes.
bool isSeenElsewhere(const FlowFacts &facts, std::uint32_t variable) {
  std::uint32_t own = 0;
  for (const VariableUse &use : facts.file.model->variablesOf(facts.program)) {
    if (use.write || facts.file.model->programOf(use.block) != facts.program)
      continue;
    if (!use.number)
      return true;
    own += *use.number == variable ? 1 : 0;
  }
  return facts.programs.usesOf(variable).reads > own;
}

/// The assignment of a number that the program comes to before the count.
std::optional<Span> startOf(const FlowFacts &facts, const FileContext &context, const Count &count, NodeId before) {
  std::optional<Span> found;
  for (NodeId node = facts.entry(); node < before; node = node.next())
    for (const Assignment &assignment : assignmentsOf(facts, node))
      if (variableOf(facts, assignment.target) == count.variable && literalValue(context.tree, assignment.value))
        found =
            cover(context.tree.expressions[assignment.target].span, context.tree.expressions[assignment.value].span);
  return found;
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (!isMainProgram(facts) || isTooLarge(facts))
    return;
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next()) {
    const auto count = facts.isReached(node) ? countAt(facts, context, node) : std::nullopt;
    const AbstractValue *value = count ? facts.valueOf(count->read) : nullptr;
    if (!value || !value->isNumber() || !value->number().constantValue() || !isLastUse(facts, *count, node) ||
        isSeenElsewhere(facts, count->variable))
      continue;
    const auto start = startOf(facts, context, *count, node);
    if (!start)
      continue;
    reporter.report({.message = fmt::format("{} counts to the same number in each run", context.quoted(count->span)),
                     .span = count->span,
                     .labels = {{*start, "each run starts from here"}},
                     .notes = {"nothing reads it behind the count, and the next run sets it back",
                               "set it once from the MDI, or only where it is vacant: "
                               "`IF[#500EQ#0]THEN#500=0`"}});
  }
}

} // namespace

extern const Rule counterSetAtStart;
const Rule counterSetAtStart{.info = {"counter-set-at-start", Category::Flow, Severity::Warning,
                                      "Reports a counter of runs that the program sets to a number at its start."},
                             .hooks = {.flow = check}};

} // namespace feedhold::rules::counter_set_at_start
