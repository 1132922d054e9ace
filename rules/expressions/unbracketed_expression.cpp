// unbracketed-expression: `X#1+2` where `X[#1+2]` is wanted.
#include "findings/rule/other_control.h"

#include "base/support/text.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::unbracketed_expression {
namespace {

/// `F#9+#1.`: what the number with a point was meant to be is not known, so that brackets alone do not mend the block.
bool hasVariableWithPoint(std::string_view text) {
  for (std::size_t hash = text.find('#'); hash != std::string_view::npos; hash = text.find('#', hash + 1)) {
    const std::size_t end = text.find_first_not_of("0123456789 ", hash + 1);
    if (end != std::string_view::npos && text[end] == '.')
      return true;
  }
  return false;
}

/// What is meant is no expression: a sender adds such numbers to the blocks, and the controls that know them take them
/// off.
void reportChecksum(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  reporter.report({.message = fmt::format("{} behind the block looks like a checksum", context.quoted(issue.span)),
                   .span = issue.span,
                   .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::WordFormat)),
                             "delete it, unless the control takes it off"}});
}

void check(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.grammar.wordMayBeUnbracketed)
    return;
  const std::string_view word = context.text(issue.other);
  if (habitAt(issue, context) == ForeignHabit::Checksum)
    return reportChecksum(issue, context, reporter);
  const std::size_t equals = word.find('=');
  const auto letter = std::find_if(word.begin(), word.end(), isLetter);
  const auto before = equals != std::string_view::npos ? equals : static_cast<std::size_t>(letter - word.begin());
  const std::size_t value = std::min(word.find_first_not_of(" \t", before + 1), word.size());
  const auto open = issue.other.begin + static_cast<std::uint32_t>(value);
  Diagnostic diagnostic{.message = fmt::format("{} needs brackets around the expression", context.quoted(issue.other)),
                        .span = issue.other,
                        .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::WordFormat))}};
  // Nobody writes a product of two numbers: `Y20 *45` ends with a checksum.
  const bool isComputed = word.find('#') != std::string_view::npos;
  if (context.dialect.grammar.anyIndex || !hasVariableWithPoint(word))
    diagnostic.fixes = {{isComputed ? FixSafety::Safe : FixSafety::NeedsReview,
                         "put the expression in brackets",
                         {{{open, open}, "["}, {{issue.span.end, issue.span.end}, "]"}}}};
  reporter.report(std::move(diagnostic));
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::UnbracketedExpression};

} // namespace

extern const Rule unbracketedExpression;
const Rule unbracketedExpression{.info = {"unbracketed-expression", Category::Expression, Severity::Error,
                                          "Reports an expression after an address without the brackets that it needs."},
                                 .hooks = {.issue = check, .issueKinds = kIssues}};

} // namespace feedhold::rules::unbracketed_expression
