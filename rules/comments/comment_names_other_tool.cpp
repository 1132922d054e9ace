// comment-names-other-tool: `T5M6(T6 DRILL)`; `T0101 (ROUGHER R0.4)`, `T0101 (PARTING TOOL W3)` and
// `T0202 (PARTING TOOL W3)`.
#include "findings/rule/rule.h"

#include "base/support/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <vector>

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

/// A tool call with the remark beside it.
struct Described {
  const Word *tool;
  Span remark;
};
using ByTool = std::map<std::uint32_t, std::vector<Described>>;

/// `T0101 (TURNING TOOL R0.4)`, `T1 M06 (MILL 20)`: not a tool that is only made ready.
bool changesTool(BlockId block, const FileContext &context) {
  return context.dialect.machine == MachineKind::Turning ||
         findAction(context.tree, block, context.dialect, {CodeAction::ToolChange});
}

/// T0 is none.
ByTool describedTools(const Program &program, const FileContext &context) {
  ByTool tools;
  for (BlockId block = program.first; block < program.last; block = block.next()) {
    const Word *tool = findWord(context.tree, block, 'T');
    const auto number = tool ? tool->integer() : std::nullopt;
    const auto comments = context.tree.commentsOf(block);
    if (number && *number != 0 && comments.size() == 1 && changesTool(block, context))
      tools[static_cast<std::uint32_t>(*number)].push_back({tool, comments.front().span});
  }
  return tools;
}

/// It has a size: names of operations, such as FINISH OD, fit several tools.
bool namesSize(std::string_view remark) { return std::ranges::any_of(remark, isDigit); }

/// The other tool whose only remark is the one of the call.
const Described *otherWithRemark(const Described &call, const ByTool &tools, const FileContext &context) {
  for (const auto &[number, described] : tools) {
    const auto isAlike = [&](const Described &other) {
      return context.text(other.remark) == context.text(call.remark);
    };
    if (described.front().tool->integer() != call.tool->integer() && std::ranges::all_of(described, isAlike))
      return &described.front();
  }
  return nullptr;
}

/// A tool is called with its remark, and then with that of another tool.
void checkProgram(ProgramId program, const FileContext &context, const Reporter &reporter) {
  const ByTool tools = describedTools(context.model.programs[program], context);
  for (const auto &[number, calls] : tools) {
    const auto differs = std::ranges::find_if(
        calls, [&](const Described &call) { return context.text(call.remark) != context.text(calls.front().remark); });
    if (differs == calls.end() || !namesSize(context.text(calls.front().remark)) ||
        !namesSize(context.text(differs->remark)))
      continue;
    if (const Described *other = otherWithRemark(*differs, tools, context))
      reporter.report(
          {.message = fmt::format("{} changes the tool, but its comment describes {}",
                                  context.quoted(differs->tool->span()), context.quoted(other->tool->span())),
           .span = differs->tool->span(),
           .labels = {{calls.front().remark, "this tool"}, {other->remark, "the tool of the comment"}},
           .notes = {"the work is done with another tool than the one that was meant",
                     "find out which tool is meant, and correct the word or the comment"}});
  }
}

} // namespace

extern const Rule commentNamesOtherTool;
const Rule commentNamesOtherTool{.info = {"comment-names-other-tool", Category::Comment, Severity::Warning,
                                          "Reports a tool change whose comment begins with the number of another tool, "
                                          "or describes another tool of the program."},
                                 .hooks = {.program = checkProgram, .block = check}};

} // namespace feedhold::rules::comment_names_other_tool
