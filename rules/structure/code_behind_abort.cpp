// code-behind-abort: `(abort, no air)`, and behind it `o<restore> call`.
#include "rules/structure/structure_view.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules::code_behind_abort {
namespace {

/// A call, or a code that does something: a `return` or `M2` behind the abort is belt and braces, and a dwell gives the
/// remark the time to be read.
bool doesSomething(BlockId block, const FileContext &context) {
  if (std::ranges::any_of(context.tree.statementsOf(block), [](const Statement &statement) {
        const auto *word = std::get_if<OWord>(&statement.node);
        return word && word->kind == OWordKind::Call;
      }))
    return true;
  return std::ranges::any_of(context.tree.wordsOf(block), [&](const Word &word) {
    const Code *code = word.isCode() ? codeOf(word, context.dialect) : nullptr;
    return code && code->role != CodeRole::ProgramEnd && code->role != CodeRole::Return &&
           code->role != CodeRole::ProgramStop && code->role != CodeRole::Dwell;
  });
}

void check(BlockId block, const FileContext &context, const Reporter &reporter) {
  if (!abortsProgram(context.source, context.tree, block, context.dialect))
    return;
  BlockId next = block.next();
  while (next.index() < context.tree.blockCount() && isEmpty(context.tree, next))
    next = next.next();
  if (next.index() >= context.tree.blockCount() || !doesSomething(next, context))
    return;
  const Span span = context.tree.blocks[next].span();
  reporter.report({.message = fmt::format("{} is never executed", context.quoted(span)),
                   .span = span,
                   .labels = {{context.tree.commentsOf(block).back().span, "the program ends here"}},
                   .notes = {"the control stops at this remark, and does not come to the block behind it",
                             "write the block before the remark"}});
}

} // namespace

extern const Rule codeBehindAbort;
const Rule codeBehindAbort{.info = {"code-behind-abort", Category::Structure, Severity::Warning,
                                    "Reports a call or a code directly behind `(abort, ..)`, which ends the program."},
                           .hooks = {.block = check}};

} // namespace feedhold::rules::code_behind_abort
