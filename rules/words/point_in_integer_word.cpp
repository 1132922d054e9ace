// point-in-integer-word: `M3.0`, `T1.`.
#include "findings/rule/rule.h"

#include "rules/words/block_words.h"

#include <fmt/format.h>

namespace feedhold::rules {
namespace {

std::vector<FixIt> fixesFor(const Word &word, const FileContext &context) {
  const auto value = word.number().asInteger();
  const std::string_view text = context.text(word.span());
  const std::size_t point = text.find('.');
  if (!value || point == std::string_view::npos)
    return {};
  const std::uint32_t begin = word.span().begin + static_cast<std::uint32_t>(point);
  return {{FixSafety::Safe, fmt::format("write `{}{}`", word.address(), *value), {{{begin, word.span().end}, ""}}}};
}

/// Another word of the block makes arguments of its words.
bool mayBeArgument(const Word &word, const FileContext &context, BlockId block) {
  for (const Word &other : context.tree.wordsOf(block))
    if (&other != &word && meansOwnWords(other, context))
      return true;
  return false;
}

void check(const Word &word, BlockId block, const FileContext &context, const Reporter &reporter) {
  const AddressFormat &format = formatOf(context.dialect, word.address());
  if (!word.isNumber() || !word.has(Word::kPoint) || word.has(Word::kComma) || format.kind != AddressKind::Integer ||
      format.literalMayHavePoint || mayBeArgument(word, context, block))
    return;
  const bool knownToStop = alarmNumber(context.dialect, AlarmKind::MisplacedPoint).has_value();
  reporter.report(
      {.message = fmt::format("{} takes no decimal point", context.quoted(word.span())),
       .span = word.span(),
       .notes = {knownToStop ? fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::MisplacedPoint))
                             : std::string("other controls stop here; whether this one does is not documented")},
       .fixes = fixesFor(word, context)},
      knownToStop ? Severity::Error : Severity::Warning);
}

} // namespace

extern const Rule pointInIntegerWord;
const Rule pointInIntegerWord{.info = {"point-in-integer-word", Category::Word, Severity::Error,
                                       "Reports a decimal point in a word that takes whole numbers only, as `M3.0`."},
                              .hooks = {.word = check, .wordAddresses = "BDHLMNOPSTG"}};

} // namespace feedhold::rules
