// comment-names-other-tool: `T5M6(T6 DRILL)`.
#include "findings/rule/rule.h"

#include "base/support/text.h"

#include <fmt/format.h>

#include <optional>

namespace feedhold::rules::comment_names_other_tool {
namespace {

/// `(T06 DRILL)`, `( T6 - DRILL )`: the number at the head of the comment.
std::optional<std::uint32_t> toolOf(std::string_view text) {
  std::size_t at = 1;
  while (at < text.size() && isBlank(text[at]))
    ++at;
  if (at + 1 >= text.size() || toUpper(text[at]) != 'T')
    return std::nullopt;
  const std::size_t first = ++at;
  std::uint32_t number = 0;
  for (; at < text.size() && isDigit(text[at]); ++at)
    number = number * 10 + static_cast<std::uint32_t>(text[at] - '0');
  // T25 TORX and the like: more digits are another number, a letter or a point another word.
  const bool goesOn = at < text.size() && (text[at] == '.' || text[at] == '/' || isLetter(text[at]));
  return at == first || at - first > 3 || goesOn ? std::nullopt : std::optional(number);
}

/// `T6`, and then `T5 M06(T6 DRILL)`: a changer that takes the tool made ready before, and makes T5 ready.  The same
/// where the next change loads it.
bool isNeighbour(const FileContext &context, BlockId block, std::uint32_t tool) {
  const Program &program = context.model.programs[context.model.programOf(block)];
  const auto isTool = [&](BlockId each) {
    const Word *word = findWord(context.tree, each, 'T');
    return word ? std::optional(word->integer() == tool) : std::nullopt;
  };
  std::optional<bool> before;
  for (std::uint32_t i = block.index(); !before && i-- > program.first.index();)
    before = isTool(BlockId(i));
  std::optional<bool> behind;
  for (BlockId each = block.next(); !behind && each < program.last; each = each.next())
    behind = isTool(each);
  return before.value_or(false) || behind.value_or(false);
}

void check(BlockId block, const FileContext &context, const Reporter &reporter) {
  const auto comments = context.tree.commentsOf(block);
  if (comments.size() != 1 || meansOwnWords(context.tree, block, context.dialect))
    return;
  const Word *tool = findWord(context.tree, block, 'T');
  const auto number = tool ? tool->integer() : std::nullopt;
  const auto named = number ? toolOf(context.text(comments.front().span)) : std::nullopt;
  const bool changes = findAction(context.tree, block, context.dialect, {CodeAction::ToolChange}) != nullptr;
  if (!named || !changes || *named == *number || isNeighbour(context, block, *named))
    return;
  reporter.report(
      {.message = fmt::format("{} changes the tool, but its comment names T{}", context.quoted(tool->span()), *named),
       .span = tool->span(),
       .labels = {{comments.front().span, "the comment"}},
       .notes = {"who sets up the machine by the comment puts another tool into the pocket",
                 "find out which tool is meant, and correct the word or the comment"}});
}

} // namespace

extern const Rule commentNamesOtherTool;
const Rule commentNamesOtherTool{
    .info = {"comment-names-other-tool", Category::Comment, Severity::Warning,
             "Reports a tool change beside a comment that begins with the number of another tool."},
    .hooks = {.block = check}};

} // namespace feedhold::rules::comment_names_other_tool
