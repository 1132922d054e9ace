// compensation-on-arc: `G41 D1 G02 X10. Y0. R5.`; `G41 D1`, `G02 X10. Y0. R5.`.
#include "findings/rule/rule.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>

namespace feedhold::rules::compensation_on_arc {
namespace {

const Word *startIn(const FileContext &context, BlockId block) {
  return findAction(context.tree, block, context.dialect,
                    {CodeAction::CompensationLeft, CodeAction::CompensationRight});
}
const Word *endIn(const FileContext &context, BlockId block) {
  return findAction(context.tree, block, context.dialect, {CodeAction::CompensationOff});
}

/// By the text of the program: the compensation is in force.  Absent: nothing before the block says so.
std::optional<bool> stateBefore(const FileContext &context, BlockId block) {
  const BlockId first = context.model.programs[context.model.programOf(block)].first;
  for (std::uint32_t i = block.index(); i-- > first.index();) {
    const BlockId each(i);
    if (startIn(context, each))
      return true;
    if (endIn(context, each))
      return false;
  }
  return std::nullopt;
}

bool hasAxis(const FileContext &context, BlockId block) {
  return std::ranges::any_of(context.tree.wordsOf(block), [](const Word &word) {
    return std::string_view("XYZUVW").find(word.address()) != std::string_view::npos;
  });
}

/// Another way leads to one of the blocks, the last included.
bool isJumpedTo(BlockId first, BlockId last, const FileContext &context) {
  return std::ranges::any_of(context.model.jumpTargetsOf(context.model.programOf(last)),
                             [&](BlockId target) { return first <= target && target <= last; });
}

/// `G41 D1` in a block without a move: the arc behind it is the first one that the compensation has.
const Word *loneStartBefore(const FileContext &context, BlockId arc) {
  const BlockId first = context.model.programs[context.model.programOf(arc)].first;
  for (std::uint32_t i = arc.index(); i-- > first.index();) {
    const BlockId each(i);
    if (hasAxis(context, each) || !context.tree.statementsOf(each).empty() ||
        context.tree.blocks[each].has(Block::kBroken) || context.tree.blocks[each].has(Block::kSkip) ||
        meansOwnWords(context.tree, each, context.dialect) || !context.model.callsIn(each, each.next()).empty() ||
        endIn(context, each))
      return nullptr;
    if (const Word *start = startIn(context, each))
      return stateBefore(context, each) == false && !isJumpedTo(each.next(), arc, context) ? start : nullptr;
  }
  return nullptr;
}

void checkBehindStart(const Word &arc, BlockId block, const FileContext &context, const Reporter &reporter) {
  const Word *start = hasAxis(context, block) && !meansOwnWords(context.tree, block, context.dialect)
                          ? loneStartBefore(context, block)
                          : nullptr;
  if (!start)
    return;
  reporter.report({.message = fmt::format("the first move behind {} is an arc", context.quoted(start->span())),
                   .span = arc.span(),
                   .labels = {{start->span(), "begins with the next move"}},
                   .notes = {"the control stops with an alarm: it needs a straight move for the compensation to take "
                             "effect",
                             "write a G00 or G01 block before the arc"}});
}

/// The block of a G40 without a move, where nothing has moved since, by the text; LinuxCNC ends the compensation then.
std::optional<BlockId> endBefore(const FileContext &context, BlockId arc) {
  const BlockId first = context.model.programs[context.model.programOf(arc)].first;
  for (std::uint32_t i = arc.index(); i-- > first.index();) {
    const BlockId each(i);
    const bool moves = std::ranges::any_of(context.tree.wordsOf(each), [](const Word &word) {
      return std::string_view("XYZABCUVW@^").find(word.address()) != std::string_view::npos;
    });
    if (moves || !context.tree.statementsOf(each).empty() || context.tree.blocks[each].has(Block::kBroken) ||
        !context.model.callsIn(each, each.next()).empty())
      return std::nullopt;
    if (endIn(context, each))
      return each;
  }
  return std::nullopt;
}

void reportFirstMove(const Word &arc, BlockId block, const FileContext &context, const Reporter &reporter) {
  const auto before = endBefore(context, block);
  if (!before || stateBefore(context, *before) != true)
    return;
  const Word *end = endIn(context, *before);
  reporter.report({.message = fmt::format("{} is the first move behind {}", context.quoted(arc.span()),
                                          context.quoted(end->span())),
                   .span = arc.span(),
                   .labels = {{end->span(), "the compensation ends here"}},
                   .notes = {"the control stops with an error: it needs a straight move for the compensation to end",
                             "write a G00 or G01 block in front of the arc"}},
                  Severity::Error);
}

void check(const Word &word, BlockId block, const FileContext &context, const Reporter &reporter) {
  const Code *code = codeOf(word, context.dialect);
  const bool isArc =
      code && (code->action == CodeAction::ArcClockwise || code->action == CodeAction::ArcCounterclockwise);
  if (!isArc)
    return;
  // LinuxCNC may begin the compensation with an arc, and stops where one ends it.
  const bool stops = context.dialect.behaviour.stopsAtStrayWords;
  const Word *start = stops ? nullptr : startIn(context, block);
  if (stops && !endIn(context, block))
    return reportFirstMove(word, block, context, reporter);
  const Word *switching = start ? start : endIn(context, block);
  if (!switching)
    return checkBehindStart(word, block, context, reporter);
  if (meansOwnWords(context.tree, block, context.dialect))
    return;
  // G41 again where it is in force, or G40 where nothing is, changes nothing.  A caller may have left it in any state.
  const auto known = stateBefore(context, block);
  if (!known || *known == (start != nullptr))
    return;
  reporter.report({.message = fmt::format("{} {} in a block with an arc", context.quoted(switching->span()),
                                          start ? "begins" : "ends"),
                   .span = switching->span(),
                   .labels = {{word.span(), "the arc"}},
                   .notes = {"the control stops with an alarm: it needs a straight move for the compensation to take "
                             "effect and to end",
                             start ? "write it in a G00 or G01 block before the arc"
                                   : "write it in a G00 or G01 block behind the arc"}},
                  stops ? Severity::Error : Severity::Warning);
}

} // namespace

extern const Rule compensationOnArc;
const Rule compensationOnArc{
    .info = {"compensation-on-arc", Category::Motion, Severity::Warning,
             "Reports `G41`, `G42` or `G40` in the block of a `G02` or `G03`, and an arc that is the "
             "first move behind a `G41` or `G42`."},
    .hooks = {.word = check, .wordAddresses = "G"}};

} // namespace feedhold::rules::compensation_on_arc
