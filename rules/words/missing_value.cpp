// missing-value: `X` alone.
#include "findings/rule/rule.h"

#include "base/support/text.h"
#include "rules/words/letter_for_digit.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace feedhold::rules::missing_value {
namespace {

/// `X?` is how templates mark a number to be filled in.
bool isPlaceholder(const SyntaxIssue &issue, const FileContext &context) {
  const BlockId block = context.tree.blockAt(issue.span.begin);
  return issue.kind == SyntaxIssueKind::MissingValue &&
         trimmed(context.text({issue.span.end, context.tree.blocks[block].end})).starts_with('?');
}

/// `:(ROUGHING)`: the colon marks a remark, and is read as the letter O.
bool isColonOfRemark(const SyntaxIssue &issue, const FileContext &context) {
  return issue.kind == SyntaxIssueKind::MissingValue && context.text(issue.span) == ":" &&
         context.text({issue.span.end, context.tree.blocks[context.tree.blockAt(issue.span.begin)].end})
             .starts_with('(');
}

/// `#1=#1-#11:`, which was to be the end of the block.
bool isColonForEnd(const SyntaxIssue &issue, const FileContext &context) {
  const Block &block = context.tree.blocks[context.tree.blockAt(issue.span.begin)];
  return context.text(issue.span) == ":" && issue.span.begin > block.begin &&
         trimmed(context.text({issue.span.end, block.end})).empty();
}

using Kind = bool (*)(const SyntaxIssue &, const FileContext &);

/// How many there are of a kind, at the first of them: they have one cause.
std::optional<std::size_t> countAtFirst(Kind isOfKind, const SyntaxIssue &issue, const FileContext &context) {
  const auto isSame = [&](const SyntaxIssue &other) { return isOfKind(other, context); };
  const auto &issues = context.tree.issues;
  if (std::ranges::find_if(issues, isSame)->span.begin != issue.span.begin)
    return std::nullopt;
  return static_cast<std::size_t>(std::ranges::count_if(issues, isSame));
}

void reportColons(std::size_t count, const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  reporter.report({.message = count == 1 ? "`:` stands in front of a remark"
                                         : fmt::format("`:` stands in front of a remark, in {} blocks", count),
                   .span = issue.span,
                   .notes = {fmt::format("the control reads `:` as the letter O, without a number, and {}",
                                         stopsWith(context.dialect, AlarmKind::NoDataAfterAddress)),
                             "delete the `:`; the parentheses make the remark"}});
}

void reportPlaceholders(std::size_t count, const SyntaxIssue &issue, const FileContext &context,
                        const Reporter &reporter) {
  reporter.report({.message = count == 1
                                  ? fmt::format("`?` stands in place of the number of {}", context.quoted(issue.span))
                                  : fmt::format("`?` stands in place of numbers, in {} words", count),
                   .span = issue.span,
                   .notes = {fmt::format("if the block is executed as it stands, the control {}",
                                         stopsWith(context.dialect, AlarmKind::NoDataAfterAddress)),
                             "write the number before the program goes to the machine"}},
                  Severity::Warning);
}

/// `GO`: both letters lack a number, and one message says why.
bool isFirstIn(Span piece, const SyntaxIssue &issue, const FileContext &context) {
  return std::ranges::none_of(context.tree.issues, [&](const SyntaxIssue &other) {
    return other.kind == issue.kind && piece.contains(other.span) && other.span.begin < issue.span.begin;
  });
}

void check(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  if (isColonOfRemark(issue, context)) {
    if (const auto count = countAtFirst(isColonOfRemark, issue, context))
      reportColons(*count, issue, context, reporter);
    return;
  }
  if (isPlaceholder(issue, context)) {
    if (const auto count = countAtFirst(isPlaceholder, issue, context))
      reportPlaceholders(*count, issue, context, reporter);
    return;
  }
  if (const auto digits = mistypedDigitsAt(issue.span.begin, context)) {
    if (isFirstIn(digits->span, issue, context))
      reporter.report(
          {.message = fmt::format("{} has no number: {}", context.quoted(issue.span), describe(*digits)),
           .span = issue.span,
           .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::NoDataAfterAddress))},
           .fixes = fixesFor(*digits)});
    return;
  }
  reporter.report(
      {.message = isColonForEnd(issue, context) ? "`:` stands at the end of the block in place of `;`"
                                                : fmt::format("{} has no number", context.quoted(issue.span)),
       .span = issue.span,
       .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::NoDataAfterAddress))}});
}

/// `#1=.(SPEED)`: the number was never filled in.
void checkLiteral(ExpressionId id, BlockId, const FileContext &context, const Reporter &reporter) {
  const Span span = context.tree.expressions[id].span;
  if (context.text(span) == ".")
    reporter.report({.message = "`.` is a number without a digit", .span = span, .notes = {"write the number"}},
                    Severity::Warning);
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::MissingValue};

} // namespace

extern const Rule missingValue;
const Rule missingValue{.info = {"missing-value", Category::Word, Severity::Error,
                                 "Reports an address without a number, or a number without a digit."},
                        .hooks = {.issue = check,
                                  .issueKinds = kIssues,
                                  .expression = checkLiteral,
                                  .expressionNodes = nodeSet<NumberLiteral>()}};

} // namespace feedhold::rules::missing_value
