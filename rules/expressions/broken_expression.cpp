// broken-expression: an operand or operator is missing.
#include "findings/rule/rule.h"

#include "base/support/text.h"

#include <fmt/format.h>

namespace feedhold::rules::broken_expression {
namespace {

std::string whatIsWrong(Span span, const FileContext &context) {
  if (span.empty())
    return "an operand is missing here";
  const std::string_view before = trimmed(context.source.text().substr(0, span.begin));
  if (context.text(span) == "]" && before.ends_with('['))
    return "these brackets are empty";
  return fmt::format("unexpected {} in this expression", context.quoted(span));
}

/// `[<#_value>]` for `[#<_value>]`, `#ABS[#6]` for `ABS[#6]`: what is written, and what is meant.
struct Slip {
  Span span;
  std::string message;
  std::string meant;
};
/// `#1GTO.` for `#1GT0.`, `#1x0.5` for `#1*0.5`
std::optional<Slip> mistypedSignAt(Span place, const FileContext &context) {
  const std::string_view text = context.source.text();
  if (place.begin == 0 || place.begin + 1 >= text.size())
    return std::nullopt;
  const char sign = toUpper(text[place.begin]);
  const char before = text[place.begin - 1];
  const char behind = text[place.begin + 1];
  const Span span{place.begin, place.begin + 1};
  if (sign == 'O' && std::string_view(".]*/+-").find(behind) != std::string_view::npos)
    return Slip{span, "the letter `O` stands in the place of the digit 0", "0"};
  const bool isFactor = isDigit(behind) || behind == '#' || behind == '[';
  if (sign == 'X' && isFactor && (isDigit(before) || before == ']' || before == '.'))
    return Slip{span, fmt::format("{} is no sign of multiplication", context.quoted(span)), "*"};
  return std::nullopt;
}

std::optional<Slip> slipAt(Span place, const FileContext &context) {
  const std::string_view text = context.source.text();
  if (text.substr(place.begin).starts_with("<#")) {
    const std::size_t close = text.find_first_of(">\r\n", place.begin);
    if (close == std::string_view::npos || text[close] != '>')
      return std::nullopt;
    const Span span{place.begin, static_cast<std::uint32_t>(close) + 1};
    const std::string meant = fmt::format("#<{}", context.text({span.begin + 2, span.end}));
    return Slip{span, fmt::format("the `#` of {} stands inside the brackets", context.quoted(span)), meant};
  }
  if (auto slip = mistypedSignAt(place, context))
    return slip;
  const std::size_t open = text.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz", place.begin);
  const bool isName = open != std::string_view::npos && open > place.begin + 1 && text[open] == '[';
  if (place.begin == 0 || text[place.begin - 1] != '#' || !isName)
    return std::nullopt;
  const std::string name(text.substr(place.begin, open - place.begin));
  return Slip{
      {place.begin - 1, static_cast<std::uint32_t>(open)}, fmt::format("`#` in front of the function {}", name), name};
}

void check(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  if (const auto slip = slipAt(issue.span, context)) {
    reporter.report(
        {.message = slip->message,
         .span = slip->span,
         .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::ExpressionFormat))},
         .fixes = {{.title = fmt::format("write `{}`", slip->meant), .edits = {{slip->span, slip->meant}}}}});
    return;
  }
  reporter.report({.message = whatIsWrong(issue.span, context),
                   .span = issue.span,
                   .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::ExpressionFormat))}});
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::BrokenExpression};

} // namespace

extern const Rule brokenExpression;
const Rule brokenExpression{.info = {"broken-expression", Category::Expression, Severity::Error,
                                     "Reports an expression that lacks an operand or an operator."},
                            .hooks = {.issue = check, .issueKinds = kIssues}};

} // namespace feedhold::rules::broken_expression
