// early-output: `#1101=1`, a dwell, `#1101=0`: macro statements do not wait for the dwell.
#include "rules/flow/flow_view.h"
#include "rules/motion/motion_view.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::early_output {
namespace {

constexpr std::size_t kMostBlocksBack = 8;

bool isOutput(const FileContext &context, std::uint32_t variable) {
  const VariableRange *range = variable >= kFirstNamedVariable ? nullptr : findVariable(context.dialect, variable);
  return range && range->kind == VariableKind::System && range->role == VariableRole::Stored &&
         range->meaning.find("output") != std::string_view::npos;
}

std::optional<std::uint32_t> outputSetAt(const FlowFacts &facts, const FileContext &context, NodeId node) {
  for (const Assignment &assignment : assignmentsOf(facts, node))
    if (const auto variable = variableNumber(context.tree, unwrapped(context.tree, assignment.target));
        variable && isOutput(context, *variable))
      return variable;
  return std::nullopt;
}

/// An M code, a skip, a code that limits the look-ahead, or another that is not followed: the control may wait.
bool mayWait(const MotionView &view, NodeId node) {
  const auto words = view.wordsOf(node);
  return std::ranges::any_of(words, [&](const Word *word) {
    if (word->address() != 'G')
      return word->address() == 'M' || word->address() == 'T';
    const Code *code = codeOf(*word, view.context().dialect);
    return !code || isSkip(code->role) || code->role == CodeRole::MachinePosition ||
           code->role == CodeRole::ReferenceReturn ||
           (code->role == CodeRole::Plain && code->group == 0 && changesNothing(code->action));
  });
}

/// The dwell between two settings of one output, straight back from the second.
std::optional<NodeId> dwellBetween(const MotionView &view, const FlowFacts &facts, NodeId second,
                                   std::uint32_t output) {
  std::optional<NodeId> dwell;
  NodeId node = second;
  for (std::size_t steps = 0; steps < kMostBlocksBack && node != facts.entry(); ++steps) {
    const NodeId before(node.index() - 1);
    const bool isCall = std::holds_alternative<CallProgram>(facts.node(before).instruction);
    if (!facts.isReached(before) || facts.node(before).next != node || isCall || mayWait(view, before))
      return std::nullopt;
    if (outputSetAt(facts, view.context(), before) == output)
      return dwell;
    if (view.findAction(before, {CodeAction::Dwell}))
      dwell = before;
    node = before;
  }
  return std::nullopt;
}

/// Somewhere in the program the look-ahead is switched off or limited.
bool limitsLookAhead(const MotionView &view, const FlowFacts &facts, NodeId until) {
  for (NodeId node = facts.entry(); node < until; node = node.next())
    for (const Word *word : view.wordsOf(node)) {
      const Code *code = word->address() == 'G' ? codeOf(*word, view.context().dialect) : nullptr;
      if (code && code->role == CodeRole::Plain && code->group == 0 && changesNothing(code->action))
        return true;
    }
  return false;
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  const MotionView view(facts.program, context);
  for (const VariableUse &use : context.model.variablesOf(facts.program)) {
    if (!use.write || !use.number || !isOutput(context, *use.number))
      continue;
    const auto node = nodeOf(facts, use.block, use.expression);
    const auto dwell = node ? dwellBetween(view, facts, *node, *use.number) : std::nullopt;
    if (!dwell || limitsLookAhead(view, facts, *node))
      continue;
    const Span place = context.tree.expressions[use.expression].span;
    reporter.report(
        {.message = fmt::format("{} is written again before the dwell is over", context.quoted(place)),
         .span = place,
         .labels = {{view.blockSpan(*dwell), "macro statements do not wait for this dwell"}},
         .notes = {"the control reads ahead and executes both statements before the dwell is over: the pulse is lost",
                   "limit the look-ahead, or put an M code that stops it after the dwell"}});
  }
}

} // namespace

extern const Rule earlyOutput;
const Rule earlyOutput{
    .info = {"early-output", Category::Motion, Severity::Warning,
             "Reports an output that is written twice with only a dwell between the two statements."},
    .hooks = {.flow = check}};

} // namespace feedhold::rules::early_output
