// What a program does with each of its tools: the blocks from one tool change to the next.
#pragma once

#include "findings/rule/rule.h"

#include <set>
#include <vector>

namespace feedhold::rules {

struct ToolSection {
  const Word *change; // the code
  BlockId first;      // its block
  BlockId last;       // behind the section
};
/// In order of the text; what stands before the first tool change is in none.
std::vector<ToolSection> toolSectionsOf(ProgramId program, const FileContext &context);

/// The block could not be read to its end, and behind its last word only prose stands: `X1. next pass`.
bool endsInProse(const FileContext &context, BlockId block);

/// Blocks of a program that are not executed each time as they stand, or that execute more than they show.
class HiddenWork {
public:
  HiddenWork(ProgramId program, const FileContext &context)
      : context_(context), targets_(context.model.jumpTargetsOf(program)) {}
  /// Skipped, not read, the target of a jump, or a call.
  bool isIn(BlockId block) const;

private:
  const FileContext &context_;
  std::set<BlockId> targets_;
};

} // namespace feedhold::rules
