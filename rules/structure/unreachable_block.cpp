// unreachable-block: blocks behind a GOTO, M99 or M30 that no jump leads to.
#include "findings/rule/rule.h"

#include "rules/structure/structure_view.h"

#include <algorithm>
#include <fmt/format.h>
#include <optional>
#include <vector>

namespace feedhold::rules::unreachable_block {
namespace {

/// The block that jumps were to lead to, if it raises an alarm.
bool isAlarm(BlockId block, const FileContext &context) {
  return std::ranges::any_of(context.model.variablesIn(block, block.next()), [&](const VariableUse &use) {
    return use.write && use.number && raisesAlarm(context.dialect, *use.number);
  });
}

/// `#3000=1(..)`, then M00 or M30 behind it: a belt beside the braces.  A label between them shows that the block was
/// meant to be reached, and so does an alarm behind a block that raises none.
bool isSecondEnd(BlockId block, BlockId ender, const FileContext &context) {
  const FlowAfter flow = flowAfter(context.tree, block, context.dialect);
  return !findWord(context.tree, block, 'N') && (isAlarm(ender, context) || !isAlarm(block, context)) &&
         (!hasContent(context, block) || flow == FlowAfter::Ends || flow == FlowAfter::Jumps ||
          findCode(context.tree, block, context.dialect, CodeRole::ProgramStop));
}

/// The first block of the run that is more than a second end of what ended before.
std::optional<BlockId> firstUnintended(const DeadBlocks::Run &run, const FileContext &context) {
  if (flowAfter(context.tree, run.ender, context.dialect) != FlowAfter::Ends)
    return run.first;
  BlockId block = run.ender.next();
  while (block <= run.last && (!isRead(context.tree.blocks[block]) || isSecondEnd(block, run.ender, context)))
    block = block.next();
  return block <= run.last ? std::optional(block) : std::nullopt;
}

/// A block behind a label to which no jump leads, and that tells the operator what is wrong.
struct DeadMessage {
  BlockId block;
  bool isAlarm; // else a stop with a remark
};

/// `M05`, `M09`, `G04`: what is done before an alarm is told.
bool preparesAlarm(BlockId block, const FileContext &context) {
  const auto words = context.tree.wordsOf(block);
  return context.tree.statementsOf(block).empty() && std::ranges::all_of(words, [&](const Word &word) {
           return word.address() == 'N' || word.address() == 'M' ||
                  (word.address() == 'G' && (word.integer() == 4 || word.integer() == 80)) || word.address() == 'X' ||
                  word.address() == 'P';
         });
}

/// `IF[#1005EQ0]GOTO99`: asks before the alarm is told.
bool asksBeforeAlarm(BlockId block, const FileContext &context) {
  const auto statements = context.tree.statementsOf(block);
  const auto isQuestion = [](const Statement &statement) {
    const auto *branch = std::get_if<If>(&statement.node);
    return statement.nested || (branch && branch->action == IfAction::Jump);
  };
  const bool isAlone =
      std::ranges::all_of(context.tree.wordsOf(block), [](const Word &word) { return word.address() == 'N'; });
  return !statements.empty() && isAlone && std::ranges::all_of(statements, isQuestion);
}

/// `N801`, `M09`, `#3000=1(LOW BATTERY)`; `N910 M01(NO MATERIAL)`.
std::optional<DeadMessage> messageOf(const DeadBlocks::Run &run, BlockId start, const FileContext &context) {
  bool hasLabel = false;
  for (BlockId block = run.ender.next(); block <= run.last; block = block.next()) {
    hasLabel = hasLabel || findWord(context.tree, block, 'N');
    if (block < start || !isRead(context.tree.blocks[block]) || !hasContent(context, block))
      continue;
    if (!hasLabel)
      return std::nullopt;
    if (isAlarm(block, context))
      return DeadMessage{block, true};
    const auto comments = context.tree.commentsOf(block);
    if (findCode(context.tree, block, context.dialect, CodeRole::ProgramStop) && !comments.empty())
      return DeadMessage{block, false};
    if (!preparesAlarm(block, context) && !asksBeforeAlarm(block, context))
      return std::nullopt;
  }
  return std::nullopt;
}

void reportMessage(const DeadMessage &message, BlockId ender, const FileContext &context, const Reporter &reporter) {
  reporter.report({.message = message.isAlarm ? "this alarm is never raised: no jump leads to it"
                                              : "this stop is never reached: no jump leads to it",
                   .span = context.tree.blocks[message.block].span(),
                   .labels = {{context.tree.blocks[ender].span(), "the program never continues past this block"}},
                   .notes = {"the check that should lead here is missing, or its GOTO names another block"}},
                  Severity::Warning);
}

/// The code of a machine builder, or a program that is not there: how it ends is not known.
bool callsUnseen(BlockId block, const FileContext &context) {
  const auto calls = context.model.callsIn(block, block.next());
  if (!calls.empty())
    return std::ranges::any_of(calls, [&](const Call &call) { return !context.callGraph.callee(context.file, call); });
  return std::ranges::any_of(context.tree.wordsOf(block), [&](const Word &word) {
    const auto tenths = word.isCode() ? word.tenths() : std::nullopt;
    return tenths && mayDoAnything(context.dialect, word.address(), *tenths);
  });
}

/// `G229 T910` and `N910` in the run: the program that is called may return there, by `M99 P#20`.
bool isNamedToUnseen(const DeadBlocks::Run &run, ProgramId program, const FileContext &context) {
  std::vector<Decimal> numbers;
  for (BlockId block = run.ender.next(); block <= run.last; block = block.next())
    if (const Word *number = findWord(context.tree, block, 'N'); number && number->isNumber())
      numbers.push_back(number->number());
  if (numbers.empty())
    return false;
  const Program &whole = context.model.programs[program];
  for (BlockId block = whole.first; block < whole.last; block = block.next())
    if (callsUnseen(block, context))
      for (const Word &word : context.tree.wordsOf(block))
        if (!word.isCode() && word.address() != 'N' && word.isNumber() &&
            std::ranges::find(numbers, word.number()) != numbers.end())
          return true;
  return false;
}

/// `G5.1 Q1`: a function of the control, and how it is set.
struct Setting {
  std::uint16_t code; // in tenths
  char address;
  Decimal value;
};

std::optional<Setting> settingIn(BlockId block, const FileContext &context) {
  std::vector<const Word *> words;
  for (const Word &word : context.tree.wordsOf(block))
    if (word.address() != 'N')
      words.push_back(&word);
  if (words.size() != 2 || !words[0]->isCode() || words[0]->address() != 'G' || !words[1]->isNumber() ||
      (words[1]->address() != 'P' && words[1]->address() != 'Q') || !context.tree.statementsOf(block).empty())
    return std::nullopt;
  const auto code = words[0]->tenths();
  const Code *known = codeOf(*words[0], context.dialect);
  if (!code || (known && (known->role == CodeRole::Dwell || known->role == CodeRole::ReferenceReturn)))
    return std::nullopt;
  return Setting{*code, words[1]->address(), words[1]->number()};
}

/// Something that is called behind the block may set it back.
bool callsBetween(BlockId from, BlockId to, const FileContext &context) {
  if (!context.model.callsIn(from, to).empty())
    return true;
  for (BlockId block = from; block < to; block = block.next())
    if (callsUnseen(block, context))
      return true;
  return false;
}

/// The last block that sets what the dead one was to set back.
std::optional<BlockId> notSetBack(const DeadBlocks::Run &run, BlockId start, ProgramId program,
                                  const FileContext &context) {
  const auto own = settingIn(start, context);
  if (!own || flowAfter(context.tree, run.ender, context.dialect) != FlowAfter::Ends)
    return std::nullopt;
  std::optional<BlockId> found;
  for (BlockId block = context.model.programs[program].first; block < run.ender; block = block.next()) {
    const auto other = settingIn(block, context);
    if (!other || other->code != own->code || other->address != own->address)
      continue;
    if (other->value == own->value)
      return std::nullopt;
    found = block;
  }
  return found;
}

void reportSetting(BlockId set, BlockId back, BlockId ender, const FileContext &context, const Reporter &reporter) {
  const auto spanOf = [&](BlockId block) { return context.tree.blocks[block].span(); };
  const bool isSure = !callsBetween(set.next(), ender, context);
  reporter.report(
      {.message =
           fmt::format("{} is never executed: {} stays in force{}", context.quoted(spanOf(back)),
                       context.quoted(spanOf(set)), isSure ? "" : ", unless what is called behind it sets it back"),
       .span = spanOf(back),
       .labels = {{spanOf(set), "set here"}, {spanOf(ender), "the program never continues past this block"}},
       .notes = {"set it back before the program ends or returns"}},
      Severity::Warning);
}

bool endsProgram(BlockId block, const FileContext &context) {
  return findCode(context.tree, block, context.dialect, CodeRole::ProgramEnd) ||
         findCode(context.tree, block, context.dialect, CodeRole::Return);
}

bool hasEnd(BlockId from, BlockId to, const FileContext &context) {
  for (BlockId block = from; block < to; block = block.next())
    if (endsProgram(block, context))
      return true;
  return false;
}

/// `#3000=1(DONE)`, then `M05`, `M30`: the alarm stands where the program was to end, and there is no other end.
bool alwaysEndsInAlarm(const DeadBlocks::Run &run, ProgramId program, const FileContext &context) {
  if (!isAlarm(run.ender, context) || findWord(context.tree, run.ender, 'N'))
    return false;
  const Program &whole = context.model.programs[program];
  const BlockId behind = run.last.next();
  for (BlockId block = run.ender.next(); block < behind; block = block.next())
    if (!preparesAlarm(block, context))
      return false; // a program that is not ready yet
  return hasEnd(run.ender.next(), behind, context) && !hasEnd(whole.first, run.ender, context) &&
         !hasEnd(behind, whole.last, context);
}

void reportAlarmAtEnd(const DeadBlocks::Run &run, BlockId start, const FileContext &context, const Reporter &reporter) {
  reporter.report({.message = "this alarm ends every run of the program",
                   .span = context.tree.blocks[run.ender].span(),
                   .labels = {{context.tree.blocks[start].span(), "never executed from here on"}},
                   .notes = {"`#3006=1` stops with a message, and the program goes on at cycle start"}},
                  Severity::Warning);
}

/// `#3000=1(X)`, and directly behind it `#3000=2(Y)`: the second one was to be told as well.
std::optional<BlockId> secondAlarm(const DeadBlocks::Run &run, const FileContext &context) {
  if (!isAlarm(run.ender, context))
    return std::nullopt;
  for (BlockId block = run.ender.next(); block <= run.last; block = block.next()) {
    if (!isRead(context.tree.blocks[block]) || !hasContent(context, block))
      continue;
    const bool isBehind = !findWord(context.tree, block, 'N') && isAlarm(block, context);
    return isBehind ? std::optional(block) : std::nullopt;
  }
  return std::nullopt;
}

void reportSecondAlarm(BlockId alarm, BlockId first, const FileContext &context, const Reporter &reporter) {
  reporter.report({.message = "this alarm is never raised: the one before it has stopped the program",
                   .span = context.tree.blocks[alarm].span(),
                   .labels = {{context.tree.blocks[first].span(), "the program never continues past this block"}},
                   .notes = {"raise one alarm for each case, each behind a condition of its own"}},
                  Severity::Warning);
}

bool movesAxes(BlockId block, const FileContext &context) {
  return findWord(context.tree, block, 'X') || findWord(context.tree, block, 'Y') || findWord(context.tree, block, 'Z');
}

/// `M02` before anything has moved or was called, and the work of the program behind it.
bool endsBeforeWork(const DeadBlocks::Run &run, ProgramId program, const FileContext &context) {
  constexpr int kWork = 3; // blocks with movements
  if (!findCode(context.tree, run.ender, context.dialect, CodeRole::ProgramEnd) ||
      context.tree.blocks[run.ender].has(Block::kSkip))
    return false;
  for (BlockId block = context.model.programs[program].first; block <= run.ender; block = block.next())
    if (movesAxes(block, context) || !context.tree.statementsOf(block).empty() ||
        !context.model.callsIn(block, block.next()).empty() || findWord(context.tree, block, 'T'))
      return false;
  int work = 0;
  for (BlockId block = run.first; block <= run.last; block = block.next()) {
    if (findWord(context.tree, block, 'N') || findCode(context.tree, block, context.dialect, CodeRole::Return))
      return false; // a subprogram that is kept behind the end
    work += movesAxes(block, context) ? 1 : 0;
  }
  return work >= kWork;
}

void reportEarlyEnd(const DeadBlocks::Run &run, BlockId start, const FileContext &context, const Reporter &reporter) {
  reporter.report({.message = "the program ends here, before it has done anything",
                   .span = context.tree.blocks[run.ender].span(),
                   .labels = {{context.tree.blocks[start].span(), "never executed from here on"}},
                   .notes = {"write the code that is meant here, or move the end to the end"}},
                  Severity::Warning);
}

/// `M30`, and behind it a tool change, cuts, and another M30: an operation that was to be part of the program.
bool hidesOperation(const DeadBlocks::Run &run, const FileContext &context) {
  constexpr int kWork = 3; // blocks with movements
  if (!findCode(context.tree, run.ender, context.dialect, CodeRole::ProgramEnd) ||
      context.tree.blocks[run.ender].has(Block::kSkip))
    return false;
  int work = 0;
  bool changesTool = false;
  for (BlockId block = run.first; block <= run.last; block = block.next()) {
    if (findCode(context.tree, block, context.dialect, CodeRole::Return))
      return false; // a subprogram that is kept behind the end
    changesTool = changesTool || findAction(context.tree, block, context.dialect, {CodeAction::ToolChange});
    work += changesTool && movesAxes(block, context) ? 1 : 0;
  }
  return work >= kWork && hasEnd(run.first, run.last.next(), context);
}

void reportOperation(const DeadBlocks::Run &run, BlockId start, const FileContext &context, const Reporter &reporter) {
  reporter.report({.message = "the operation behind this end is never executed",
                   .span = context.tree.blocks[start].span(),
                   .labels = {{context.tree.blocks[run.ender].span(), "the program ends here"}},
                   .notes = {"it has a tool change, cuts and an end of its own: delete the end before it, write M00 or "
                             "M01 there, or give the operation a program number"}},
                  Severity::Warning);
}

/// Movements without a label to start from: the program was to come there.  A jump with words beside it is an error of
/// its own.
bool isLostWork(const DeadBlocks::Run &run, BlockId start, const FileContext &context) {
  if (!context.tree.statementsOf(run.ender).empty() && movesAxes(run.ender, context))
    return false;
  bool moves = false;
  for (BlockId block = start; block <= run.last; block = block.next()) {
    if (findWord(context.tree, block, 'N') || findCode(context.tree, block, context.dialect, CodeRole::Return))
      return false;
    moves = moves || (isRead(context.tree.blocks[block]) && movesAxes(block, context));
  }
  return moves;
}

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  const DeadBlocks dead(context, program);
  for (const DeadBlocks::Run &run : dead.runs()) {
    if (const auto alarm = secondAlarm(run, context); alarm && context.model.programOf(*alarm) == program) {
      reportSecondAlarm(*alarm, run.ender, context, reporter);
      continue;
    }
    const auto start = firstUnintended(run, context);
    if (!start || context.model.programOf(*start) != program || isNamedToUnseen(run, program, context))
      continue;
    if (endsBeforeWork(run, program, context)) {
      reportEarlyEnd(run, *start, context, reporter);
      continue;
    }
    if (hidesOperation(run, context)) {
      reportOperation(run, *start, context, reporter);
      continue;
    }
    if (alwaysEndsInAlarm(run, program, context)) {
      reportAlarmAtEnd(run, *start, context, reporter);
      continue;
    }
    if (const auto message = messageOf(run, *start, context)) {
      reportMessage(*message, run.ender, context, reporter);
      continue;
    }
    if (const auto set = notSetBack(run, *start, program, context)) {
      reportSetting(*set, *start, run.ender, context, reporter);
      continue;
    }
    const std::uint32_t first = context.source.lineOf(context.tree.blocks[*start].begin);
    const std::uint32_t last = context.source.lineOf(context.tree.blocks[run.last].begin);
    reporter.report({.message = first == last ? "this block is never executed"
                                              : fmt::format("the blocks from here to line {} are never executed", last),
                     .span = context.tree.blocks[*start].span(),
                     .labels = {{context.tree.blocks[run.ender].span(), "the program never continues past this block"}},
                     .notes = {"no jump leads here: delete the blocks, or correct the jump that should lead here"}},
                    isLostWork(run, *start, context) ? Severity::Warning : Severity::Info);
  }
}

} // namespace

extern const Rule unreachableBlock;
const Rule unreachableBlock{.info = {"unreachable-block", Category::Structure, Severity::Warning,
                                     "Reports blocks that are never executed: the block before them always goes "
                                     "elsewhere, and no jump leads to them."},
                            .hooks = {.program = check}};

} // namespace feedhold::rules::unreachable_block
