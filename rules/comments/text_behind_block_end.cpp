// text-behind-block-end: `N540 T5 M06; ???` among blocks that end with `;`.
#include "findings/rule/rule.h"

#include "base/support/text.h"
#include "language/dialect/comment_signals.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace feedhold::rules::text_behind_block_end {
namespace {

constexpr std::size_t kFewestEnds = 10; // blocks with nothing behind their `;`
constexpr std::size_t kEndsToText = 5;  // so many for each block with text

/// What stands behind the `;`, remarks in parentheses apart: its first piece.
Span pieceBehind(Span comment, std::string_view source) {
  std::uint32_t at = comment.begin + 1;
  while (at < comment.end && (isBlank(source[at]) || source[at] == ';' || source[at] == '('))
    at += source[at] == '(' ? static_cast<std::uint32_t>(commentLength(source.substr(at, comment.end - at))) : 1;
  const std::uint32_t end =
      std::min<std::uint32_t>(comment.end, static_cast<std::uint32_t>(std::min(source.find('(', at), source.size())));
  const std::string_view piece = trimmed(source.substr(at, end - std::min(at, end)));
  return {at, at + static_cast<std::uint32_t>(piece.size())};
}

void check(const FileContext &context, const Reporter &reporter) {
  const std::string_view source = context.source.text();
  std::size_t ends = 0;
  std::vector<Span> pieces;
  for (BlockId block(0); block.index() < context.tree.blockCount(); block = block.next()) {
    const bool hasWords = !context.tree.wordsOf(block).empty();
    for (const Comment &comment : context.tree.commentsOf(block))
      if (source[comment.span.begin] == ';' && hasWords) {
        const Span piece = pieceBehind(comment.span, source);
        if (piece.size() == 0)
          ++ends;
        else
          pieces.push_back(piece);
      }
  }
  if (pieces.empty() || ends < kFewestEnds || ends < pieces.size() * kEndsToText)
    return;
  Diagnostic diagnostic{
      .message = fmt::format("{} stands behind the `;` of its block{}", context.quoted(pieces.front()),
                             pieces.size() > 1 ? fmt::format(" (the first of {} such texts)", pieces.size()) : ""),
      .span = pieces.front(),
      .notes = {"blocks end with `;` here: what follows is a block of its own, and the control stops at text",
                "delete it, or put it in parentheses"}};
  for (std::size_t i = 1; i < std::min<std::size_t>(pieces.size(), 4); ++i)
    diagnostic.labels.push_back({pieces[i], "here, too"});
  reporter.report(std::move(diagnostic));
}

} // namespace

extern const Rule textBehindBlockEnd;
const Rule textBehindBlockEnd{
    .info = {"text-behind-block-end", Category::Comment, Severity::Warning,
             "Reports text behind the `;` of a block in a program that ends its blocks with `;`."},
    .hooks = {.file = check}};

} // namespace feedhold::rules::text_behind_block_end
