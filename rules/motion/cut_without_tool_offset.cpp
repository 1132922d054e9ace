// cut-without-tool-offset: `T0000` on a lathe, then a cut.
#include "rules/motion/tool_sections.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules::cut_without_tool_offset {
namespace {

/// `T0000`, `T00`: cancels the offset, and calls no tool.
bool cancelsOffset(const Word &word) { return word.integer() == 0U && !word.has(Word::kArgument); }

const Word *cutIn(BlockId block, const FileContext &context) {
  const Word *line = findAction(context.tree, block, context.dialect,
                                {CodeAction::Linear, CodeAction::ArcClockwise, CodeAction::ArcCounterclockwise,
                                 CodeAction::Thread, CodeAction::SideCycle});
  const Word *code = line ? line : findTurningCycle(context.tree, block, context.dialect);
  const bool moves = std::ranges::any_of(context.tree.wordsOf(block),
                                         [](const Word &word) { return axisOf(word.address()).has_value(); });
  return moves ? code : nullptr;
}

void tell(const Word &cancel, const Word &cut, const FileContext &context, const Reporter &reporter) {
  reporter.report({.message = fmt::format("{} cuts without a tool offset: {} has cancelled it",
                                          context.quoted(cut.span()), context.quoted(cancel.span())),
                   .span = cut.span(),
                   .labels = {{cancel.span(), "the offset is cancelled here"}},
                   .notes = {"the control moves the turret, not the tip of the tool, to the programmed point",
                             fmt::format("write the tool and its offset, such as `T0101`, in place of {}",
                                         context.quoted(cancel.span()))}});
}

/// The first cut behind each `T0000`.
void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.machine != MachineKind::Turning)
    return;
  const HiddenWork hidden(program, context);
  const Word *cancel = nullptr;
  const Program &its = context.model.programs[program];
  for (BlockId block = its.first; block < its.last; block = block.next()) {
    if (hidden.isIn(block) || findCode(context.tree, block, context.dialect, CodeRole::ProgramEnd) ||
        findCode(context.tree, block, context.dialect, CodeRole::Return))
      cancel = nullptr;
    if (const Word *tool = findWord(context.tree, block, 'T')) {
      cancel = cancelsOffset(*tool) && !hidden.isIn(block) ? tool : nullptr;
      continue; // moves of its own block lead away, or to where the next tool begins
    }
    const Word *cut = cancel ? cutIn(block, context) : nullptr;
    if (!cut)
      continue;
    tell(*cancel, *cut, context, reporter);
    cancel = nullptr;
  }
}

} // namespace

extern const Rule cutWithoutToolOffset;
const Rule cutWithoutToolOffset{.info = {"cut-without-tool-offset", Category::Motion, Severity::Warning,
                                         "Reports a cut on a lathe behind a `T0000`, before another tool is called."},
                                .hooks = {.program = check}};

} // namespace feedhold::rules::cut_without_tool_offset
