// copied-index: `#101=#5041`, `#102=#5041`, `#103=#5041`.
#include "findings/rule/rule.h"

#include "rules/expressions/expression_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace feedhold::rules::copied_index {
namespace {

/// The system variable has neighbours for the other axes.
bool isByAxis(const Dialect &dialect, std::uint32_t number) {
  const VariableRange *range = findVariable(dialect, number);
  if (!range)
    return false;
  constexpr std::array kByAxis = {VariableRole::BlockEndPosition, VariableRole::MachinePosition,
                                  VariableRole::WorkPosition,     VariableRole::SkipPosition,
                                  VariableRole::WorkOffset,       VariableRole::AdditionalWorkOffset,
                                  VariableRole::SetOffset};
  return std::ranges::find(kByAxis, range->role) != kByAxis.end();
}

/// `#5041`, or `#[5221+[#23-54]*20]`: some number in the index begins such a table.
bool readsByAxis(const FileContext &context, ExpressionId value) {
  const ExpressionId inner = unwrapped(context.tree, value);
  if (const auto number = variableNumber(context.tree, inner))
    return isByAxis(context.dialect, *number);
  const auto *indirect = as<IndirectVariable>(context.tree, inner);
  if (!indirect)
    return false;
  return std::ranges::any_of(subexpressions(context.tree, indirect->index), [&](ExpressionId part) {
    const auto literal = as<NumberLiteral>(context.tree, part);
    const auto number = literal ? literal->value.asInteger() : std::nullopt;
    return number && *number > 0 && *number < 1'000'000 &&
           isByAxis(context.dialect, static_cast<std::uint32_t>(*number));
  });
}

/// The assignment to a variable with a number that is all that the block does.
const Assignment *onlyAssignment(const FileContext &context, BlockId block) {
  const auto statements = context.tree.statementsOf(block);
  const bool isAlone = statements.size() == 1 && std::ranges::all_of(context.tree.wordsOf(block), [](const Word &word) {
                         return word.address() == 'N';
                       });
  const auto *assignment = isAlone ? std::get_if<Assignment>(&statements.front().node) : nullptr;
  return assignment && variableNumber(context.tree, assignment->target) ? assignment : nullptr;
}

/// The block gives the next variable the same value as the block before it.
bool repeats(const FileContext &context, BlockId block) {
  if (block.index() == 0 || block.index() >= context.tree.blockCount())
    return false;
  const Assignment *before = onlyAssignment(context, BlockId(block.index() - 1));
  const Assignment *now = onlyAssignment(context, block);
  return before && now &&
         *variableNumber(context.tree, before->target) + 1 == *variableNumber(context.tree, now->target) &&
         sameText(context, context.tree.expressions[before->value].span, context.tree.expressions[now->value].span);
}

void check(BlockId block, const FileContext &context, const Reporter &reporter) {
  // Two alike may be the first values of a smallest and a largest one.
  if (!repeats(context, block) || !repeats(context, block.next()) || repeats(context, BlockId(block.index() - 1)))
    return;
  const Assignment &assignment = *onlyAssignment(context, block);
  if (!readsByAxis(context, assignment.value))
    return;
  const Span span = context.tree.expressions[assignment.value].span;
  const Assignment &first = *onlyAssignment(context, BlockId(block.index() - 1));
  reporter.report(
      {.message = fmt::format("{} is read again for the next variable", context.quoted(span)),
       .span = span,
       .labels = {{context.tree.expressions[first.value].span, "read here"},
                  {context.tree.expressions[onlyAssignment(context, block.next())->value].span, "and again"}},
       .notes = {"all these variables get the value of one axis", "add 1 to the number for each further axis"}});
}

} // namespace

extern const Rule copiedIndex;
const Rule copiedIndex{.info = {"copied-index", Category::Expression, Severity::Warning,
                                "Reports consecutive variables that all read the same position or offset of one axis."},
                       .hooks = {.block = check}};

} // namespace feedhold::rules::copied_index
