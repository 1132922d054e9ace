// thread-at-constant-surface-speed: G76 under G96.
#include "rules/motion/turning_walk.h"

#include <fmt/format.h>

namespace feedhold::rules::thread_at_constant_surface_speed {
namespace {

void tell(const Word &thread, const Word &speed, const FileContext &context, const Reporter &reporter) {
  reporter.report({.message = fmt::format("{} cuts a thread at constant surface speed", context.quoted(thread.span())),
                   .span = thread.span(),
                   .labels = {{speed.span(), "constant surface speed from here"}},
                   .notes = {"the spindle speed changes with the diameter from pass to pass, and the thread starts at "
                             "another angle each time",
                             "program `G97` and the speed in revolutions per minute before the thread"}});
}

/// `G92 S3000` limits the speed, in other G code systems.
bool namesEnd(const SyntaxTree &tree, BlockId block) {
  return findWord(tree, block, 'X') || findWord(tree, block, 'Z') || findWord(tree, block, 'U') ||
         findWord(tree, block, 'W');
}

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.machine != MachineKind::Turning)
    return;
  const Word *constant = nullptr;
  const Program &its = context.model.programs[program];
  for (BlockId block = its.first; block < its.last; block = block.next()) {
    const auto calls = context.model.callsIn(block, block.next());
    if (!calls.empty() || context.tree.blocks[block].has(Block::kSkip))
      constant = nullptr;
    for (const Word &word : context.tree.wordsOf(block)) {
      const Code *code = codeOf(word, context.dialect);
      if (!code)
        continue;
      if (code->action == CodeAction::ConstantSurface)
        constant = &word;
      else if (code->action == CodeAction::ConstantSpeed)
        constant = nullptr;
      else if (constant && cutsThread(*code) && namesEnd(context.tree, block)) {
        tell(word, *constant, context, reporter);
        constant = nullptr; // once for each G96
      }
    }
  }
}

} // namespace

extern const Rule threadAtConstantSurfaceSpeed;
const Rule threadAtConstantSurfaceSpeed{.info = {"thread-at-constant-surface-speed", Category::Motion,
                                                 Severity::Warning,
                                                 "Reports a thread that a lathe cuts while `G96` is active."},
                                        .hooks = {.program = check}};

} // namespace feedhold::rules::thread_at_constant_surface_speed
