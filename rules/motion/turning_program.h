// The blocks of a program of a lathe, one after the other as the text has them.
#pragma once

#include "rules/motion/turning_walk.h"

namespace feedhold::rules {

/// What `.program` of a rule is: a Reader(program, context) gets each block by read(block, reporter), and
/// finish(reporter) if it declares one.
template <typename Reader>
void readTurningProgram(ProgramId program, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.machine != MachineKind::Turning)
    return;
  Reader reader(program, context);
  const Program &its = context.model.programs[program];
  for (BlockId block = its.first; block < its.last; block = block.next())
    reader.read(block, reporter);
  if constexpr (requires { reader.finish(reporter); })
    reader.finish(reporter);
}

/// Calls visit(block, start, walk) for each block in which a cycle moves the tool.
template <typename Visit> void forEachTurningCycle(ProgramId program, const FileContext &context, Visit &&visit) {
  if (context.dialect.machine != MachineKind::Turning)
    return;
  TurningWalk walk(program, context);
  const Program &its = context.model.programs[program];
  for (BlockId block = its.first; block < its.last; block = block.next()) {
    const TurningPoint start = walk.at();
    if (walk.read(block) == TurningMove::Cycle)
      visit(block, start, walk);
  }
}

} // namespace feedhold::rules
