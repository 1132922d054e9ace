// What the words of a block belong to; see the header.
#include "rules/words/block_words.h"

#include <algorithm>

namespace feedhold::rules {
namespace {

bool isMacroCall(CodeRole role) {
  return role == CodeRole::MacroCall || role == CodeRole::ModalCall || role == CodeRole::ModalCallEach;
}

bool isCodeCall(const Word &word, const FileContext &context) {
  const auto tenths = word.isNumber() ? word.tenths() : std::nullopt;
  return tenths && findCodeCall(context.dialect, word.address(), *tenths);
}

bool passesArguments(const Word &word, const FileContext &context) {
  const Code *code = codeOf(word, context.dialect);
  return (code && isMacroCall(code->role)) || isCodeCall(word, context);
}

} // namespace

bool passesArguments(const FileContext &context, BlockId block) {
  const auto words = context.tree.wordsOf(block);
  return std::any_of(words.begin(), words.end(), [&](const Word &word) { return passesArguments(word, context); });
}

bool meansOwnWords(const Word &word, const FileContext &context) {
  if (isCodeCall(word, context))
    return true;
  if (!word.isCode())
    return false;
  const Code *code = codeOf(word, context.dialect);
  return !code || isMacroCall(code->role) || code->role == CodeRole::DataSetting || code->role == CodeRole::OwnWords;
}

bool meansOwnWords(const FileContext &context, BlockId block) {
  const auto words = context.tree.wordsOf(block);
  return std::any_of(words.begin(), words.end(), [&](const Word &word) { return meansOwnWords(word, context); });
}

} // namespace feedhold::rules
