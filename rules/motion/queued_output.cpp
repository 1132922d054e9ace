// See the header.
#include "rules/motion/queued_output.h"

namespace feedhold::rules {
namespace {

const Word *codeIn(BlockId block, const FileContext &context, std::uint16_t first, std::uint16_t last) {
  if (!context.dialect.grammar.oWords)
    return nullptr;
  for (const Word &word : context.tree.wordsOf(block))
    if (const auto tenths = word.isCode() && word.address() == 'M' ? word.tenths() : std::nullopt;
        tenths && *tenths >= first && *tenths <= last)
      return &word;
  return nullptr;
}

} // namespace

std::optional<OutputCode> outputIn(BlockId block, const FileContext &context) {
  const Word *code = codeIn(block, context, 620, 650);
  const Word *pin = code ? findWord(context.tree, block, 'P') : nullptr;
  if (!pin)
    return std::nullopt;
  const auto tenths = *code->tenths();
  return OutputCode{code, pin, tenths == 620 || tenths == 640, tenths < 640};
}

const Word *waitIn(BlockId block, const FileContext &context) {
  const Word *code = codeIn(block, context, 660, 660);
  const Word *mode = code ? findWord(context.tree, block, 'L') : nullptr;
  const auto how = mode ? mode->integer() : std::nullopt;
  return how && *how >= 1 && *how <= 4 ? code : nullptr;
}

} // namespace feedhold::rules
