#include "rules/comments/header_call.h"

#include "base/support/text.h"
#include "findings/rule/dead_blocks.h"

#include <algorithm>

namespace feedhold::rules {
namespace {

/// A letter with a number, a variable, a blank to fill in, or nothing behind it: `X100.`, `H_`, `T#1`, `[Z..]`.
bool isArgument(std::string_view text, std::size_t at) {
  constexpr std::string_view kBefore = " \t,[(";
  constexpr std::string_view kBehind = "_#.-[<+?*";
  if (!isLetter(text[at]) || kBefore.find(text[at - 1]) == std::string_view::npos)
    return false;
  return at + 1 < text.size() && (isDigit(text[at + 1]) || kBehind.find(text[at + 1]) != std::string_view::npos);
}

/// Where the number of the program ends behind `G65` and `P`; absent: there is no such call.
std::optional<std::size_t> behindNumber(std::string_view upper, std::string_view number) {
  std::size_t at = upper.find("G65");
  if (at == std::string_view::npos)
    return std::nullopt;
  at = upper.find_first_not_of(" \t", at + 3);
  if (at == std::string_view::npos || upper[at] != 'P')
    return std::nullopt;
  at = upper.find_first_not_of("0", at + 1);
  const bool isIts = at != std::string_view::npos && upper.substr(at, number.size()) == number &&
                     (at + number.size() == upper.size() || !isDigit(upper[at + number.size()]));
  return isIts ? std::optional(at + number.size()) : std::nullopt;
}

} // namespace

std::optional<HeaderCall> headerCallOf(const FileContext &context, ProgramId program) {
  const Program &whole = context.model.programs[program];
  if (!whole.name.number)
    return std::nullopt;
  const std::string digits = std::to_string(*whole.name.number);
  for (BlockId block = whole.first; block < whole.last; block = block.next()) {
    for (const Comment &comment : context.tree.commentsOf(block)) {
      const std::string upper = toUpper(context.text(comment.span));
      const auto from = behindNumber(upper, digits);
      if (!from)
        continue;
      HeaderCall call{{}, comment.span};
      for (std::size_t at = *from; at < upper.size(); ++at)
        if (isArgument(upper, at))
          call.letters.insert(upper[at]);
      if (!call.letters.empty())
        return call;
    }
    if (block != whole.first && hasContent(context, block))
      break;
  }
  return std::nullopt;
}

} // namespace feedhold::rules
