// number-without-address: `G43 25.0 H01`, where Z is missing.
#include "rules/words/lone_number.h"

#include "base/support/text.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules {

std::optional<Span> loneNumberIn(const Word &word, const FileContext &context) {
  const std::string_view text = context.text(word.span());
  if (!word.isNumber() || text.find_first_of(" \t") == std::string_view::npos)
    return std::nullopt;
  bool hasDigits = false;
  bool isParted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool isDigit = text[i] >= '0' && text[i] <= '9';
    if (isDigit && isParted)
      return Span{word.span().begin + static_cast<std::uint32_t>(i), word.span().end};
    isParted = hasDigits && (text[i] == ' ' || text[i] == '\t');
    hasDigits = hasDigits || isDigit;
  }
  return std::nullopt;
}

namespace number_without_address {
namespace {

std::string withoutBlanks(std::string_view text) {
  std::string joined;
  for (const char c : text)
    if (c != ' ' && c != '\t')
      joined += c;
  return joined;
}

std::uint16_t tenthsOf(std::string_view digits) {
  std::uint16_t value = 0;
  for (const char c : digits)
    value = static_cast<std::uint16_t>(value * 10 + (c - '0'));
  return static_cast<std::uint16_t>(value * 10);
}

bool isNoCode(const Word &word, const Dialect &dialect) {
  const auto tenths = word.tenths();
  return word.address() == 'G' && word.isCode() && !(tenths && hasGCode(dialect, *tenths));
}

/// `N 1 20` between N110 and N130 is a number of its row that is written with a blank.
bool fitsIntoRow(const Word &word, const FileContext &context) {
  const std::span<const SequenceNumber> row = context.model.sequenceNumbers;
  const auto own = std::ranges::find(row, context.tree.idOf(word), &SequenceNumber::word);
  if (own == row.end())
    return true; // it numbers no block
  const bool isAbove = own == row.begin() || (own - 1)->number < own->number;
  const bool isBelow = own + 1 == row.end() || own->number < (own + 1)->number;
  return isAbove && isBelow && row.size() > 1;
}

/// `N10 21 G40`, where the row goes on with N20.
void checkSequenceNumber(const Word &word, Span lone, const FileContext &context, const Reporter &reporter) {
  if (fitsIntoRow(word, context))
    return;
  const std::string code = fmt::format("G{}", context.text(lone));
  const bool isCode = lone.size() <= 2 && hasGCode(context.dialect, tenthsOf(context.text(lone)));
  reporter.report(
      {.message = fmt::format("{} has no address: the letter before it is missing", context.quoted(lone)),
       .span = lone,
       .label = isCode ? fmt::format("is `{}` meant?", code) : "a number alone",
       .notes = {fmt::format("the control ignores the blank and reads `{}`", withoutBlanks(context.text(word.span()))),
                 "write the address, or take the blank out of the number"}},
      Severity::Warning);
}

/// `Y42. 013`: a word does not begin with 0, so that it is the fraction.
bool isFraction(const Word &word, Span lone, const FileContext &context) {
  const std::string_view before = trimmed(context.text({word.span().begin, lone.begin}));
  return before.ends_with('.') && lone.size() > 1 && context.text(lone).starts_with('0');
}

void tellFraction(const Word &word, const FileContext &context, const Reporter &reporter) {
  reporter.report(
      {.message = fmt::format("{} has a blank inside its number", context.quoted(word.span())),
       .span = word.span(),
       .notes = {fmt::format("the control ignores the blank and reads `{}`", withoutBlanks(context.text(word.span()))),
                 "take the blank out, or write the address of the second number"}},
      Severity::Info);
}

void check(const Word &word, BlockId, const FileContext &context, const Reporter &reporter) {
  const auto lone = loneNumberIn(word, context);
  if (lone && word.address() == 'N')
    return checkSequenceNumber(word, *lone, context, reporter);
  if (lone && isFraction(word, *lone, context))
    return tellFraction(word, context, reporter);
  if (!lone)
    return;
  const bool stops = isNoCode(word, context.dialect);
  const std::string read = withoutBlanks(context.text(word.span()));
  reporter.report({.message = fmt::format("{} has no address: the letter before it is missing", context.quoted(*lone)),
                   .span = *lone,
                   .label = "a number alone",
                   .notes = {stops ? fmt::format("the control ignores the blank, reads `{}` and {}", read,
                                                 stopsWith(context.dialect, AlarmKind::GCodeNotUsable))
                                   : fmt::format("the control ignores the blank and reads `{}`", read),
                             "write the address, or take the blank out of the number"}},
                  stops ? Severity::Error : Severity::Warning);
}

} // namespace

extern const Rule numberWithoutAddress;
const Rule numberWithoutAddress{
    .info = {"number-without-address", Category::Word, Severity::Error,
             "Reports a number behind a blank whose address is missing, so that the control takes it as further digits "
             "of the word before it."},
    .hooks = {.word = check, .wordAddresses = "ABCDEFGHIJKLMNPQRSTUVWXYZ"}};

} // namespace number_without_address
} // namespace feedhold::rules
