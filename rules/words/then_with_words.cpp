// then-with-words: `IF[#1EQ0]THEN F500`.
#include "findings/rule/rule.h"

#include <fmt/format.h>

namespace feedhold::rules {
namespace {

void check(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  reporter.report(
      {.message = fmt::format("{} is no macro statement", context.quoted(issue.span)),
       .span = issue.span,
       .labels = {{issue.other, "the THEN"}},
       .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::IfFormat)),
                 "jump over a block that holds the words, or set a variable here and write the word with it"}});
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::ThenWithWords};

} // namespace

extern const Rule thenWithWords;
const Rule thenWithWords{.info = {"then-with-words", Category::Syntax, Severity::Error,
                                  "Reports NC words behind `THEN`, where the control takes one macro statement only."},
                         .hooks = {.issue = check, .issueKinds = kIssues}};

} // namespace feedhold::rules
