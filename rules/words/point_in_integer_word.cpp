// point-in-integer-word: `M3.0`, `T1.`.
#include "findings/rule/rule.h"

#include "rules/words/block_words.h"
#include "rules/words/letter_for_digit.h"
#include "rules/words/word_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace feedhold::rules::point_in_integer_word {
namespace {

/// Safe only where the control stops at the point: another one might read the number in its own unit.
std::vector<FixIt> fixesFor(const Word &word, FixSafety safety) {
  const auto value = word.number().asInteger();
  if (!value)
    return {};
  const std::string whole = fmt::format("{}{}", word.address(), *value);
  return {{safety, fmt::format("write `{}`", whole), {{word.span(), whole}}}};
}

/// A cycle in whose words an address means something else: D of a turning cycle is a depth.
bool isCycle(const Word &word, const FileContext &context) {
  const Code *code = codeOf(word, context.dialect);
  return code && (code->role == CodeRole::Contour || code->role == CodeRole::CannedCycle);
}

/// On a lathe with a C axis, H is what C moves by: `G28 H0.0`.
bool isMoveOfC(const Word &word, const FileContext &context, BlockId block) {
  return word.address() == 'H' && findAction(context.tree, block, context.dialect,
                                             {CodeAction::ReferenceReturn, CodeAction::Rapid, CodeAction::Linear});
}

/// A word beside M98 is meant as an argument, and arguments-of-subprogram says so.
bool isBesideCall(const Word &word, const FileContext &context, BlockId block) {
  return word.address() != 'P' && word.address() != 'L' &&
         std::ranges::any_of(context.model.callsIn(block, block.next()),
                             [](const Call &call) { return call.kind == CallKind::Subprogram; });
}

/// The block goes on with a cycle that stands in the block before it without all of its words, and that is reported.
bool continuesCycle(const FileContext &context, BlockId block) {
  if (block.index() == 0 || findWord(context.tree, block, 'G') || findWord(context.tree, block, 'M'))
    return false;
  const BlockId before(block.index() - 1);
  const Word *cycle = findCode(context.tree, before, context.dialect, CodeRole::Contour);
  return cycle && findWord(context.tree, before, 'P') && !findWord(context.tree, before, 'Q');
}

/// Another word of the block makes arguments of its words, or `G66.1` those of every block.
bool mayBeArgument(const Word &word, const FileContext &context, BlockId block) {
  for (const Word &other : context.tree.wordsOf(block))
    if (&other != &word && (meansOwnWords(other, context) || isCycle(other, context)))
      return true;
  const auto calls = context.model.callsOf(context.model.programOf(block));
  return std::ranges::find(calls, CallKind::ModalEach, &Call::kind) != calls.end();
}

/// `X1O.`: a letter in the place of a digit began a word.
void reportDigits(const Word &word, const FileContext &context, const Reporter &reporter) {
  const auto digits = mistypedDigitsAt(word.span().begin, context);
  const bool isReported = std::ranges::any_of(
      context.tree.issues, [&](const SyntaxIssue &issue) { return digits->span.contains(issue.span); });
  if (isReported)
    return;
  reporter.report(
      {.message = fmt::format("{} takes no decimal point: {}", context.quoted(word.span()), describe(*digits)),
       .span = word.span(),
       .fixes = fixesFor(*digits)});
}

/// P of a call or of G10 on a FANUC control.  Not of a dwell: Haas controls read `G04 P1.5` as seconds, and their
/// programs may be taken for those of a FANUC.
void checkNumber(const Word &word, BlockId block, const FileContext &context, const Reporter &reporter) {
  constexpr std::array kRoles = {CodeRole::SubprogramCall, CodeRole::MacroCall, CodeRole::ModalCall,
                                 CodeRole::DataSetting};
  const bool isNumber = std::ranges::any_of(
      kRoles, [&](CodeRole role) { return findCode(context.tree, block, context.dialect, role) != nullptr; });
  if (!context.dialect.hasFanucParameters || word.has(Word::kArgument) ||
      context.tree.blocks[block].has(Block::kData) || !isNumber)
    return;
  reporter.report({.message = fmt::format("{} takes no decimal point", context.quoted(word.span())),
                   .span = word.span(),
                   .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::MisplacedPoint))},
                   .fixes = fixesFor(word, FixSafety::Safe)});
}

void check(const Word &word, BlockId block, const FileContext &context, const Reporter &reporter) {
  const AddressFormat &format = formatOf(context.dialect, word.address());
  const bool isPlain =
      word.address() == 'P' && format.kind == AddressKind::Flexible && !hasTooManyWords(context, block);
  if (isPlain && word.isNumber() && word.has(Word::kPoint))
    return checkNumber(word, block, context, reporter);
  if (!word.isNumber() || !word.has(Word::kPoint) || word.has(Word::kComma) || format.kind != AddressKind::Integer ||
      format.literalMayHavePoint || mayBeArgument(word, context, block) || isBesideCall(word, context, block) ||
      isMoveOfC(word, context, block) || continuesCycle(context, block))
    return;
  if (mistypedDigitsAt(word.span().begin, context))
    return reportDigits(word, context, reporter);
  const bool knownToStop = alarmNumber(context.dialect, AlarmKind::MisplacedPoint).has_value();
  reporter.report(
      {.message = fmt::format("{} takes no decimal point", context.quoted(word.span())),
       .span = word.span(),
       .notes = {knownToStop ? fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::MisplacedPoint))
                             : std::string("other controls stop here; the manual of this one does not say")},
       .fixes = fixesFor(word, knownToStop ? FixSafety::Safe : FixSafety::NeedsReview)},
      knownToStop ? Severity::Error : Severity::Info);
}

} // namespace

extern const Rule pointInIntegerWord;
const Rule pointInIntegerWord{
    .info = {"point-in-integer-word", Category::Word, Severity::Error,
             "Reports a decimal point in a word that takes whole numbers only, such as `M3.0`."},
    .hooks = {.word = check, .wordAddresses = "BDHLMNOPSTG"}};

} // namespace feedhold::rules::point_in_integer_word
