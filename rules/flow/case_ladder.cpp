// Ladders are found by the text: what is between two lines of one is comments.
#include "rules/flow/case_ladder.h"

#include "rules/expressions/expression_view.h"

namespace feedhold::rules {

std::optional<CaseLine> caseAt(const FileContext &context, BlockId block) {
  const Statement *statement = firstStatement(context.tree, block);
  const auto *branch = statement ? std::get_if<If>(&statement->node) : nullptr;
  const auto *relation =
      branch && branch->condition ? asInside<BinaryOperation>(context.tree, *branch->condition) : nullptr;
  if (!relation || relation->op != OperatorKind::Equal)
    return std::nullopt;
  const ExpressionId selector = unwrapped(context.tree, relation->left);
  const auto variable = variableNumber(context.tree, selector);
  const auto value = literalValue(context.tree, relation->right);
  const auto jumps = context.model.jumpsIn(block, block.next());
  if (!variable || !value || jumps.size() > 1)
    return std::nullopt;
  const bool isGoto = branch->action == IfAction::Jump && jumps.size() == 1 && jumps.front().kind == JumpKind::Goto;
  return CaseLine{block, statement, *variable, selector, *value, isGoto ? &jumps.front() : nullptr};
}

BlockId nextContent(const FileContext &context, BlockId block) {
  do
    block = block.next();
  while (block.index() + 1 < context.tree.blocks.size() && isEmpty(context.tree, block));
  return block;
}

std::vector<CaseLadder> caseLaddersOf(const FileContext &context, ProgramId program) {
  std::vector<CaseLadder> ladders;
  const BlockId last = context.model.programs[program].last;
  for (BlockId block = context.model.programs[program].first; block < last; block = block.next()) {
    CaseLadder ladder{{}, block};
    while (ladder.behind < last) {
      const auto line = caseAt(context, ladder.behind);
      if (!line || (!ladder.cases.empty() && line->variable != ladder.cases.front().variable))
        break;
      ladder.cases.push_back(*line);
      ladder.behind = nextContent(context, ladder.behind);
    }
    if (ladder.cases.empty())
      continue;
    block = ladder.cases.back().block;
    if (ladder.cases.size() > 1)
      ladders.push_back(std::move(ladder));
  }
  return ladders;
}

} // namespace feedhold::rules
