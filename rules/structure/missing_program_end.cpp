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

/// A program without O word, as postprocessors write it, is no piece of one if it changes to tools with numbers and
/// moves them.
bool isWholeProgram(const FileContext &context, const Program &program) {
  bool changesTool = false;
  bool moves = false;
  bool namesTool = false;
  for (BlockId block = program.first; block < program.last; block = block.next())
    for (const Word &word : context.tree.wordsOf(block)) {
      const Code *code = codeOf(word, context.dialect);
      changesTool = changesTool || (code && code->action == CodeAction::ToolChange);
      moves = moves || (changesTool && axisOf(word.address()));
      namesTool = namesTool || word.address() == 'T';
    }
  return moves && namesTool;
}

/// A file that LinuxCNC is to run, and neither one of subroutines nor a piece of one: it needs `M2` or a closing `%`,
/// where other controls stop at the end of the text.
bool isFileOfInterpreter(const FileContext &context, const Program &program) {
  constexpr int kWork = 8; // blocks with movements
  if (!context.dialect.grammar.oWords || context.model.programs.size() != 1)
    return false;
  int moves = 0;
  bool cuts = false;
  for (BlockId block = program.first; block < program.last; block = block.next()) {
    if (context.tree.blocks[block].has(Block::kBroken))
      return false;
    const auto words = context.tree.wordsOf(block);
    cuts = cuts || findAction(context.tree, block, context.dialect,
                              {CodeAction::Linear, CodeAction::ArcClockwise, CodeAction::ArcCounterclockwise});
    moves += std::ranges::any_of(words, [](const Word &word) { return axisOf(word.address()).has_value(); }) ? 1 : 0;
  }
  return cuts && moves >= kWork;
}

/// The call of a program that is not among the files: it may end the run by M30.
const Call *unseenCallIn(const FileContext &context, BlockId block) {
  const auto calls = context.model.callsIn(block, block.next());
  const auto found =
      std::ranges::find_if(calls, [&](const Call &call) { return !context.callGraph.callee(context.file, call); });
  return found == calls.end() ? nullptr : &*found;
}

/// Blocks before the first O word of a file that has programs with numbers: they belong to none of them.
enum class Head : std::uint8_t {
  No,      // a program
  RunsOn,  // into the first program
  Excerpt, // behind its `%` a control reads no further, or begins there
};

Head headOfFile(const FileContext &context, ProgramId id) {
  const Program &program = context.model.programs[id];
  if (id.index() != 0 || isNamed(program) || context.dialect.grammar.oWords ||
      id.next().index() >= context.model.programs.size() || !isNamed(context.model.programs[id.next()]))
    return Head::No;
  bool hasBegun = false;
  for (BlockId block = program.first; block < program.last; block = block.next()) {
    const Block &its = context.tree.blocks[block];
    if (hasBegun && its.has(Block::kPercent))
      return Head::Excerpt;
    if (its.has(Block::kBroken))
      return Head::No;
    hasBegun = hasBegun || hasContent(context, block);
  }
  return Head::RunsOn;
}

/// What separates it from the next one is an O or a colon without a number, which is told there.
bool endsAtBrokenNumber(const FileContext &context, ProgramId id) {
  return id.next().index() < context.model.programs.size() && !isNamed(context.model.programs[id.next()]);
}

void tellHead(BlockId last, ProgramId id, const FileContext &context, const Reporter &reporter) {
  const std::string next = toString(context.model.programs[id.next()].name);
  reporter.report({.message = fmt::format("the blocks before `{}` have no program number, and run on into it", next),
                   .span = context.tree.blocks[last].span(),
                   .notes = {"a control gives them the number of the next program, or refuses the file",
                             "write an O word before them, and M30 or M99 behind them"}},
                  Severity::Warning);
}

void check(ProgramId id, const FileContext &context, const Reporter &reporter) {
  const Program &program = context.model.programs[id];
  if (const Head head = headOfFile(context, id); head != Head::No) {
    if (const auto last = openEnd(context, id); last && head == Head::RunsOn && !program.isEncrypted)
      tellHead(*last, id, context, reporter);
    return;
  }
  if (!isNamed(program) && !isWholeProgram(context, program) && !isFileOfInterpreter(context, program))
    return;
  const auto last = openEnd(context, id);
  if (!last || program.isEncrypted || endsAtBrokenNumber(context, id) ||
      (context.dialect.grammar.percentEndsProgram && !program.within && isClosedByPercent(context, *last)) ||
      isStructureBroken(context, id))
    return;
  const bool mayEnd = unseenCallIn(context, *last) != nullptr;
  const bool maySkip = (context.tree.blocks[*last].flags & (Block::kSkip | Block::kSkipInside)) != 0;
  const std::string name = isNamed(program) ? fmt::format("`{}`", toString(program.name)) : "the program";
  reporter.report(
      {.message = fmt::format("{} can run past its last block", name),
       .span = context.tree.blocks[*last].span(),
       .label = maySkip  ? "with block skip on, the program does not end here"
                : mayEnd ? "unless this program, which is not in the files, ends the run"
                         : "",
       .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::EndOfRecord)),
                 context.dialect.grammar.oWords ? "end the file with M2, or write `%` before and behind it"
                                                : "end a main program with M30, a subprogram or macro with M99"}},
      isSnippet(context, id) || mayEnd ? Severity::Info : Severity::Warning);
}

} // namespace

extern const Rule missingProgramEnd;
const Rule missingProgramEnd{.info = {"missing-program-end", Category::Structure, Severity::Warning,
                                      "Reports a program that can run past its last block, because that is not `M02`, "
                                      "`M30`, `M99`, a jump or an alarm."},
                             .hooks = {.program = check}};

} // namespace feedhold::rules::missing_program_end
