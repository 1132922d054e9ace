// self-assignment: `#1=#1`.
#include "findings/rule/rule.h"

#include "rules/expressions/expression_view.h"

#include <fmt/format.h>

namespace feedhold::rules::self_assignment {
namespace {

void check(const Statement &statement, BlockId block, const FileContext &context, const Reporter &reporter) {
  const auto *assignment = std::get_if<Assignment>(&statement.node);
  if (!assignment)
    return;
  const Span target = context.tree.expressions[assignment->target].span;
  const Span value = context.tree.expressions[unwrapped(context.tree, assignment->value)].span;
  if (!sameText(context, target, value))
    return;
  // `#1=#1 (START Y)` is how some writers note what an argument is.
  const bool saysWhy = !context.tree.commentsOf(block).empty();
  reporter.report({.message = fmt::format("{} is assigned to itself", context.quoted(target)),
                   .span = statement.span,
                   .notes = {"nothing changes; probably another variable was meant"}},
                  saysWhy ? Severity::Info : Severity::Warning);
}

} // namespace

extern const Rule selfAssignment;
const Rule selfAssignment{.info = {"self-assignment", Category::Expression, Severity::Warning,
                                   "Reports a variable that is assigned to itself."},
                          .hooks = {.statement = check}};

} // namespace feedhold::rules::self_assignment
