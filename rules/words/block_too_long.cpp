// block-too-long: thousands of words without an end of block.
#include "findings/rule/rule.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::block_too_long {
namespace {

void check(const SyntaxIssue &issue, const FileContext &, const Reporter &reporter) {
  reporter.report({.message = "this block has more words than any control reads",
                   .span = issue.span,
                   .label = "reading stopped here",
                   .notes = {"the line ends of the file are probably lost; the rest of this block is not checked"}});
}

/// LinuxCNC reads a line, its remarks included, into a buffer.
void checkLines(const FileContext &context, const Reporter &reporter) {
  const std::size_t most = context.dialect.limits.lineLength;
  if (most == 0)
    return;
  const std::string_view text = context.source.text();
  for (std::size_t begin = 0, end = 0; begin < text.size(); begin = end + 1) {
    end = std::min(text.find('\n', begin), text.size());
    const std::size_t length = end - begin - (end > begin && text[end - 1] == '\r' ? 1 : 0);
    if (length <= most ||
        context.tree.blocks[context.tree.blockAt(static_cast<std::uint32_t>(begin))].has(Block::kAfterEnd))
      continue;
    const auto cut = static_cast<std::uint32_t>(begin + most);
    return reporter.report(
        {.message = fmt::format("this line has {} characters, and the control reads {}", length, most),
         .span = {cut, static_cast<std::uint32_t>(begin + length)},
         .label = "too much",
         .notes = {"the control stops with an error: command too long", "shorten or split the line"}});
  }
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::BlockTooLong};

} // namespace

extern const Rule blockTooLong;
const Rule blockTooLong{.info = {"block-too-long", Category::Syntax, Severity::Error,
                                 "Reports a block of thousands of words, as in a file that has lost its line ends, and "
                                 "a line that is too long for the control."},
                        .hooks = {.issue = check, .issueKinds = kIssues, .file = checkLines}};

} // namespace feedhold::rules::block_too_long
