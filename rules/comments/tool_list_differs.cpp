// tool-list-differs: the head lists `(T08: BORING BAR)`, and the program calls T10, which the list does not have.
#include "findings/rule/rule.h"

#include "base/support/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

namespace feedhold::rules::tool_list_differs {
namespace {

constexpr std::size_t kLeastOfList = 2;

/// `3/4 EM`
bool hasLetter(std::string_view text) { return std::ranges::any_of(text, isLetter); }

/// The place of the number: behind `T`, `TOOL`, or the letter O of `TO1`, which stands for the digit 0.
std::size_t numberIn(std::string_view text) {
  const std::string head = toUpper(text.substr(0, 5));
  if (head.starts_with("TOOL"))
    return head.ends_with(' ') ? 5 : 4;
  return head.starts_with("TO") ? 2 : head.starts_with('T') ? 1 : std::string_view::npos;
}

/// `4`; of a lathe also with the number of its offset, `T0606`.
std::optional<std::int64_t> toolBy(std::string_view digits, const FileContext &context) {
  const bool hasOffset = digits.size() == 4 && context.dialect.machine == MachineKind::Turning;
  if (digits.empty() || (digits.size() > 2 && !hasOffset))
    return std::nullopt;
  std::int64_t number = 0;
  for (const char digit : digits.substr(0, 2))
    number = number * 10 + (digit - '0');
  return number > 0 ? std::optional(number) : std::nullopt;
}

/// `T08: BORING BAR`, `T4 - DRILL`, `TOOL 4 = FACE MILL`: a tool and what it is.
std::optional<std::int64_t> toolOf(std::string_view entry, const FileContext &context) {
  const std::string_view text = trimmed(entry);
  const std::size_t first = numberIn(text);
  if (first >= text.size())
    return std::nullopt;
  std::size_t at = first;
  while (at < text.size() && isDigit(text[at]))
    ++at;
  const std::size_t end = at;
  bool isSeparated = false;
  for (; at < text.size() && (isBlank(text[at]) || text[at] == ':' || text[at] == '-' || text[at] == '='); ++at)
    isSeparated = isSeparated || !isBlank(text[at]);
  const std::string_view name = text.substr(at);
  const bool isWord = first > 2; // `TOOL 10 MM` is a size, `TOOL 10 = DRILL` a tool
  const bool isNamed = at > end && !name.empty() &&
                       (isLetter(name.front()) || (isDigit(name.front()) && (isSeparated || hasLetter(name))));
  return isNamed && (!isWord || isSeparated) ? toolBy(text.substr(first, end - first), context) : std::nullopt;
}

/// `(T01 FACE MILL, T02 SPOT DRILL)`: the parts of a comment.
std::vector<std::string_view> entriesOf(std::string_view comment) {
  std::vector<std::string_view> entries;
  while (!comment.empty() && (comment.front() == '(' || comment.front() == ';'))
    comment.remove_prefix(1);
  for (;;) {
    const std::size_t comma = comment.find(',');
    entries.push_back(comment.substr(0, comma));
    if (comma == std::string_view::npos)
      return entries;
    comment.remove_prefix(comma + 1);
  }
}

/// The tool of a T word: of a lathe without the number of its offset.
std::optional<std::int64_t> toolOf(const Word &word, const FileContext &context) {
  const auto number = word.address() == 'T' ? word.integer() : std::nullopt;
  if (!number || *number <= 0)
    return std::nullopt;
  return context.dialect.machine == MachineKind::Turning && *number >= 100 ? *number / 100 : *number;
}

/// The comments above the first T word.
std::map<std::int64_t, const Comment *> listOf(const Program &program, const FileContext &context) {
  std::map<std::int64_t, const Comment *> list;
  for (BlockId block = program.first; block < program.last && !findWord(context.tree, block, 'T'); block = block.next())
    for (const Comment &comment : context.tree.commentsOf(block))
      for (const std::string_view entry : entriesOf(context.text(comment.span)))
        if (const auto tool = toolOf(entry, context))
          list.emplace(*tool, &comment);
  return list;
}

std::map<std::int64_t, const Word *> callsOf(const Program &program, const FileContext &context) {
  std::map<std::int64_t, const Word *> calls;
  for (BlockId block = program.first; block < program.last; block = block.next())
    for (const Word &word : context.tree.wordsOf(block))
      if (const auto tool = word.has(Word::kArgument) ? std::nullopt : toolOf(word, context))
        calls.emplace(*tool, &word);
  return calls;
}

template <typename Of, typename In> auto firstMissing(const Of &of, const In &in) {
  return std::ranges::find_if(of, [&](const auto &entry) { return !in.contains(entry.first); });
}

/// Every tool that the program calls is in the list, and there are several: the list is that of this program.
void tellUncalled(const Comment &listed, std::size_t common, std::size_t called, const FileContext &context,
                  const Reporter &reporter) {
  if (common < kLeastOfList || called != common)
    return;
  reporter.report({.message = fmt::format("{} is listed, and the program never calls it", context.quoted(listed.span)),
                   .span = listed.span,
                   .notes = {"an operation is missing, or the machine is set up with a tool that nobody needs",
                             "call the tool, or take it off the list"}});
}

/// `T#1`: any tool.
bool computesTools(const Program &program, const FileContext &context) {
  for (BlockId block = program.first; block < program.last; block = block.next())
    if (const Word *tool = findWord(context.tree, block, 'T'); tool && !tool->isNumber())
      return true;
  return false;
}

void tellUnlisted(const Word &call, const Comment &listed, const FileContext &context, const Reporter &reporter) {
  reporter.report(
      {.message = fmt::format("{} calls a tool that the list at the head does not have", context.quoted(call.span())),
       .span = call.span(),
       .labels = {{listed.span, "listed, and never called"}},
       .notes = {"who sets up the machine by the list puts another tool, or none, into this place",
                 "correct the list or the T word"}});
}

void check(ProgramId id, const FileContext &context, const Reporter &reporter) {
  if (!context.model.callsOf(id).empty()) // which may change tools
    return;
  const Program &program = context.model.programs[id];
  const auto list = listOf(program, context);
  const auto calls = callsOf(program, context);
  const auto uncalled = firstMissing(list, calls);
  if (uncalled == list.end() || calls.empty())
    return;
  const auto unlisted = firstMissing(calls, list);
  const auto common = std::ranges::count_if(list, [&](const auto &entry) { return calls.contains(entry.first); });
  const bool isOnly = list.size() == 1 && !computesTools(program, context);
  if (isOnly || (list.size() >= kLeastOfList && common > 0 && unlisted != calls.end()))
    return tellUnlisted(*unlisted->second, *uncalled->second, context, reporter);
  if (list.size() >= kLeastOfList)
    tellUncalled(*uncalled->second, static_cast<std::size_t>(common), calls.size(), context, reporter);
}

} // namespace

extern const Rule toolListDiffers;
const Rule toolListDiffers{.info = {"tool-list-differs", Category::Comment, Severity::Warning,
                                    "Reports a tool that the program calls and its list of tools does not have, and "
                                    "a listed one that is never called."},
                           .hooks = {.program = check}};

} // namespace feedhold::rules::tool_list_differs
