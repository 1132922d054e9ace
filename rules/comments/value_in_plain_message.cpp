// value-in-plain-message: `(MSG, length #<_length>)`.
#include "findings/rule/rule.h"

#include "base/support/text.h"

#include <fmt/format.h>

namespace feedhold::rules::value_in_plain_message {
namespace {

void check(const Comment &comment, BlockId, const FileContext &context, const Reporter &reporter) {
  const std::string_view text = context.text(comment.span);
  if (!context.dialect.grammar.oWords || text.size() < 2 || text.front() != '(' ||
      !toUpper(trimmed(text.substr(1)).substr(0, 4)).starts_with("MSG,"))
    return;
  const std::size_t name = text.find("#<");
  const std::size_t end = text.find('>', name);
  if (name == std::string_view::npos || end == std::string_view::npos)
    return;
  const std::size_t kind = text.find_first_not_of("( \t");
  const auto spanOf = [&](std::size_t from, std::size_t size) {
    const std::uint32_t begin = comment.span.begin + static_cast<std::uint32_t>(from);
    return Span{begin, begin + static_cast<std::uint32_t>(size)};
  };
  const Span span = spanOf(name, end + 1 - name), msg = spanOf(kind, 3);
  reporter.report({.message = fmt::format("the message shows {} as it stands, not its value", context.quoted(span)),
                   .span = span,
                   .labels = {{msg, "takes the text as it is"}},
                   .notes = {"`(DEBUG, ..)` shows the same message with the values of the parameters in it"},
                   .fixes = {{.title = "write `DEBUG`", .edits = {{msg, "DEBUG"}}}}});
}

} // namespace

extern const Rule valueInPlainMessage;
const Rule valueInPlainMessage{.info = {"value-in-plain-message", Category::Comment, Severity::Warning,
                                        "Reports the name of a parameter in `(MSG, ..)`, which does not show its "
                                        "value."},
                               .hooks = {.comment = check}};

} // namespace feedhold::rules::value_in_plain_message
