// See the header.
#include "findings/rule/placeholders.h"

#include "base/support/text.h"

#include <array>

namespace feedhold {

namespace {

/// The line around a byte, without its end.
Span lineAround(std::string_view text, std::uint32_t offset) {
  const std::size_t before = offset == 0 ? std::string_view::npos : text.find_last_of("\r\n", offset - 1);
  const std::size_t begin = before == std::string_view::npos ? 0 : before + 1;
  const std::size_t end = std::min(text.find_first_of("\r\n", offset), text.size());
  return {static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(std::max(begin, end))};
}

/// A line of dots alone: what is left out.
bool isEllipsis(std::string_view line) {
  const std::string_view text = trimmed(line);
  return (text.size() >= 3 && text.find_first_not_of('.') == std::string_view::npos) || text == "\xe2\x80\xa6";
}

/// `#n`: a number to be chosen.
std::size_t findLetterVariable(std::string_view line) {
  for (std::size_t at = line.find("#n"); at != std::string_view::npos; at = line.find("#n", at + 1)) {
    const char next = at + 2 < line.size() ? line[at + 2] : ' ';
    if (!isLetter(next) && !isDigit(next))
      return at;
  }
  return std::string_view::npos;
}

std::optional<Span> placeholderOf(std::string_view text, Span line) {
  constexpr std::array<std::string_view, 4> kMarks = {"${", "[..]", "[...]", "{{"};
  const std::string_view content = text.substr(line.begin, line.size());
  if (isEllipsis(content))
    return line;
  for (const std::string_view mark : kMarks)
    if (const std::size_t at = content.find(mark); at != std::string_view::npos) {
      const auto begin = line.begin + static_cast<std::uint32_t>(at);
      return Span{begin, begin + static_cast<std::uint32_t>(mark.size())};
    }
  if (const std::size_t at = findLetterVariable(content); at != std::string_view::npos) {
    const auto begin = line.begin + static_cast<std::uint32_t>(at);
    return Span{begin, begin + 2};
  }
  return std::nullopt;
}

/// Besides one line of dots, the text is a program from its number to its end: the dots are a slip.
bool isProgramWithSlip(const FileContext &context) {
  constexpr std::size_t kFewestBlocks = 12;
  const SyntaxTree &tree = context.tree;
  if (context.model.programs.size() != 1)
    return false;
  const Program &program = *context.model.programs.begin();
  std::size_t full = 0;
  bool ends = false;
  for (BlockId block = program.first; block < program.last; block = block.next()) {
    full += isEmpty(tree, block) ? 0U : 1U;
    ends = ends || flowAfter(tree, block, context.dialect) == FlowAfter::Ends;
  }
  return ends && full >= kFewestBlocks && tree.issues.size() <= 1 + full / 4 && !program.name.empty();
}

} // namespace

std::optional<Span> placeholderIn(const FileContext &context) {
  const std::string_view text = context.source.text();
  for (const SyntaxIssue &issue : context.tree.issues) {
    const Span line = lineAround(text, issue.span.begin);
    const auto found = placeholderOf(text, line);
    if (found && !(found == line && isProgramWithSlip(context)))
      return found;
  }
  return std::nullopt;
}

} // namespace feedhold
