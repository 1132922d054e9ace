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

void check(const Comment &comment, BlockId, const FileContext &context, const Reporter &reporter) {
  const std::string_view text = context.text(comment.span);
  if (!context.dialect.grammar.oWords || text.size() < 2 || text.front() != '(' || !isMessage(trimmed(text.substr(1))))
    return;
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
const Rule unclosedNameInMessage{.info = {"unclosed-name-in-message", Category::Comment, Severity::Warning,
                                          "Reports the name of a parameter without `>` in a message of LinuxCNC."},
                                 .hooks = {.comment = check}};

} // namespace feedhold::rules::unclosed_name_in_message
