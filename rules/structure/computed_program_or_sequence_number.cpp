// computed-program-or-sequence-number: `O#1`, `N#1`.
#include "findings/rule/rule.h"

#include <fmt/format.h>

namespace feedhold::rules::computed_program_or_sequence_number {
namespace {

void check(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  reporter.report(
      {.message =
           fmt::format("{} must be a plain number, not a variable or an expression", context.quoted(issue.other)),
       .span = issue.span,
       .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::NumberMissingAfterOOrN)),
                 "`O` and `N` take a plain number only; compute the number in the jump instead: `GOTO#1`"}});
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::ComputedNumberForbidden};

} // namespace

extern const Rule computedProgramOrSequenceNumber;
const Rule computedProgramOrSequenceNumber{
    .info = {"computed-program-or-sequence-number", Category::Structure, Severity::Error,
             "Reports a program number or sequence number that is a variable or an expression."},
    .hooks = {.issue = check, .issueKinds = kIssues}};

} // namespace feedhold::rules::computed_program_or_sequence_number
