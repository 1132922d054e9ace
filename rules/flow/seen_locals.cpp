// See the header.
#include "rules/flow/seen_locals.h"

#include <algorithm>

namespace feedhold::rules {

bool seesLocals(const FlowFacts &facts) {
  const ProgramFile &file = facts.file;
  for (const Call &call : file.model->callsOf(facts.program))
    if (call.kind != CallKind::Macro && call.kind != CallKind::Modal && call.kind != CallKind::ModalCancel &&
        call.kind != CallKind::Local)
      return false;
  for (const BlockId block : blocksOf(file, facts.program))
    if (file.tree->blocks[block].has(Block::kBroken))
      return false;
  return std::ranges::all_of(file.model->variablesOf(facts.program), [&](const VariableUse &use) {
    return use.write || use.number || !as<IndirectVariable>(*file.tree, use.expression) ||
           readsOf(file, use.block).size() > 1;
  });
}

} // namespace feedhold::rules
