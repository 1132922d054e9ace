// empty-subprogram: `M98 P100`, and O100 holds nothing but `M99`.
#include "findings/rule/rule.h"

#include "rules/structure/structure_view.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules::empty_subprogram {
namespace {

/// The block does nothing but begin or end the program, or name itself.
bool isBare(const FileContext &context, BlockId block) {
  if (!isRead(context.tree.blocks[block]))
    return true;
  const bool isEnd = findCode(context.tree, block, context.dialect, CodeRole::Return) ||
                     context.tree.blocks[block].has(Block::kPercent);
  const auto words = context.tree.wordsOf(block);
  const bool hasWords = std::ranges::any_of(
      words, [](const Word &word) { return word.address() != 'O' && word.address() != 'N' && word.address() != 'M'; });
  return !context.tree.blocks[block].has(Block::kBroken) && context.tree.statementsOf(block).empty() && !hasWords &&
         (isEnd || !hasContent(context, block));
}

void check(ProgramId id, const FileContext &context, const Reporter &reporter) {
  const Program &program = context.model.programs[id];
  if (!isNamed(program) || program.isEncrypted || program.name.isSubroutine || !program.returns)
    return;
  for (BlockId block = program.first; block < program.last; block = block.next())
    if (!isBare(context, block))
      return;
  for (const auto &caller : context.callGraph.callers({context.file, id})) {
    const Call &call = context.callGraph.model(caller.file).calls[caller.call];
    reporter.report({.message = fmt::format("{} is called, but holds nothing", context.quoted(program.header)),
                     .span = program.header,
                     .labels = {{call.span, "called here", caller.file}},
                     .notes = {"the call does nothing: the work of this program is missing",
                               "write its blocks, or delete the call"}},
                    caller.file == context.file ? Severity::Warning : Severity::Info);
    return;
  }
}

} // namespace

extern const Rule emptySubprogram;
const Rule emptySubprogram{.info = {"empty-subprogram", Category::Structure, Severity::Warning,
                                    "Reports a subprogram that is called and holds nothing but its `M99`."},
                           .hooks = {.program = check}};

} // namespace feedhold::rules::empty_subprogram
