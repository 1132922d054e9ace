// remark-of-other-speed: `G50 S3000 (MAX 2500 RPM)`.
#include "rules/comments/remarks_of_block.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <optional>

namespace feedhold::rules::remark_of_other_speed {
namespace {

/// Remarks round a computed speed.
constexpr double kRounded = 0.1;

struct Number {
  double value;
  std::size_t end;
};

/// The only number of the remark.
std::optional<Number> onlyNumberIn(std::string_view remark) {
  std::optional<Number> found;
  for (std::size_t at = 0; at < remark.size(); ++at) {
    if (!isDigit(remark[at]))
      continue;
    if (found || (at > 0 && (isLetter(remark[at - 1]) || remark[at - 1] == '.' || remark[at - 1] == '#')))
      return std::nullopt;
    std::string digits;
    while (at < remark.size() && (isDigit(remark[at]) || remark[at] == '.'))
      digits += remark[at++];
    found = Number{std::strtod(digits.c_str(), nullptr), at};
  }
  return found;
}

bool isOfSpindle(std::string_view remark, const Number &number) {
  const std::string_view behind = trimmed(remark.substr(number.end));
  for (const std::string_view unit : {"RPM", "U/MIN", "1/MIN", "REV/MIN", "R/MIN"})
    if (behind.starts_with(unit))
      return true;
  return saysAny(remark, {"ROTA", "SPINDLE SPEED", "DREHZAHL", "REVOLUTION"});
}

bool limitsSpeed(BlockId block, const FileContext &context) {
  return std::ranges::any_of(context.tree.wordsOf(block), [](const Word &word) {
    return word.address() == 'G' && (word.integer() == 50 || word.integer() == 92);
  });
}

void check(const Word &speed, BlockId block, const FileContext &context, const Reporter &reporter) {
  if (!speed.isNumber() || speed.number().isZero() || speed.has(Word::kArgument) ||
      findAction(context.tree, block, context.dialect, {CodeAction::ConstantSurface}))
    return;
  const auto comments = commentsOfLine(context, block);
  if (comments.size() != 1)
    return;
  const std::string remark = toUpper(context.text(comments.front()->span));
  const auto number = onlyNumberIn(remark);
  if (!number || number->value <= 0 || !isOfSpindle(remark, *number))
    return;
  const double own = speed.number().toDouble();
  const bool isMaximum = saysAny(remark, {"MAX", "LIMIT", "UP TO"}) && !limitsSpeed(block, context);
  const bool differs = std::abs(own - number->value) > kRounded * number->value;
  if (!differs || (isMaximum && own < number->value) ||
      saysAny(remark, {"MIN ", "WAS", "ORIGINAL", "INSTEAD", "OVERRIDE"}))
    return;
  reporter.report({.message = fmt::format("{} is not the speed that the remark names", context.quoted(speed.span())),
                   .span = speed.span(),
                   .labels = {{comments.front()->span, "the remark"}},
                   .notes = {"correct the number or the remark: whoever reads the program at the machine trusts it"}});
}

} // namespace

extern const Rule remarkOfOtherSpeed;
const Rule remarkOfOtherSpeed{.info = {"remark-of-other-speed", Category::Comment, Severity::Warning,
                                       "Reports an `S` whose remark names another speed in revolutions per minute."},
                              .hooks = {.word = check, .wordAddresses = "S"}};

} // namespace feedhold::rules::remark_of_other_speed
