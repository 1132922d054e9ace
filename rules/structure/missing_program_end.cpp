// missing-program-end: a program that runs on into `%` or the next O word.
#include "findings/rule/rule.h"

#include "rules/structure/structure_view.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::missing_program_end {
namespace {

bool isClosedByPercent(const FileContext &context, BlockId last) {
  for (BlockId block = last.next(); block.index() < context.tree.blockCount(); block = block.next())
    if (context.tree.blocks[block].has(Block::kPercent))
      return true;
  return false;
}

constexpr int kMostBlocksOfSnippet = 5;

/// A few statements without motion, M codes, jumps and calls, that nobody calls: to be pasted into programs.
bool isSnippet(const FileContext &context, ProgramId id) {
  const Program &program = context.model.programs[id];
  if (context.callGraph.isCalled({context.file, id}) || !context.model.callsOf(id).empty() ||
      !context.model.jumpsOf(id).empty() || !context.model.loopsOf(id).empty())
    return false;
  int blocks = 0;
  for (BlockId block = program.first; block < program.last; block = block.next()) {
    if (!isRead(context.tree.blocks[block]) || !hasContent(context, block))
      continue;
    const auto words = context.tree.wordsOf(block);
    const bool acts = std::ranges::any_of(words, [](const Word &word) {
      return word.address() != 'N' && word.address() != 'O' && !word.has(Word::kAfterThen);
    });
    if (acts || context.tree.statementsOf(block).empty() || ++blocks > kMostBlocksOfSnippet)
      return false;
  }
  return blocks > 0;
}

/// A program without O word, as postprocessors write it, is no piece of one if it changes tools and moves them.
bool isWholeProgram(const FileContext &context, const Program &program) {
  bool changesTool = false;
  bool moves = false;
  for (BlockId block = program.first; block < program.last; block = block.next())
    for (const Word &word : context.tree.wordsOf(block)) {
      const Code *code = codeOf(word, context.dialect);
      changesTool = changesTool || (code && code->action == CodeAction::ToolChange);
      moves = moves || (changesTool && axisOf(word.address()));
    }
  return moves && context.dialect.grammar.sequenceJumps;
}

/// `G65 P9010 ..`, and behind it `O9010`: what calls it is a program, and runs on into it.
bool callsNext(const FileContext &context, ProgramId id) {
  return std::ranges::any_of(context.model.callsOf(id), [&](const Call &call) {
    return call.callee.number && id.next().index() < context.model.programs.size() &&
           context.model.programs[id.next()].name.number == call.callee.number;
  });
}

void check(ProgramId id, const FileContext &context, const Reporter &reporter) {
  const Program &program = context.model.programs[id];
  if (!isNamed(program) && !isWholeProgram(context, program) && !callsNext(context, id))
    return;
  const auto last = openEnd(context, id);
  if (!last || program.isEncrypted ||
      (context.dialect.grammar.percentEndsProgram && !program.within && isClosedByPercent(context, *last)) ||
      isStructureBroken(context, id))
    return;
  const bool maySkip = (context.tree.blocks[*last].flags & (Block::kSkip | Block::kSkipInside)) != 0;
  const std::string name = isNamed(program) ? fmt::format("`{}`", toString(program.name)) : "the program";
  reporter.report({.message = fmt::format("{} can run past its last block", name),
                   .span = context.tree.blocks[*last].span(),
                   .label = maySkip ? "with block skip on, the program does not end here" : "",
                   .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::EndOfRecord)),
                             "end a main program with M30, a subprogram or macro with M99"}},
                  isSnippet(context, id) ? Severity::Info : Severity::Warning);
}

} // namespace

extern const Rule missingProgramEnd;
const Rule missingProgramEnd{.info = {"missing-program-end", Category::Structure, Severity::Warning,
                                      "Reports a program that can run past its last block, because that is not `M02`, "
                                      "`M30`, `M99`, a jump or an alarm."},
                             .hooks = {.program = check}};

} // namespace feedhold::rules::missing_program_end
