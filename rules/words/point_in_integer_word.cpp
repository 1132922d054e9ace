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

void check(const Word &word, BlockId block, const FileContext &context, const Reporter &reporter) {
  const AddressFormat &format = formatOf(context.dialect, word.address());
  if (!word.isNumber() || !word.has(Word::kPoint) || word.has(Word::kComma) || format.kind != AddressKind::Integer ||
      format.literalMayHavePoint || passesArguments(context, block))
    return;
  reporter.report({.message = fmt::format("{} takes no decimal point", context.quoted(word.span())),
                   .span = word.span(),
                   .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::MisplacedPoint))},
                   .fixes = fixesFor(word, context)});
}

} // namespace

extern const Rule pointInIntegerWord;
const Rule pointInIntegerWord{.info = {"point-in-integer-word", Category::Word, Severity::Error,
                                       "Reports a decimal point in a word that takes whole numbers only, as `M3.0`."},
                              .hooks = {.word = check, .wordAddresses = "BDHLMNOPSTG"}};

} // namespace feedhold::rules
