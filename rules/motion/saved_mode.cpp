// See the header.
#include "rules/motion/saved_mode.h"

#include <algorithm>

namespace feedhold::rules {
namespace {

bool isRestored(std::uint32_t variable, const Program &program, const FileContext &context) {
  for (BlockId block = program.first; block < program.last; block = block.next())
    for (const Word &word : context.tree.wordsOf(block))
      if (word.address() == 'G' && word.form() == WordForm::Expression &&
          variableNumber(context.tree, unwrapped(context.tree, word.expression())) == variable)
        return true;
  return false;
}

} // namespace

std::optional<std::uint8_t> groupReadBy(ExpressionId value, const FileContext &context) {
  const auto number = variableNumber(context.tree, unwrapped(context.tree, value));
  const VariableRange *range = number ? findVariable(context.dialect, *number) : nullptr;
  if (!range || range->role != VariableRole::ModalCode)
    return std::nullopt;
  const std::uint32_t group = *number - range->first + 1;
  return group < kModalGroups ? std::optional(static_cast<std::uint8_t>(group)) : std::nullopt;
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
        savings.push_back({*group, *variable, block, statement.span});
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

} // namespace feedhold::rules
