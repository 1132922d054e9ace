// depth-of-cut: `G71 U-1.8 R0.8`: the depth of a pass has no sign; `G76 X47. Z-20. Q500`: no height.
#include "findings/rule/rule.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace feedhold::rules::depth_of_cut {
namespace {

/// Words of a block that have to be above zero, and what they are.
struct Amount {
  char address;
  std::string_view meaning;
};

constexpr std::array kNone = {Amount{}, Amount{}};
constexpr char kDepth[] = "the depth of cut";

/// Of a contour cycle: the block with P and Q says what is left, the one without how to cut.
std::array<Amount, 2> amountsOf(CodeAction action, bool namesContour) {
  if (namesContour)
    return {Amount{'D', kDepth}, Amount{}};
  if (action == CodeAction::TurnContour)
    return {Amount{'U', kDepth}, Amount{}};
  if (action == CodeAction::FaceContour)
    return {Amount{'W', kDepth}, Amount{}};
  return {Amount{'R', "the number of passes"}, Amount{}};
}

std::array<Amount, 2> amountsOf(BlockId block, const Code &code, const FileContext &context) {
  const auto has = [&](char address) { return findWord(context.tree, block, address) != nullptr; };
  if (code.action == CodeAction::TurnContour || code.action == CodeAction::FaceContour ||
      code.action == CodeAction::RepeatContour)
    return amountsOf(code.action, has('P') || has('Q'));
  if (!has('X') && !has('Z') && !has('U') && !has('W')) // the block that says how to cut
    return kNone;
  if (code.action == CodeAction::ThreadPasses)
    return {Amount{'P', "the height of the thread"}, Amount{'Q', "the depth of the first pass"}};
  if (code.action == CodeAction::FaceGroove || code.action == CodeAction::DiameterGroove)
    return {Amount{'P', "the step along X"}, Amount{'Q', "the step along Z"}};
  return kNone;
}

/// Zero is the depth of nothing; for a step it means that there is none.
bool isWrong(const Amount &amount, const Word &word) {
  const bool isStep = amount.meaning.starts_with("the step");
  return word.number().isNegative() || (word.number().isZero() && !isStep && amount.address != 'D');
}

/// `G72 U0.5 R0.2` in front of `G72 P10 Q20`: each of the two has its depth of cut along its own axis.
void checkLetter(BlockId block, const Word &cycle, const Code &code, const FileContext &context,
                 const Reporter &reporter) {
  const bool isFacing = code.action == CodeAction::FaceContour;
  if (!isFacing && code.action != CodeAction::TurnContour)
    return;
  const char own = isFacing ? 'W' : 'U';
  const Word *other = findWord(context.tree, block, isFacing ? 'U' : 'W');
  const auto has = [&](char address) { return findWord(context.tree, block, address) != nullptr; };
  if (!other || has(own) || has('P') || has('Q') || has('X') || has('Z') || !has('R') || other->has(Word::kArgument))
    return;
  reporter.report(
      {.message = fmt::format("the depth of cut of {} is {}, not {}", context.quoted(cycle.span()), own,
                              context.quoted(other->span())),
       .span = other->span(),
       .notes = {fmt::format("the control cuts with the depth of an earlier cycle, or stops: write `{}`", own)}});
}

/// Of G76 in two blocks, as FANUC controls have it; in one block K and D stand for P and Q.
bool cutsThread(BlockId block, const Code &code, const FileContext &context) {
  const auto has = [&](char address) { return findWord(context.tree, block, address) != nullptr; };
  return context.dialect.hasFanucParameters && code.action == CodeAction::ThreadPasses && (has('Z') || has('W')) &&
         !has('K') && !has('D') && !has('A');
}

/// `G76 X47. Z-20. Q500 F1.5`: neither P nor Q is kept from an earlier block.
void checkMissing(BlockId block, const Word &cycle, const FileContext &context, const Reporter &reporter) {
  for (const auto &[address, meaning] : amountsOf(block, *codeOf(cycle, context.dialect), context))
    if (!findWord(context.tree, block, address)) {
      reporter.report({.message = fmt::format("{} has no `{}`, {}", context.quoted(cycle.span()), address, meaning),
                       .span = cycle.span(),
                       .notes = {"the control stops with PS0317 (height of the thread or depth of cut is zero)"}});
      return;
    }
}

/// The block in front of it, with the smallest depth of a pass as Q and the angle in the last digits of P.
const Word *settingOf(BlockId block, char address, const FileContext &context) {
  if (block.index() == 0)
    return nullptr;
  const BlockId before(block.index() - 1);
  const Word *cycle = findTurningCycle(context.tree, before, context.dialect);
  const auto has = [&](char axis) { return findWord(context.tree, before, axis) != nullptr; };
  if (!cycle || codeOf(*cycle, context.dialect)->action != CodeAction::ThreadPasses || has('X') || has('Z') ||
      has('U') || has('W'))
    return nullptr;
  return findWord(context.tree, before, address);
}

void checkSmallest(BlockId block, const FileContext &context, const Reporter &reporter) {
  const Word *smallest = settingOf(block, 'Q', context);
  const Word *height = findWord(context.tree, block, 'P');
  if (!smallest || !height || smallest->has(Word::kPoint) || height->has(Word::kPoint))
    return;
  const auto least = smallest->integer();
  const auto whole = height->integer();
  if (!least || !whole || *whole == 0 || *least <= *whole)
    return;
  reporter.report({.message = fmt::format("the smallest depth of a pass is {}, and the thread is only {} high",
                                          context.quoted(smallest->span()), context.quoted(height->span())),
                   .span = height->span(),
                   .labels = {{smallest->span(), "the smallest depth"}},
                   .notes = {"the control stops with PS0316 (smallest depth larger than the height of the thread)"}});
}

void checkAngle(BlockId block, const FileContext &context, const Reporter &reporter) {
  constexpr std::array kAngles = {0U, 29U, 30U, 55U, 60U, 80U};
  constexpr std::uint32_t kDigits = 1'000'000;
  const Word *packed = settingOf(block, 'P', context);
  const auto number = packed && !packed->has(Word::kPoint) ? packed->integer() : std::nullopt;
  if (!number || *number >= kDigits || std::ranges::find(kAngles, *number % 100) != kAngles.end())
    return;
  reporter.report(
      {.message = fmt::format("the last two digits of {} are no angle of a thread", context.quoted(packed->span())),
       .span = packed->span(),
       .notes = {"the control stops with PS0315 (angle of the thread): it takes 0, 29, 30, 55, 60 and 80 "
                 "degrees"}});
}

void check(BlockId block, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.machine != MachineKind::Turning || context.tree.blocks[block].has(Block::kBroken))
    return;
  const Word *cycle = findTurningCycle(context.tree, block, context.dialect);
  if (!cycle)
    return;
  if (cutsThread(block, *codeOf(*cycle, context.dialect), context)) {
    checkMissing(block, *cycle, context, reporter);
    checkSmallest(block, context, reporter);
    checkAngle(block, context, reporter);
  }
  checkLetter(block, *cycle, *codeOf(*cycle, context.dialect), context, reporter);
  for (const Amount &amount : amountsOf(block, *codeOf(*cycle, context.dialect), context)) {
    const Word *word = amount.address != '\0' ? findWord(context.tree, block, amount.address) : nullptr;
    if (!word || !word->isNumber() || word->has(Word::kArgument) || !isWrong(amount, *word))
      continue;
    const bool isZero = word->number().isZero();
    reporter.report({.message = fmt::format("{} of {} is {}", amount.meaning, context.quoted(cycle->span()),
                                            isZero ? "zero" : "negative"),
                     .span = word->span(),
                     .notes = {"the control stops with an alarm",
                               isZero ? "write the amount of one pass"
                                      : "write it without a sign: the cycle finds its direction by the contour or the "
                                        "end point"}});
  }
}

} // namespace

extern const Rule depthOfCut;
const Rule depthOfCut{.info = {"depth-of-cut", Category::Motion, Severity::Error,
                               "Reports a turning cycle whose depth of cut, step or number of passes is negative or "
                               "zero, or whose depth of cut stands at the letter of the other axis, and a threading "
                               "cycle whose numbers do not make a thread."},
                      .hooks = {.block = check}};

} // namespace feedhold::rules::depth_of_cut
