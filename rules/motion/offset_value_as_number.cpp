// offset-value-as-number: `G43 H#11001`, the length of tool 1 in the place of its number; `G41 D#501` with `#501=0.01`.
#include "findings/rule/other_control.h"
#include "rules/flow/system_variables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace feedhold::rules::offset_value_as_number {
namespace {

/// `#[6100+#2233]` in the file: what the variable holds is a number of something, whatever the table says.
bool isIndexOfOther(const FileContext &context, std::uint32_t variable) {
  return std::ranges::any_of(context.model.variables, [&](const VariableUse &use) {
    const auto *indirect = as<IndirectVariable>(context.tree, use.expression);
    return indirect && std::ranges::any_of(subexpressions(context.tree, indirect->index), [&](ExpressionId part) {
             return variableNumber(context.tree, part) == variable;
           });
  });
}

void check(const Word &word, BlockId block, const FileContext &context, const Reporter &reporter) {
  if (word.form() != WordForm::Expression || word.has(Word::kArgument) ||
      !context.model.callsIn(block, block.next()).empty())
    return;
  const auto number = tableNumber(context, word.expression());
  if (!number || !isToolOffset(context, *number) || isIndexOfOther(context, *number) ||
      seemsForOtherControl(context)) // there the variable may be another
    return;
  const Span value = context.tree.expressions[word.expression()].span;
  reporter.report(
      {.message = fmt::format("{} takes the value of an offset for the number of one", context.quoted(word.span())),
       .span = word.span(),
       .labels = {{value, "the offset of a tool, in millimetres or inches"}},
       .notes = {fmt::format("`{}` names an offset by its number, which the control rounds to a whole one or "
                             "refuses",
                             word.address()),
                 fmt::format("write the number of the offset, such as `{}1`", word.address())}});
}

/// `D#501`, where `#501` is a part of a millimetre and no number of an offset.
void checkFraction(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  for (NodeId node = facts.entry(); node < facts.end(); node = node.next()) {
    if (!facts.isReached(node) || !std::holds_alternative<ExecuteWords>(facts.node(node).instruction))
      continue;
    const BlockId block = facts.node(node).block;
    const Word *code = findAction(
        context.tree, block, context.dialect,
        {CodeAction::CompensationLeft, CodeAction::CompensationRight, CodeAction::LengthPlus, CodeAction::LengthMinus});
    // G41.1 and G42.1 of LinuxCNC take the diameter itself.
    const bool usesOffset = code && code->tenths() != 411 && code->tenths() != 421;
    for (const Word &word : usesOffset ? context.tree.wordsOf(block) : std::span<const Word>{}) {
      if ((word.address() != 'D' && word.address() != 'H') || word.form() != WordForm::Expression)
        continue;
      const AbstractValue *value = facts.valueOf(word.expression());
      const auto constant = value && value->isNumber() ? value->number().constantValue() : std::nullopt;
      if (!constant || *constant == std::round(*constant))
        continue;
      reporter.report({.message = fmt::format("{} is the number of an offset, and its value is {:.6g}",
                                              context.quoted(word.span()), *constant),
                       .span = word.span(),
                       .flow = pathFromEntry(facts, node),
                       .notes = {"the control rounds it to the number of another offset, or refuses it",
                                 "write the number here, and the value with G10 or by hand into the offset"}});
    }
  }
}

} // namespace

extern const Rule offsetValueAsNumber;
const Rule offsetValueAsNumber{
    .info = {"offset-value-as-number", Category::Motion, Severity::Warning,
             "Reports an H or D that takes the value of a tool offset, or a fraction, for its number."},

    .hooks = {.word = check, .wordAddresses = "HD", .flow = checkFraction}};

} // namespace feedhold::rules::offset_value_as_number
