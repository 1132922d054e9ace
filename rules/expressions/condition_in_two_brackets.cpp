// condition-in-two-brackets: `IF[#1GT0]AND[#2GT0]GOTO10`.
#include "rules/expressions/expression_view.h"

#include <fmt/format.h>

namespace feedhold::rules::condition_in_two_brackets {
namespace {

void check(const Statement &statement, BlockId, const FileContext &context, const Reporter &reporter) {
  const auto condition = conditionOf(statement);
  const auto *joint = condition ? as<BinaryOperation>(context.tree, *condition) : nullptr;
  if (context.dialect.grammar.oWords || !joint || !isBitwise(joint->op) || !as<Bracketed>(context.tree, joint->left) ||
      !as<Bracketed>(context.tree, joint->right))
    return;
  const Span span = context.tree.expressions[*condition].span;
  reporter.report({.message = fmt::format("this condition ends before `{}`: the brackets around both parts are missing",
                                          spellingOf(joint->op)),
                   .span = span,
                   .notes = {"the condition is what stands in the first pair of brackets; the control stops at the "
                             "rest, or does not read it",
                             fmt::format("write `[{}]`", context.text(span))},
                   .fixes = {{.title = "put brackets around the condition",
                              .edits = {{{span.begin, span.begin}, "["}, {{span.end, span.end}, "]"}}}}});
}

} // namespace

extern const Rule conditionInTwoBrackets;
const Rule conditionInTwoBrackets{.info = {"condition-in-two-brackets", Category::Expression, Severity::Warning,
                                           "Reports a condition of two parts without brackets around both."},
                                  .hooks = {.statement = check}};

} // namespace feedhold::rules::condition_in_two_brackets
