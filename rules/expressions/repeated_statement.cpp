// repeated-statement: the statement before, once more.
#include "findings/rule/rule.h"

#include "rules/expressions/expression_view.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::repeated_statement {
namespace {

/// The only statement of a block that holds nothing else (comments and the action of an IF do not count).
const Statement *onlyStatement(const SyntaxTree &tree, BlockId block) {
  const auto statements = tree.statementsOf(block);
  const auto outer =
      std::count_if(statements.begin(), statements.end(), [](const Statement &each) { return !each.nested; });
  return outer == 1 && tree.wordsOf(block).empty() ? firstStatement(tree, block) : nullptr;
}

/// The statement of the block before, whatever its sequence number.
const Statement *statementBefore(const SyntaxTree &tree, BlockId block) {
  return block.index() == 0 ? nullptr : firstStatement(tree, BlockId(block.index() - 1));
}

bool mentions(const FileContext &context, ExpressionId root, ExpressionId variable) {
  const auto parts = subexpressions(context.tree, root);
  const Span wanted = context.tree.expressions[variable].span;
  return std::any_of(parts.begin(), parts.end(),
                     [&](ExpressionId part) { return sameText(context, context.tree.expressions[part].span, wanted); });
}

/// Doing it a second time has no effect: no variable is both read and set, none can change by itself.
bool isIdempotent(const FileContext &context, const Assignment &assignment) {
  return !readsLiveValue(context, assignment.target) && !readsLiveValue(context, assignment.value) &&
         !mentions(context, assignment.value, assignment.target);
}

bool isIdempotent(const FileContext &context, const If &branch) {
  if (!branch.condition || !branch.statement || readsLiveValue(context, *branch.condition))
    return false;
  if (branch.action == IfAction::Jump)
    return true;
  const auto *assignment = std::get_if<Assignment>(&context.tree.statements[*branch.statement].node);
  return assignment && isIdempotent(context, *assignment) && !mentions(context, *branch.condition, assignment->target);
}

bool isIdempotent(const FileContext &context, const Statement &statement) {
  if (const auto *assignment = std::get_if<Assignment>(&statement.node))
    return isIdempotent(context, *assignment);
  const auto *branch = std::get_if<If>(&statement.node);
  return branch && isIdempotent(context, *branch);
}

void check(BlockId block, const FileContext &context, const Reporter &reporter) {
  const Statement *statement = onlyStatement(context.tree, block);
  const Statement *before = statement ? statementBefore(context.tree, block) : nullptr;
  if (!before || !sameText(context, before->span, statement->span) || !isIdempotent(context, *statement))
    return;
  reporter.report(
      {.message = fmt::format("{} repeats the statement before it without effect", context.quoted(statement->span)),
       .span = statement->span,
       .labels = {{before->span, "the first one"}},
       .notes = {"the second one changes nothing; probably another variable or value was meant"}});
}

} // namespace

extern const Rule repeatedStatement;
const Rule repeatedStatement{
    .info = {"repeated-statement", Category::Expression, Severity::Warning,
             "Reports a macro statement that repeats the one directly before it without any effect."},
    .hooks = {.block = check}};

} // namespace feedhold::rules::repeated_statement
