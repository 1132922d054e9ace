// number-without-point: `Z-2` among `Z2.` and `Z-28.`
#include "findings/rule/rule.h"
#include "language/model/word_habits.h"

#include <algorithm>
#include <fmt/format.h>
#include <optional>
#include <span>
#include <string_view>

namespace feedhold::rules::number_without_point {
namespace {

// So many whole lengths with a point must stand in the file for each one without before the latter is a slip.  In the
// programs looked at the writers either had at least that many for one, or about as many of both kinds.
constexpr std::size_t kHabit = 4;
// A zero in front says more: there are controls whose programs have numbers of a fixed width, all without a point.
constexpr std::size_t kHabitOfZeros = 3;
// The same coordinate stands elsewhere with its point.
constexpr std::size_t kHabitOfTwins = 5;
constexpr std::size_t kMostSlips = 10; // each is compared with the whole file
// A whole number beside it has its point: `X10 Y5.`
constexpr std::size_t kHabitOfNeighbours = 2;

/// A word of the file with the same address and the same number, and with a point.
const Word *twinOf(const Word &word, const FileContext &context) {
  for (std::size_t i = 0; i < context.tree.blockCount(); ++i)
    for (const Word &other : context.tree.wordsOf(BlockId(i)))
      if (other.address() == word.address() && other.isNumber() && other.has(Word::kPoint) &&
          !other.has(Word::kArgument) && !other.has(Word::kComma) && other.number() == word.number())
        return &other;
  return nullptr;
}

/// A length of its block that is a whole number and has its point, as all others of the block: whoever wrote it does
/// not leave out points that seem to say nothing.
const Word *neighbourOf(const Word &word, const FileContext &context) {
  const Word *found = nullptr;
  for (const Word &other : context.tree.wordsOf(context.tree.blockAt(word.span().begin))) {
    if (&other == &word || formatOf(context.dialect, other.address()).kind != AddressKind::Length ||
        (other.isNumber() && other.number().isZero())) // `J0` is the same with a point
      continue;
    if (!other.isNumber() || !other.has(Word::kPoint))
      return nullptr;
    if (other.number().isInteger())
      found = &other;
  }
  return found;
}

/// What shows that a point is missing.
struct Witness {
  const Word *word;
  std::string_view saying; // ends the message
};

void reportWord(const Word &word, const std::optional<Witness> &witness, const FileContext &context,
                const Reporter &reporter) {
  const bool sure = context.dialect.switches.dpi == Switch::Off;
  const std::string_view unless = context.dialect.hasFanucParameters
                                      ? "with parameter 3401#0 (DPI) off "
                                      : "unless a setting of the machine makes it whole units, ";
  const std::int64_t counts = word.number().asInteger().value_or(0);
  const auto read = [&](const Decimal &increment) { return Decimal(counts, increment.scale()).toString(); };
  const LeastIncrements increments = leastIncrementsOf(context.dialect);
  reporter.report(
      {.message = fmt::format("{} has no decimal point, but {}", context.quoted(word.span()),
                              witness ? witness->saying : "the lengths around it do"),
       .span = word.span(),
       .labels = witness ? std::vector<Label>{{witness->word->span(), "with a point"}} : std::vector<Label>{},
       .notes = {fmt::format("{}the control reads it in least increments: {} mm or {} inch, not {}", sure ? "" : unless,
                             read(increments.metric), read(increments.inch), counts)},
       .fixes = {{.title = "add the decimal point", .edits = {{{word.span().end, word.span().end}, "."}}}}});
}

/// `G2 I2.0 J0 Z-500` in one block after the other is one slip, and the I beside it counts as often.
bool isRepeated(const Word &word, const WrittenLengths &lengths, const FileContext &context) {
  const auto same = static_cast<std::size_t>(std::ranges::count_if(lengths.withoutPoint, [&](WordId each) {
    return context.text(context.tree.words[each].span()) == context.text(word.span());
  }));
  const std::size_t others = lengths.withoutPoint.size() - same + 1;
  return same > 1 && lengths.wholeWithPoint >= lengths.withoutPoint.size() + kHabitOfNeighbours * others;
}

std::optional<Witness> witnessOf(const Word &word, const WrittenLengths &lengths, const FileContext &context) {
  const std::size_t slips = lengths.withoutPoint.size();
  if (lengths.withPoint >= kHabitOfTwins * slips)
    if (const Word *twin = twinOf(word, context))
      return Witness{twin, "has one elsewhere"};
  if (lengths.wholeWithPoint >= kHabitOfNeighbours * slips || isRepeated(word, lengths, context))
    if (const Word *neighbour = neighbourOf(word, context))
      return Witness{neighbour, "the other lengths of its block do"};
  return std::nullopt;
}

/// `Z-0560`: nobody writes a zero in front of a number, but behind a point that got lost there is one.
bool hasLeadingZero(const Word &word, const FileContext &context) {
  std::string_view digits = context.text(word.span()).substr(1);
  digits.remove_prefix(std::min(digits.find_first_not_of(" \t+-"), digits.size()));
  return digits.size() >= 3 && digits.front() == '0';
}

void reportLeadingZero(const Word &word, const FileContext &context, const Reporter &reporter) {
  reporter.report(
      {.message = fmt::format("{} begins with a zero and has no decimal point", context.quoted(word.span())),
       .span = word.span(),
       .notes = {"the lengths around it have a point, which may have been lost here: the control reads "
                 "another number than the one that was meant",
                 "write the point, or the number without the zero"}});
}

/// A drilling cycle of a mill, whose R is a level and whose Q a depth.
bool isDrilling(BlockId block, const FileContext &context) {
  return findAction(context.tree, block, context.dialect,
                    {CodeAction::CycleDrill, CodeAction::CycleDwell, CodeAction::CyclePeck, CodeAction::CycleChipBreak,
                     CodeAction::CycleTap, CodeAction::CycleTapLeft, CodeAction::CycleBore, CodeAction::CycleBoreStop});
}

/// The word counts in least increments, though its address has other meanings, too: R and Q of a cycle, R of an arc.
/// Large numbers of Q are meant so, as old controls need them.
bool isSmallLength(const Word &word, std::string_view addresses) {
  constexpr std::int64_t kMostOfPeck = 20;
  return addresses.find(word.address()) != std::string_view::npos && word.isNumber() && !word.has(Word::kPoint) &&
         !word.has(Word::kComma) && !word.has(Word::kArgument) && !word.number().isZero() &&
         (word.address() != 'Q' || word.number() <= Decimal(kMostOfPeck, 0));
}

/// A whole number of the block with its point.
const Word *wholeLengthIn(std::span<const Word> words, std::string_view addresses) {
  const auto found = std::ranges::find_if(words, [&](const Word &word) {
    return addresses.find(word.address()) != std::string_view::npos && word.isNumber() && word.has(Word::kPoint) &&
           word.number().isInteger() && !word.number().isZero();
  });
  return found == words.end() ? nullptr : &*found;
}

/// `G83 Z-40. R2 Q5`, `G02 X20. Y5. R10`
void checkFlexible(const WrittenLengths &lengths, const FileContext &context, const Reporter &reporter) {
  if (lengths.wholeWithPoint < kHabitOfNeighbours * (lengths.withoutPoint.size() + 1))
    return;
  for (std::size_t i = 0; i < context.tree.blockCount(); ++i) {
    const BlockId block(i);
    const bool drills = isDrilling(block, context);
    if (!drills && !findCode(context.tree, block, context.dialect, CodeRole::Arc))
      continue;
    const Word *whole = wholeLengthIn(context.tree.wordsOf(block), drills ? "Z" : "XYZUW");
    for (const Word &word : context.tree.wordsOf(block))
      if (whole && isSmallLength(word, drills ? "RQ" : "R"))
        reportWord(word, Witness{whole, "other lengths of its block do"}, context, reporter);
  }
}

void check(const FileContext &context, const Reporter &reporter) {
  WrittenLengths lengths = lengthsOf(context.tree, context.dialect);
  const auto odd = std::ranges::stable_partition(
      lengths.withoutPoint, [&](WordId word) { return !hasLeadingZero(context.tree.words[word], context); });
  if (lengths.withPoint >= kHabitOfZeros * odd.size())
    for (const WordId word : odd)
      reportLeadingZero(context.tree.words[word], context, reporter);
  lengths.withoutPoint.erase(odd.begin(), odd.end());
  if (context.dialect.switches.dpi == Switch::On)
    return;
  checkFlexible(lengths, context, reporter);
  const std::size_t slips = lengths.withoutPoint.size();
  if (lengths.wholeWithPoint >= kHabit * slips) {
    for (const WordId word : lengths.withoutPoint)
      reportWord(context.tree.words[word], std::nullopt, context, reporter);
  } else if (slips <= kMostSlips) {
    for (const WordId word : lengths.withoutPoint)
      if (const auto witness = witnessOf(context.tree.words[word], lengths, context))
        reportWord(context.tree.words[word], witness, context, reporter);
  }
}

} // namespace

extern const Rule numberWithoutPoint;
const Rule numberWithoutPoint{
    .info = {"number-without-point", Category::Word, Severity::Warning,
             "Reports a length without a decimal point in a program that writes decimal points everywhere else."},
    .hooks = {.file = check}};

} // namespace feedhold::rules::number_without_point
