// number-without-address: `G43 25.0 H01`, where Z is missing.
#include "rules/words/lone_number.h"

#include <fmt/format.h>

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

bool isNoCode(const Word &word, const Dialect &dialect) {
  const auto tenths = word.tenths();
  return word.address() == 'G' && word.isCode() && !(tenths && hasGCode(dialect, *tenths));
}

void check(const Word &word, BlockId, const FileContext &context, const Reporter &reporter) {
  const auto lone = loneNumberIn(word, context);
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
    .hooks = {.word = check, .wordAddresses = "ABCDEFGHIJKLMPQRSTUVWXYZ"}};

} // namespace number_without_address
} // namespace feedhold::rules
