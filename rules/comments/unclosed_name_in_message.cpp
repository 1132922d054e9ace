// unclosed-name-in-message: `(PRINT, offset #<_work)`.
#include "findings/rule/rule.h"

#include "base/support/text.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace feedhold::rules::unclosed_name_in_message {
namespace {

/// The control puts values into these comments.
bool isMessage(std::string_view inner) {
  const std::string upper = toUpper(inner);
  constexpr std::array<std::string_view, 3> kMessages = {"DEBUG,", "PRINT,", "LOG,"};
  return std::ranges::any_of(kMessages, [&](std::string_view begin) { return upper.starts_with(begin); });
}

bool isNameCharacter(char c) { return isLetter(c) || isDigit(c) || c == '_'; }

/// `#_angle>`, `<#_angle>`: the first one.
void checkOpening(const Comment &comment, const FileContext &context, const Reporter &reporter) {
  const std::string_view text = context.text(comment.span);
  for (std::size_t hash = text.find('#'); hash != std::string_view::npos; hash = text.find('#', hash + 1)) {
    std::size_t end = hash + 1;
    while (end < text.size() && isNameCharacter(text[end]))
      ++end;
    const bool isName = end > hash + 1 && !isDigit(text[hash + 1]);
    if (!isName || end >= text.size() || text[end] != '>')
      continue;
    const auto begin = comment.span.begin + static_cast<std::uint32_t>(hash);
    const Span span{begin, comment.span.begin + static_cast<std::uint32_t>(end) + 1};
    reporter.report({.message = fmt::format("the name {} has no `<` behind its `#`", context.quoted(span)),
                     .span = span,
                     .notes = {"the message shows no value here",
                               fmt::format("write `#<{}>`", text.substr(hash + 1, end - hash - 1))}});
    return;
  }
}

void check(const Comment &comment, BlockId, const FileContext &context, const Reporter &reporter) {
  const std::string_view text = context.text(comment.span);
  if (!context.dialect.grammar.oWords || text.size() < 2 || text.front() != '(' || !isMessage(trimmed(text.substr(1))))
    return;
  checkOpening(comment, context, reporter);
  const std::size_t name = text.rfind("#<");
  if (name == std::string_view::npos || text.find('>', name) != std::string_view::npos)
    return;
  const auto begin = comment.span.begin + static_cast<std::uint32_t>(name);
  const std::uint32_t end = comment.span.end - (text.back() == ')' ? 1U : 0U);
  reporter.report({.message = fmt::format("the name {} has no `>`", context.quoted({begin, end})),
                   .span = {begin, end},
                   .notes = {"the message shows no value here", "close the name with `>`"}});
}

} // namespace

extern const Rule unclosedNameInMessage;
const Rule unclosedNameInMessage{
    .info = {"unclosed-name-in-message", Category::Comment, Severity::Warning,
             "Reports the name of a parameter without `<` or `>` in a message of LinuxCNC."},
    .hooks = {.comment = check}};

} // namespace feedhold::rules::unclosed_name_in_message
