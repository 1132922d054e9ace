#include "rules/motion/tool_sections.h"

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

bool HiddenWork::isIn(BlockId block) const {
  const Block &its = context_.tree.blocks[block];
  return its.has(Block::kSkip) || its.has(Block::kSkipInside) || its.has(Block::kBroken) || targets_.contains(block) ||
         !context_.model.callsIn(block, block.next()).empty();
}

} // namespace feedhold::rules
