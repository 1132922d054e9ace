// What the remarks of a block say, for rules that compare them with its words.
#pragma once

#include "base/support/text.h"
#include "findings/rule/rule.h"

#include <algorithm>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace feedhold::rules {

/// All remarks of the block, in capitals.
inline std::string remarksOf(const FileContext &context, BlockId block) {
  std::string text;
  for (const Comment &comment : context.tree.commentsOf(block))
    text += toUpper(context.text(comment.span)) + " ";
  return text;
}

/// Those of the block and, behind the `;` that ends it, of its line.
inline std::vector<const Comment *> commentsOfLine(const FileContext &context, BlockId block) {
  std::vector<const Comment *> comments;
  for (const Comment &comment : context.tree.commentsOf(block))
    comments.push_back(&comment);
  const BlockId next = block.next();
  if (next.index() >= context.tree.blockCount() || !isEmpty(context.tree, next))
    return comments;
  const std::uint32_t line = context.source.lineOf(context.tree.blocks[block].begin);
  for (const Comment &comment : context.tree.commentsOf(next))
    if (context.source.lineOf(comment.span.begin) == line)
      comments.push_back(&comment);
  return comments;
}

inline bool saysAny(std::string_view remark, std::initializer_list<std::string_view> words) {
  return std::ranges::any_of(words, [&](std::string_view word) { return remark.find(word) != std::string_view::npos; });
}

/// The remark of a T word, in capitals, in the languages of the shops.
inline bool speaksOfBoringBar(std::string_view remark) {
  return saysAny(remark, {"BORING BAR", "BORING TOOL", "BORE BAR", "BARRA DE MANDRILAR", "BARRA DE MANDRINAR",
                          "BARRE D'ALESAGE", "BOHRSTANGE", "INNENDREH"});
}

/// `M00 (MEASURED: ) #150`: only blanks are between a remark and the place.
inline bool standsBehindRemark(const FileContext &context, Span place) {
  const BlockId block = context.tree.blockAt(place.begin);
  return std::ranges::any_of(context.tree.commentsOf(block), [&](const Comment &comment) {
    return comment.closed && comment.span.end <= place.begin &&
           trimmed(context.text({comment.span.end, place.begin})).empty();
  });
}

} // namespace feedhold::rules
