// two-decimal-points: `F0.012.`
#include "findings/rule/rule.h"

#include <fmt/format.h>

namespace feedhold::rules::two_decimal_points {
namespace {

void check(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  reporter.report({.message = fmt::format("{} has two decimal points", context.quoted(issue.span)),
                   .span = issue.span,
                   .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::MisplacedPoint))}});
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::TwoDecimalPoints};

} // namespace

extern const Rule twoDecimalPoints;
const Rule twoDecimalPoints{.info = {"two-decimal-points", Category::Expression, Severity::Error,
                                     "Reports a number with more than one decimal point."},
                            .hooks = {.issue = check, .issueKinds = kIssues}};

} // namespace feedhold::rules::two_decimal_points
