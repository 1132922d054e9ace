// Loop heads: the blocks at which `@INVARIANT` and `@VARIANT` may stand.
#include "language/contract/clauses.h"

#include <algorithm>

namespace feedhold {

std::vector<BlockId> jumpHeads(const ProgramModel &model) {
  std::vector<BlockId> heads;
  for (const Jump &jump : model.jumps)
    if (jump.target && *jump.target <= jump.block)
      heads.push_back(*jump.target);
  std::ranges::sort(heads);
  return heads;
}

bool isLoopHead(const ContractReading &reading, ProgramId program, BlockId block) {
  const ProgramModel &model = reading.model;
  if (!model.loopsIn(block, block.next()).empty())
    return true;
  for (const OWordUse &use : model.oWordsIn(block, block.next()))
    if (use.kind == OWordKind::While || use.kind == OWordKind::Do || use.kind == OWordKind::Repeat)
      return true;
  if (std::ranges::binary_search(reading.jumpHeads, block))
    return true;
  const bool isLabel = !model.sequenceNumbersIn(block, block.next()).empty();
  return isLabel &&
         std::ranges::any_of(model.jumpsOf(program), [](const Jump &jump) { return jump.computed.has_value(); });
}

} // namespace feedhold
