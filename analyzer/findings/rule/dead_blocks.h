// Blocks of a program that are never executed, by the text alone.
#pragma once

#include "findings/rule/rule.h"

#include <span>
#include <unordered_map>
#include <vector>

namespace feedhold {

/// The control reads the block: it is neither tape mark nor leader nor text behind the end.
bool isRead(const Block &block);

/// Words other than its sequence number and the head of a program, or a statement: something happens in the block.
bool hasContent(const FileContext &context, BlockId block);

/// Control never reaches the block behind this one.
bool leavesForGood(const FileContext &context, BlockId block);

/// Blocks to which neither the block before them nor a jump leads that is itself executed.
class DeadBlocks {
public:
  DeadBlocks(const FileContext &context, ProgramId program);

  bool contains(BlockId block) const;
  /// Runs of dead blocks with content; `ender` is the block that control leaves for good before each.
  struct Run {
    BlockId ender;
    BlockId first;
    BlockId last; // inclusive
  };
  std::span<const Run> runs() const { return runs_; }

private:
  std::vector<Run> runs_;
};

/// Whether a block is never executed: what is wrong in it stops no control, and that it is dead is reported.
class NeverExecuted {
public:
  explicit NeverExecuted(const FileContext &context) : context_(context) {}
  bool contains(BlockId block);

private:
  const FileContext &context_;
  std::unordered_map<std::uint32_t, DeadBlocks> dead_; // by program
};

} // namespace feedhold
