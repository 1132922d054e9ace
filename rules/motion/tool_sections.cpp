#include "rules/motion/tool_sections.h"

#include "base/support/text.h"

#include <algorithm>

namespace feedhold::rules {

std::vector<ToolSection> toolSectionsOf(ProgramId program, const FileContext &context) {
  const Program &its = context.model.programs[program];
  std::vector<ToolSection> sections;
  for (BlockId block = its.first; block < its.last; block = block.next())
    for (const Word &word : context.tree.wordsOf(block)) {
      const Code *code = codeOf(word, context.dialect);
      if (!code || code->action != CodeAction::ToolChange || (!sections.empty() && sections.back().first == block))
        continue;
      if (!sections.empty())
        sections.back().last = block;
      sections.push_back({&word, block, its.last});
    }
  return sections;
}

bool endsInProse(const FileContext &context, BlockId block) {
  const auto words = context.tree.wordsOf(block);
  const auto read = std::ranges::find_if(words, [](const Word &word) { return !word.isNumber(); });
  const bool isRead = std::ranges::all_of(context.tree.statementsOf(block), [](const Statement &statement) {
    return std::holds_alternative<BrokenStatement>(statement.node);
  });
  if (read == words.begin() || !isRead ||
      std::any_of(read, words.end(), [](const Word &word) { return word.form() != WordForm::Missing; }))
    return false;
  const auto comments = context.tree.commentsOf(block);
  bool hasLetter = false;
  for (std::uint32_t at = std::prev(read)->span().end; at < context.tree.blocks[block].end; ++at) {
    const char c = context.text({at, at + 1}).front();
    if (std::ranges::any_of(comments,
                            [&](const Comment &comment) { return comment.span.begin <= at && at < comment.span.end; }))
      continue;
    if (isDigit(c) || c == '#' || c == '=')
      return false;
    hasLetter = hasLetter || isLetter(c);
  }
  return hasLetter;
}

bool HiddenWork::isIn(BlockId block) const {
  const Block &its = context_.tree.blocks[block];
  return its.has(Block::kSkip) || its.has(Block::kSkipInside) ||
         (its.has(Block::kBroken) && !endsInProse(context_, block)) || targets_.contains(block) ||
         !context_.model.callsIn(block, block.next()).empty();
}

} // namespace feedhold::rules
