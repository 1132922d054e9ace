// missing-equals: a statement without `=`.
#include "findings/rule/rule.h"

#include "base/support/text.h"
#include "rules/comments/remarks_of_block.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::missing_equals {
namespace {

constexpr std::size_t kLongestExample = 12;

/// `G90 G01 #33`: a value whose address letter is missing, and no statement that lacks its `=`.
bool stopsBehindWords(const SyntaxIssue &issue, const FileContext &context) {
  const auto words = context.tree.wordsOf(context.tree.blockAt(issue.other.begin));
  return issue.span.empty() && std::ranges::any_of(words, [&](const Word &word) {
           return word.address() != 'N' && word.address() != 'O' && word.span().end <= issue.other.begin;
         });
}

void reportLoneVariable(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  const std::string_view text = trimmed(context.text(issue.other));
  reporter.report(
      {.message = fmt::format("{} has no address letter", context.quoted(issue.other)),
       .span = issue.other,
       .notes = {fmt::format("a variable alone moves nothing: the control {}",
                             stopsWith(context.dialect, AlarmKind::MissingEquals)),
                 text.size() <= kLongestExample
                     ? fmt::format("write the letter of the axis or function: `X{}`, `Z{}`, `F{}`", text, text, text)
                     : "write the letter of the axis or function before it"}});
}

/// `M00 (MEASURED: ) #150`, `#3006=1 (SIZE: ) #120 (MM)`: the value was to be shown.
void reportValueOfMessage(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  Span value = issue.other;
  for (const Comment &comment : context.tree.commentsOf(context.tree.blockAt(value.begin)))
    if (value.begin < comment.span.begin && comment.span.begin < value.end)
      value.end = comment.span.begin;
  reporter.report({.message = fmt::format("{} stands behind a message, which cannot show it", context.quoted(value)),
                   .span = value,
                   .notes = {fmt::format("a message is text alone; at the variable behind it the control {}",
                                         stopsWith(context.dialect, AlarmKind::MissingEquals)),
                             "name the variable in the text, for the operator to look it up, or print it with DPRNT"}});
}

void check(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  if (issue.span.empty() && standsBehindRemark(context, issue.other)) {
    reportValueOfMessage(issue, context, reporter);
    return;
  }
  if (stopsBehindWords(issue, context)) {
    reportLoneVariable(issue, context, reporter);
    return;
  }
  if (context.text(issue.other).starts_with("[") && context.text(issue.other).find('=') != std::string_view::npos)
    return; // `THEN[#33=1]`: symbolic-comparison reports the brackets
  const bool replaces = !issue.span.empty();
  const std::string seen = replaces ? fmt::format("write `=` instead of {}", context.quoted(issue.span)) : "insert `=`";
  reporter.report({.message = fmt::format("{} is a statement without `=`", context.quoted(issue.other)),
                   .span = issue.other,
                   .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::MissingEquals))},
                   .fixes = {{.title = seen, .edits = {{issue.span, "="}}}}});
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::MissingEquals};

} // namespace

extern const Rule missingEquals;
const Rule missingEquals{
    .info =
        {"missing-equals", Category::Expression, Severity::Error,
         "Reports an expression where a macro statement is expected: its `=` is missing or was typed as another sign."},
    .hooks = {.issue = check, .issueKinds = kIssues}};

} // namespace feedhold::rules::missing_equals
