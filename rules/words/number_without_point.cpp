// number-without-point: `Z-2` among `Z2.` and `Z-28.`
#include "findings/rule/rule.h"

#include "rules/words/block_words.h"

#include <fmt/format.h>

namespace feedhold::rules::number_without_point {
namespace {

// So many whole lengths with a point must stand in the file for each one without before the latter is a slip.  In the
// programs looked at the writers either had more than twenty for one, or about as many of both kinds.
constexpr std::size_t kHabit = 10;

struct Lengths {
  std::vector<WordId> withoutPoint;
  std::size_t wholeWithPoint = 0;
};

/// The words of the block are coordinates, not arguments, data, seconds or settings of a cycle.
bool holdsCoordinates(const FileContext &context, BlockId block) {
  return !context.tree.blocks[block].has(Block::kData) && !meansOwnWords(context, block) &&
         !findCode(context.tree, block, context.dialect, CodeRole::Dwell) &&
         !findCode(context.tree, block, context.dialect, CodeRole::Contour);
}

bool isLength(const Word &word, const FileContext &context) {
  return word.isNumber() && !word.has(Word::kComma) && !word.number().isZero() &&
         formatOf(context.dialect, word.address()).kind == AddressKind::Length;
}

Lengths lengthsOf(const FileContext &context) {
  Lengths lengths;
  for (std::size_t i = 0; i < context.tree.blockCount(); ++i)
    for (const Word &word : context.tree.wordsOf(BlockId(i))) {
      if (!isLength(word, context))
        continue;
      if (word.has(Word::kPoint))
        lengths.wholeWithPoint += word.number().isInteger() ? 1 : 0;
      else if (holdsCoordinates(context, BlockId(i)))
        lengths.withoutPoint.push_back(context.tree.idOf(word));
    }
  return lengths;
}

void reportWord(const Word &word, const FileContext &context, const Reporter &reporter) {
  const bool sure = context.dialect.switches.dpi == Switch::Off;
  const std::string_view unless = context.dialect.hasFanucParameters
                                      ? "with parameter 3401#0 (DPI) off "
                                      : "unless a setting of the machine makes it whole units, ";
  const auto two = [](const Decimal &increment) { return Decimal(2, increment.scale()).toString(); };
  const LeastIncrements increments = leastIncrementsOf(context.dialect);
  reporter.report(
      {.message = fmt::format("{} has no decimal point, but the lengths around it do", context.quoted(word.span())),
       .span = word.span(),
       .notes = {fmt::format("{}the control reads it in least increments: `2` is {} mm or {} inch", sure ? "" : unless,
                             two(increments.metric), two(increments.inch))},
       .fixes = {{.title = "add the decimal point", .edits = {{{word.span().end, word.span().end}, "."}}}}});
}

void check(const FileContext &context, const Reporter &reporter) {
  if (context.dialect.switches.dpi == Switch::On)
    return;
  const Lengths lengths = lengthsOf(context);
  if (lengths.wholeWithPoint < kHabit * lengths.withoutPoint.size())
    return;
  for (const WordId word : lengths.withoutPoint)
    reportWord(context.tree.words[word], context, reporter);
}

} // namespace

extern const Rule numberWithoutPoint;
const Rule numberWithoutPoint{
    .info = {"number-without-point", Category::Word, Severity::Warning,
             "Reports a length without a decimal point in a program that writes decimal points everywhere else."},
    .hooks = {.file = check}};

} // namespace feedhold::rules::number_without_point
