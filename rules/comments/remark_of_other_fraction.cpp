// remark-of-other-fraction: `#103=1.0625 (EACH PASS, SAY 1/16")`: the whole number is too much.
#include "rules/comments/remarks_of_block.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <optional>

namespace feedhold::rules::remark_of_other_fraction {
namespace {

struct Fraction {
  std::string_view text; // `1/16`
  double value;
};

/// The digits from a place on.
std::string_view digitsAt(std::string_view text, std::size_t at) {
  std::size_t end = at;
  while (end < text.size() && isDigit(text[end]))
    ++end;
  return text.substr(at, end - at);
}

/// A whole number may stand before it: `1 1/16`, `1-1/16`, `3x1/4`.
bool standsAlone(std::string_view remark, std::size_t at) {
  const std::string_view before = trimmed(remark.substr(0, at));
  return before.empty() ||
         (!isDigit(before.back()) && std::string_view("-./X&").find(before.back()) == std::string_view::npos);
}

/// The only fraction of an inch that the remark names.
std::optional<Fraction> fractionIn(std::string_view remark) {
  constexpr int kFinest = 128;
  std::optional<Fraction> found;
  for (std::size_t at = 0; at < remark.size(); ++at) {
    const std::string_view above = digitsAt(remark, at);
    const std::size_t slash = at + above.size();
    if (above.empty() || slash >= remark.size() || remark[slash] != '/') {
      at += above.size();
      continue;
    }
    const std::string_view below = digitsAt(remark, slash + 1);
    const std::string_view unit = trimmed(remark.substr(slash + 1 + below.size()));
    const int over = std::atoi(std::string(above).c_str());
    const int under = std::atoi(std::string(below).c_str());
    const bool isInch = unit.starts_with('"') || unit.starts_with("INCH") || unit.starts_with("IN.");
    if (found || !isInch || !standsAlone(remark, at) || over == 0 || over >= under || under > kFinest)
      return std::nullopt;
    found = Fraction{remark.substr(at, above.size() + 1 + below.size()), static_cast<double>(over) / under};
    at = slash + below.size();
  }
  return found;
}

/// `#103=1.0625`, and nothing more.
const ExpressionId *valueIn(BlockId block, const FileContext &context) {
  const auto statements = context.tree.statementsOf(block);
  const auto *assignment = statements.size() == 1 ? std::get_if<Assignment>(&statements.front().node) : nullptr;
  return assignment ? &assignment->value : nullptr;
}

void check(BlockId block, const FileContext &context, const Reporter &reporter) {
  constexpr double kSame = 5e-5;
  const ExpressionId *id = valueIn(block, context);
  const auto comments = id ? commentsOfLine(context, block) : std::vector<const Comment *>{};
  const auto value = comments.empty() ? std::nullopt : literalValue(context.tree, *id);
  if (!value || value->isNegative())
    return;
  std::string remark;
  for (const Comment *comment : comments)
    remark += toUpper(context.text(comment->span)) + " ";
  const auto said = fractionIn(remark);
  const double number = value->toDouble();
  if (!said || number < 1 || std::abs(number - std::floor(number) - said->value) > kSame)
    return;
  reporter.report(
      {.message = fmt::format("{} is not the {} of the remark, but that and {:g}",
                              context.quoted(context.tree.expressions[*id].span), said->text, std::floor(number)),
       .span = context.tree.expressions[*id].span,
       .labels = {{comments.front()->span, "the remark"}},
       .notes = {fmt::format("write {:g}, or the whole number in the remark, too", said->value)}});
}

} // namespace

extern const Rule remarkOfOtherFraction;
const Rule remarkOfOtherFraction{.info = {"remark-of-other-fraction", Category::Comment, Severity::Warning,
                                          "Reports a variable that is set to a whole number more than the fraction of "
                                          "an inch in the remark beside it."},
                                 .hooks = {.block = check}};

} // namespace feedhold::rules::remark_of_other_fraction
