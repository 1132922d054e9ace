// What the remarks of a block say, for rules that compare them with its words.
#pragma once

#include "base/support/text.h"
#include "findings/rule/rule.h"

#include <algorithm>
#include <initializer_list>
#include <string>
#include <string_view>

namespace feedhold::rules {

/// All remarks of the block, in capitals.
inline std::string remarksOf(const FileContext &context, BlockId block) {
  std::string text;
  for (const Comment &comment : context.tree.commentsOf(block))
    text += toUpper(context.text(comment.span)) + " ";
  return text;
}

inline bool saysAny(std::string_view remark, std::initializer_list<std::string_view> words) {
  return std::ranges::any_of(words, [&](std::string_view word) { return remark.find(word) != std::string_view::npos; });
}

} // namespace feedhold::rules
