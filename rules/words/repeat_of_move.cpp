// repeat-of-move: `G03 I-10. Z1. L5`.
#include "rules/words/block_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace feedhold::rules::repeat_of_move {
namespace {

const Word *motionOf(const FileContext &context, BlockId block) {
  const Word *arc = findCode(context.tree, block, context.dialect, CodeRole::Arc);
  return arc ? arc : findCode(context.tree, block, context.dialect, CodeRole::Motion);
}

/// A cycle, a call or data beside it takes the word, as does a spiral with Q, or a code that the control has by option.
bool isTaken(const FileContext &context, BlockId block) {
  return !context.model.callsIn(block, block.next()).empty() || meansOwnWords(context, block) ||
         std::ranges::any_of(context.tree.wordsOf(block), [&](const Word &word) {
           const Code *code = codeOf(word, context.dialect);
           return (code && code->role != CodeRole::Plain && code->role != CodeRole::Arc &&
                   code->role != CodeRole::Motion) ||
                  (word.isCode() && !code) || std::string_view("PQ").find(word.address()) != std::string_view::npos;
         });
}

void check(BlockId block, const FileContext &context, const Reporter &reporter) {
  const Word *repeats = findWord(context.tree, block, 'L');
  const Block &its = context.tree.blocks[block];
  if (!repeats || its.has(Block::kData) || its.has(Block::kBroken) || isTaken(context, block))
    return;
  const Word *motion = motionOf(context, block);
  if (!motion)
    return;
  const auto &behaviour = context.dialect.behaviour;
  // A control that repeats cycles by L alone: its manual names cycles and calls, but its users repeat helices as well.
  const bool isCustomary = !behaviour.repeatsByK && !behaviour.stopsAtStrayWords;
  reporter.report(
      {.message = fmt::format("{} {} repeat {}", context.quoted(repeats->span()), isCustomary ? "may not" : "does not",
                              context.quoted(motion->span())),
       .span = repeats->span(),
       .labels = {{motion->span(), isCustomary ? "the move" : "moves once"}},
       .notes = {isCustomary
                     ? "the manual of the control names L for canned cycles and calls only; whether it repeats a "
                       "move depends on the software"
                     : "L repeats canned cycles and calls; a move is executed once, or the control stops",
                 "program the move in a WHILE loop, or in a subprogram that is called with L"}},
      isCustomary ? Severity::Info : Severity::Warning);
}

} // namespace

extern const Rule repeatOfMove;
const Rule repeatOfMove{.info = {"repeat-of-move", Category::Word, Severity::Warning,
                                 "Reports `L` in a block with `G00`, `G01`, `G02` or `G03`, which it does not repeat."},
                        .hooks = {.block = check}};

} // namespace feedhold::rules::repeat_of_move
