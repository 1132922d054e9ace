// computed-program-or-sequence-number: `O#1`, `N#1`.
#include "findings/rule/rule.h"

#include <fmt/format.h>

namespace feedhold::rules {
namespace {

void check(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  reporter.report(
      {.message = fmt::format("the number in {} is computed", context.quoted(issue.other)),
       .span = issue.span,
       .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::NumberMissingAfterOOrN)),
                 "O and N take a number only; a jump may be computed: `GOTO#1`"}});
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::ComputedNumberForbidden};

} // namespace

extern const Rule computedProgramOrSequenceNumber;
const Rule computedProgramOrSequenceNumber{
    .info = {"computed-program-or-sequence-number", Category::Structure, Severity::Error,
             "Reports a program number or a sequence number that is a variable or an expression."},
    .hooks = {.issue = check, .issueKinds = kIssues}};

} // namespace feedhold::rules
