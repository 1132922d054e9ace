// What the words of a block belong to, before a rule takes them for coordinates or codes; see block_facts.h.
#pragma once

#include "findings/rule/rule.h"
#include "language/model/block_facts.h"

namespace feedhold::rules {

inline bool passesArguments(const FileContext &context, BlockId block) {
  return feedhold::passesArguments(context.tree, block, context.dialect);
}
inline bool meansOwnWords(const FileContext &context, BlockId block) {
  return feedhold::meansOwnWords(context.tree, block, context.dialect);
}
inline bool meansOwnWords(const Word &word, const FileContext &context) {
  return feedhold::meansOwnWords(word, context.dialect);
}

} // namespace feedhold::rules
