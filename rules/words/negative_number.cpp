// negative-number: `F-100.`, `M98 P1100 L-2`; `T#1` where #1 is -3.
#include "rules/words/word_values.h"

#include "rules/expressions/expression_view.h"
#include "rules/words/block_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace feedhold::rules::negative_number {
namespace {

constexpr std::string_view kNeverNegative = "DFGHLMNPST";
constexpr double kRoundsToZero = -0.5; // a value above is rounded to 0
constexpr AllowedNumbers kNotNegative{.least = kRoundsToZero};

bool has(const FileContext &context, BlockId block, std::initializer_list<CodeRole> roles) {
  return std::ranges::any_of(
      roles, [&](CodeRole role) { return findCode(context.tree, block, context.dialect, role) != nullptr; });
}

constexpr std::int64_t kOrientation = 19;
/// M19 S-90. of some machines: the angle of the spindle.
bool turnsSpindle(const FileContext &context, BlockId block) {
  return std::ranges::any_of(context.tree.wordsOf(block), [](const Word &word) {
    return word.address() == 'M' && word.isNumber() && word.number().asInteger() == kOrientation;
  });
}

/// The letter has its usual meaning in the block, which has no sign.
bool hasNoSign(const Word &word, const FileContext &context, BlockId block) {
  if (word.has(Word::kArgument) || word.has(Word::kComma) || word.has(Word::kAfterThen) ||
      context.tree.blocks[block].has(Block::kData))
    return false;
  const bool isOfCall = has(context, block,
                            {CodeRole::SubprogramCall, CodeRole::LocalCall, CodeRole::MacroCall, CodeRole::ModalCall,
                             CodeRole::ModalCallEach});
  const bool isCycle = has(context, block, {CodeRole::CannedCycle, CodeRole::Contour});
  switch (word.address()) {
  case 'P': return isOfCall || has(context, block, {CodeRole::Dwell});
  case 'L': return isOfCall;
  case 'D': // a depth in cycles of lathes
  case 'H': // on a lathe a move of C
    return context.dialect.machine == MachineKind::Milling && !isCycle && !meansOwnWords(context, block);
  case 'S': return !turnsSpindle(context, block) && !meansOwnWords(context, block);
  case 'G':
  case 'M': return word.isCode();
  default: return !meansOwnWords(context, block);
  }
}

/// A dwell that is negative may be none at all.
bool maySkip(const Word &word, const FileContext &context, BlockId block) {
  return word.address() == 'P' && has(context, block, {CodeRole::Dwell});
}

/// No manual of the other controls says that a speed has no sign.
bool isSureToStop(const Word &word, const FileContext &context, BlockId block) {
  return !maySkip(word, context, block) && (word.address() != 'S' || context.dialect.hasFanucParameters);
}

std::string whatHappens(const Word &word, const FileContext &context, BlockId block) {
  const std::string stops = fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::MisplacedMinus));
  if (maySkip(word, context, block))
    return stops + ", or does not wait";
  return isSureToStop(word, context, block) ? stops : stops + ", or turns the spindle the other way";
}

/// `Z--1.`: two signs and a number.
bool hasTwoSigns(const Word &word, const FileContext &context) {
  if (word.form() != WordForm::Expression)
    return false;
  const auto *sign = as<Negation>(context.tree, word.expression());
  const auto *second = sign ? as<Negation>(context.tree, sign->operand) : nullptr;
  return second && as<NumberLiteral>(context.tree, second->operand);
}

void checkLiteral(const Word &word, BlockId block, const FileContext &context, const Reporter &reporter) {
  if (hasTwoSigns(word, context) && context.dialect.hasFanucParameters && !word.has(Word::kArgument)) {
    reporter.report({.message = fmt::format("{} has two signs", context.quoted(word.span())),
                     .span = word.span(),
                     .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::MisplacedMinus))}});
    return;
  }
  if (kNeverNegative.find(word.address()) == std::string_view::npos)
    return;
  if (context.dialect.grammar.oWords || !word.isNumber() || !word.number().isNegative() || word.number().isZero() ||
      hasTooManyWords(context, block) || !hasNoSign(word, context, block))
    return;
  reporter.report({.message = fmt::format("{} takes no minus sign", context.quoted(word.span())),
                   .span = word.span(),
                   .notes = {whatHappens(word, context, block)}},
                  isSureToStop(word, context, block) ? Severity::Error : Severity::Warning);
}

void checkComputed(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.grammar.oWords)
    return;
  for (const ComputedWord &computed : computedWordsOf(facts)) {
    const Word &word = *computed.word;
    if (kNeverNegative.find(word.address()) == std::string_view::npos || !hasNoSign(word, context, computed.block))
      continue;
    const AllowedNumbers allowed = word.address() == 'F' ? AllowedNumbers{.least = 0} : kNotNegative;
    const Outside outside = outsideOf(*computed.value, allowed);
    if (outside == Outside::Never)
      continue;
    Diagnostic diagnostic{
        .message = fmt::format("{} {}", context.quoted(word.span()), describeNumber(*computed.value, allowed, outside)),
        .span = word.span(),
        .flow = pathOf(facts, computed, outside),
        .notes = {
            fmt::format("`{}` takes no minus sign: {}", word.address(), whatHappens(word, context, computed.block)),
            "correct the value, or check it before this block"}};
    const bool isSure = outside == Outside::Always && isSureToStop(word, context, computed.block);
    reporter.report(std::move(diagnostic), isSure ? Severity::Error : Severity::Warning);
  }
}

} // namespace

extern const Rule negativeNumber;
const Rule negativeNumber{
    .info = {"negative-number", Category::Word, Severity::Error,
             "Reports a minus sign in a word that takes none, such as `F-100.` or `L-2`, also by way of a variable."},
    .hooks = {.word = checkLiteral, .wordAddresses = "ABCDFGHIJKLMNPQRSTUVWXYZ", .flow = checkComputed}};

} // namespace feedhold::rules::negative_number
