// mode-not-restored: `#3=#4003 .. G#3`, and a path to the end that passes over the G#3.
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules::mode_not_restored {
namespace {

/// `#3=#4003` at some place, and `G#3` at another.
struct Saving {
  std::uint8_t group;
  std::uint32_t variable;
  Span place;
};

std::optional<std::uint8_t> groupReadBy(ExpressionId value, const FileContext &context) {
  const auto number = variableNumber(context.tree, unwrapped(context.tree, value));
  const VariableRange *range = number ? findVariable(context.dialect, *number) : nullptr;
  if (!range || range->role != VariableRole::ModalCode)
    return std::nullopt;
  const std::uint32_t group = *number - range->first + 1;
  return group < kModalGroups ? std::optional(static_cast<std::uint8_t>(group)) : std::nullopt;
}

bool isRestored(std::uint32_t variable, const Program &program, const FileContext &context) {
  for (BlockId block = program.first; block < program.last; block = block.next())
    for (const Word &word : context.tree.wordsOf(block))
      if (word.address() == 'G' && word.form() == WordForm::Expression &&
          variableNumber(context.tree, unwrapped(context.tree, word.expression())) == variable)
        return true;
  return false;
}

std::vector<Saving> savingsOf(ProgramId id, const FileContext &context) {
  std::vector<Saving> savings;
  const Program &program = context.model.programs[id];
  for (BlockId block = program.first; block < program.last; block = block.next())
    for (const Statement &statement : context.tree.statementsOf(block)) {
      const auto *assignment = std::get_if<Assignment>(&statement.node);
      const auto group = assignment ? groupReadBy(assignment->value, context) : std::nullopt;
      const auto variable = group ? variableNumber(context.tree, assignment->target) : std::nullopt;
      if (variable && isRestored(*variable, program, context))
        savings.push_back({*group, *variable, statement.span});
    }
  return savings;
}

bool setsGroup(const MotionView &view, NodeId node, std::uint8_t group) {
  return std::ranges::any_of(view.wordsOf(node), [&](const Word *word) {
    const Code *code = word->address() == 'G' ? codeOf(*word, view.context().dialect) : nullptr;
    return code && code->group == group;
  });
}

bool restores(const MotionView &view, NodeId node, std::uint32_t variable) {
  return std::ranges::any_of(view.wordsOf(node), [&](const Word *word) {
    return word->address() == 'G' && word->form() == WordForm::Expression &&
           variableNumber(view.context().tree, unwrapped(view.context().tree, word->expression())) == variable;
  });
}

/// The last code in the text that changes the mode and from which the end is reached without restoring it.
std::optional<std::pair<NodeId, std::vector<NodeId>>> changeBefore(const ExitFact &exit, const Saving &saving,
                                                                   const MotionView &view, const FlowFacts &facts) {
  for (NodeId node = facts.end(); node != facts.entry();) {
    node = NodeId(node.index() - 1);
    if (!facts.isReached(node) || !setsGroup(view, node, saving.group))
      continue;
    if (auto path =
            findPath(facts, node, exit.node, [&](NodeId other) { return restores(view, other, saving.variable); }))
      return std::pair{node, std::move(*path)};
  }
  return std::nullopt;
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  const std::vector<Saving> savings = savingsOf(facts.program, context);
  if (savings.empty())
    return;
  const MotionView view(facts.program, context);
  for (const Saving &saving : savings)
    for (const ExitFact &exit : facts.exits()) {
      if (exit.end != PathEnd::Returns || isHavocked(exit.state) ||
          leq(exit.state.codes[saving.group], facts.entryCodes()[saving.group]))
        continue;
      const auto change = changeBefore(exit, saving, view, facts);
      if (!change)
        continue;
      reporter.report(
          {.message = fmt::format("the mode saved in `#{}` is not restored on a path to this end", saving.variable),
           .span = view.blockSpan(exit.node),
           .labels = {{saving.place, "saved here"}, {view.blockSpan(change->first), "changed here"}},
           .flow = describePath(facts, change->second),
           .notes = {"the caller continues in another mode than before the call",
                     fmt::format("restore it with `G#{}` before this end, too", saving.variable)}});
    }
}

} // namespace

extern const Rule modeNotRestored;
const Rule modeNotRestored{
    .info =
        {"mode-not-restored", Category::Motion, Severity::Warning,
         "Reports a called program that saves a mode of its caller but, on some path, returns without restoring it."},
    .hooks = {.flow = check}};

} // namespace feedhold::rules::mode_not_restored
