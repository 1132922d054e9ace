// print: the text of a tree, put together from its pieces.
#include "base/support/text.h"
#include "language/lex/lexer.h"
#include "language/syntax/tree.h"

#include <algorithm>

namespace feedhold {

namespace {

/// The spans of everything in a block, in order of place.
std::vector<Span> piecesOf(const SyntaxTree &tree, BlockId block, std::span<const Span> skips, std::string_view text) {
  std::vector<Span> pieces(skips.begin(), skips.end());
  if (tree.blocks[block].has(Block::kPercent)) {
    const auto mark = static_cast<std::uint32_t>(text.find('%', tree.blocks[block].begin));
    pieces.push_back({mark, mark + 1});
  }
  for (const Word &word : tree.wordsOf(block))
    pieces.push_back(word.span());
  for (const Comment &comment : tree.commentsOf(block))
    pieces.push_back(comment.span);
  for (const Statement &statement : tree.statementsOf(block))
    pieces.push_back(statement.span);
  std::sort(pieces.begin(), pieces.end());
  return pieces;
}

/// Blanks and ends of blocks: all that may stand between the pieces.
bool isBetween(char c) { return isTrivia(c) || c == '\n' || c == '\r' || c == ';'; }

} // namespace

std::string print(const SyntaxTree &tree, const SourceFile &source) {
  const std::string_view text = source.text();
  std::string out;
  out.reserve(text.size());
  std::uint32_t at = 0;
  if (text.starts_with("\xEF\xBB\xBF")) {
    out += text.substr(0, 3);
    at = 3;
  }
  const auto copyBetween = [&](std::uint32_t end) {
    for (; at < end; ++at)
      if (isBetween(text[at]))
        out += text[at];
  };
  std::size_t nextSkip = 0;
  for (std::size_t i = 0; i < tree.blockCount(); ++i) {
    const BlockId block(i);
    const std::size_t firstSkip = nextSkip;
    while (nextSkip < tree.skips.size() && tree.skips[nextSkip].begin < tree.blocks[block].end)
      ++nextSkip;
    const std::span<const Span> skips(tree.skips.data() + firstSkip, nextSkip - firstSkip);
    for (const Span piece : piecesOf(tree, block, skips, text)) {
      copyBetween(piece.begin);
      if (piece.end > at) {
        out += text.substr(std::max(at, piece.begin), piece.end - std::max(at, piece.begin));
        at = piece.end;
      }
    }
    copyBetween(tree.blocks[block.next()].begin);
  }
  copyBetween(static_cast<std::uint32_t>(text.size()));
  return out;
}

} // namespace feedhold
