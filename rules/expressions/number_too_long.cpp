// number-too-long: `0.000000001` on a control of eight digits; `X1234567.`.
#include "findings/rule/rule.h"

#include "rules/expressions/expression_view.h"

#include "base/support/text.h"
#include "rules/words/block_words.h"
#include "rules/words/word_values.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace feedhold::rules::number_too_long {
namespace {

void tooLong(Span span, std::string seen, const FileContext &context, const Reporter &reporter) {
  reporter.report({.message = std::move(seen),
                   .span = span,
                   .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::TooManyDigits))}});
}

void checkNode(ExpressionId id, BlockId, const FileContext &context, const Reporter &reporter) {
  const std::size_t limit = context.dialect.limits.literalDigits;
  const Span span = context.tree.expressions[id].span;
  if (span.size() <= limit || !as<NumberLiteral>(context.tree, id))
    return;
  const std::string_view text = context.text(span);
  const auto digits = static_cast<std::size_t>(std::count_if(text.begin(), text.end(), isDigit));
  if (digits > limit)
    tooLong(span, fmt::format("{} has {} digits; this control reads at most {}", context.quoted(span), digits, limit),
            context, reporter);
}

void checkIssue(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  tooLong(issue.span, fmt::format("{} has more digits than any control reads", context.quoted(issue.span)), context,
          reporter);
}

constexpr std::string_view kWords = "ABCDFHIJKLMNPQRSTUVWXYZ";
constexpr double kLastWhole = 99'999'999;    // eight digits
constexpr double kLastLength = 999'999.9999; // mm, inch, degrees: six digits before the point, on the largest controls
constexpr double kLastIncrements = 999'999'999; // without a point, in the least increment

/// No control of the dialect reads more.
std::optional<double> lastOf(const Word &word, const FileContext &context, BlockId block) {
  const AddressKind kind = formatOf(context.dialect, word.address()).kind;
  if (context.dialect.grammar.oWords || kind == AddressKind::None || word.has(Word::kArgument) ||
      context.tree.blocks[block].has(Block::kData) || meansOwnWords(context, block))
    return std::nullopt;
  if (kind == AddressKind::Integer)
    return kLastWhole;
  if (kind == AddressKind::Flexible)
    return kLastIncrements;
  return word.isNumber() && !word.has(Word::kPoint) ? kLastIncrements : kLastLength;
}

void checkWord(const Word &word, BlockId block, const FileContext &context, const Reporter &reporter) {
  const double number = word.isNumber() ? std::abs(word.number().toDouble()) : 0;
  if (number <= std::min(kLastLength, kLastWhole) || hasTooManyWords(context, block))
    return;
  const auto last = lastOf(word, context, block);
  if (last && number > *last)
    tooLong(word.span(), fmt::format("{} has more digits than the control reads", context.quoted(word.span())), context,
            reporter);
}

void checkComputed(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  for (const ComputedWord &computed : computedWordsOf(facts)) {
    const Word &word = *computed.word;
    const auto last =
        kWords.find(word.address()) != std::string_view::npos ? lastOf(word, context, computed.block) : std::nullopt;
    if (!last)
      continue;
    const AllowedNumbers allowed{-*last - 1, *last + 1};
    const Outside outside = outsideOf(*computed.value, allowed);
    if (outside == Outside::Never)
      continue;
    Diagnostic diagnostic{
        .message = fmt::format("{} {}: more digits than the control reads", context.quoted(word.span()),
                               describeNumber(*computed.value, allowed, outside)),
        .span = word.span(),
        .flow = pathOf(facts, computed, outside),
        .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::TooManyDigits))}};
    reporter.report(std::move(diagnostic), outside == Outside::Always ? Severity::Error : Severity::Warning);
  }
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::NumberTooLong};

} // namespace

extern const Rule numberTooLong;
const Rule numberTooLong{.info = {"number-too-long", Category::Expression, Severity::Error,
                                  "Reports a number with more digits than the control reads: in a macro statement or "
                                  "expression, zeros included, or in a word, before its point."},
                         .hooks = {.issue = checkIssue,
                                   .issueKinds = kIssues,
                                   .word = checkWord,
                                   .wordAddresses = kWords,
                                   .expression = checkNode,
                                   .expressionNodes = nodeSet<NumberLiteral>(),
                                   .flow = checkComputed}};

} // namespace feedhold::rules::number_too_long
