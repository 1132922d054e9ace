// remark-of-other-size: `(BORE PHI25.016)`, and the contour goes to X25.616.
#include "findings/rule/rule.h"

#include "base/support/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>

namespace feedhold::rules::remark_of_other_size {
namespace {

constexpr std::size_t kFewestDecimals = 3; // shorter numbers are like each other by chance

/// A diameter with a fraction, by its digits: `25.016` behind PHI, DIA or the sign.
struct Size {
  std::string digits;
  Span span;
};

bool isExact(std::string_view digits) {
  const std::size_t point = digits.find('.');
  return point != std::string_view::npos && point > 0 && digits.size() - point > kFewestDecimals &&
         digits.find_first_of("123456789", point) != std::string_view::npos &&
         digits.find('.', point + 1) == std::string_view::npos;
}

std::optional<Size> sizeIn(std::string_view text, Span comment) {
  constexpr std::array<std::string_view, 6> kNames = {"PHI", "DIAMETER", "DIAM", "DIA", "\xC3\x98", "\xC3\xB8"};
  const std::string upper = toUpper(text);
  for (const std::string_view name : kNames)
    for (std::size_t at = upper.find(name); at != std::string::npos; at = upper.find(name, at + 1)) {
      const std::size_t begin = std::min(upper.find_first_not_of(" :=.", at + name.size()), upper.size());
      const std::size_t end = std::min(upper.find_first_not_of("0123456789.", begin), upper.size());
      if (const std::string digits = upper.substr(begin, end - begin); isExact(digits))
        return Size{
            digits,
            {comment.begin + static_cast<std::uint32_t>(begin), comment.begin + static_cast<std::uint32_t>(end)}};
    }
  return std::nullopt;
}

/// One digit stands for another one.
bool differsInOneDigit(std::string_view a, std::string_view b) {
  if (a.size() != b.size() || a.find('.') != b.find('.'))
    return false;
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    count += a[i] == b[i] ? 0U : 1U;
  return count == 1;
}

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.machine != MachineKind::Turning)
    return;
  const Program &its = context.model.programs[program];
  std::map<std::string, Span> diameters; // by their digits
  std::map<std::string, Span> sizes;
  for (BlockId block = its.first; block < its.last; block = block.next()) {
    const Word *diameter = findWord(context.tree, block, 'X');
    if (diameter && diameter->isNumber())
      diameters.emplace(trimmed(context.text(diameter->span()).substr(1)), diameter->span());
    for (const Comment &comment : context.tree.commentsOf(block))
      if (const auto size = sizeIn(context.text(comment.span), comment.span))
        sizes.emplace(size->digits, size->span);
  }
  for (const auto &[size, remark] : sizes) {
    if (diameters.contains(size))
      continue;
    const auto like = std::ranges::find_if(
        diameters, [&of = size](const auto &diameter) { return differsInOneDigit(of, diameter.first); });
    if (like == diameters.end() || sizes.contains(like->first))
      continue;
    reporter.report({.message = fmt::format("{} differs in one digit from the diameter in the remark",
                                            context.quoted(like->second)),
                     .span = like->second,
                     .labels = {{remark, "no X has this diameter"}},
                     .notes = {"the part comes out with another size than the remark says",
                               "correct the coordinate or the remark"}});
  }
}

} // namespace

extern const Rule remarkOfOtherSize;
const Rule remarkOfOtherSize{
    .info = {"remark-of-other-size", Category::Comment, Severity::Warning,
             "Reports an X of a lathe that differs in one digit from the diameter in a remark."},
    .hooks = {.program = check}};

} // namespace feedhold::rules::remark_of_other_size
