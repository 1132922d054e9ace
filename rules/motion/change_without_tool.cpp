// change-without-tool: `T5 M06` .. cuts .. `M06 M09 M30`, and no T between the two M06.
#include "rules/motion/tool_sections.h"

#include <algorithm>
#include <fmt/format.h>
#include <optional>

namespace feedhold::rules::change_without_tool {
namespace {

/// By T, or by the Q of an M61.
bool namesTool(const FileContext &context, BlockId block) {
  return std::ranges::any_of(context.tree.wordsOf(block),
                             [](const Word &word) { return word.address() == 'T' || word.address() == 'Q'; });
}

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.machine != MachineKind::Milling)
    return;
  const HiddenWork hidden(program, context);
  const Program &its = context.model.programs[program];
  const Word *before = nullptr; // an M06 behind which no T has come
  for (BlockId block = its.first; block < its.last; block = block.next()) {
    const Word *change = findAction(context.tree, block, context.dialect, {CodeAction::ToolChange});
    const bool isKnown = !hidden.isIn(block) && !namesTool(context, block);
    if (change && before && isKnown)
      reporter.report({.message = fmt::format("{} changes to no tool: no T stands behind the last tool change",
                                              context.quoted(change->span())),
                       .span = change->span(),
                       .labels = {{before->span(), "the last tool change"}},
                       .notes = {"the control stops, or changes to the tool that is in the spindle",
                                 "write the T word; M05 stops the spindle"}});
    if (change)
      before = change;
    else if (!isKnown)
      before = nullptr;
  }
}

} // namespace

extern const Rule changeWithoutTool;
const Rule changeWithoutTool{.info = {"change-without-tool", Category::Motion, Severity::Warning,
                                      "Reports an M06 behind another one without a T word between them."},
                             .hooks = {.program = check}};

} // namespace feedhold::rules::change_without_tool
