// then-without-statement: `IF[#1EQ0]THEN` and the end of the block.
#include "findings/rule/rule.h"

#include <fmt/format.h>

namespace feedhold::rules::then_without_statement {
namespace {

void check(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.grammar.blockIf)
    return;
  reporter.report({.message = "there is no statement after this THEN",
                   .span = issue.span,
                   .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::IfFormat)),
                             "the statement must be in the same block"}});
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::ThenWithoutStatement};

} // namespace

extern const Rule thenWithoutStatement;
const Rule thenWithoutStatement{
    .info = {"then-without-statement", Category::Syntax, Severity::Error, "Reports a `THEN` with nothing after it."},
    .hooks = {.issue = check, .issueKinds = kIssues}};

} // namespace feedhold::rules::then_without_statement
