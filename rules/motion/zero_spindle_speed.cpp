// zero-spindle-speed: `S0 M03`, and then a cut.
#include "findings/rule/rule.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules::zero_spindle_speed {
namespace {

const Word *findAction(const FileContext &context, BlockId block, std::initializer_list<CodeAction> actions) {
  for (const Word &word : context.tree.wordsOf(block))
    if (const Code *code = codeOf(word, context.dialect))
      if (std::ranges::find(actions, code->action) != actions.end())
        return &word;
  return nullptr;
}

bool setsSpeed(const SyntaxTree &tree, BlockId block) {
  return std::ranges::any_of(tree.wordsOf(block), [](const Word &word) { return word.address() == 'S'; });
}

bool cuts(const FileContext &context, BlockId block) {
  return std::ranges::any_of(context.tree.wordsOf(block), [&](const Word &word) {
    const Code *code = codeOf(word, context.dialect);
    return code && (code->role == CodeRole::CannedCycle ? code->action != CodeAction::CycleOff
                                                        : code->action == CodeAction::Linear);
  });
}

enum class Called : std::uint8_t { Nothing, KeepsSpeed, MayChangeAnything };
Called calledIn(const FileContext &context, BlockId block) {
  Called called = Called::Nothing;
  for (const Call &call : context.model.callsIn(block, block.next())) {
    const auto callee = context.callGraph.callee(context.file, call);
    if (!callee || callee->file != context.file)
      return Called::MayChangeAnything;
    const Program &program = context.model.programs[callee->program];
    for (BlockId each = program.first; each < program.last; each = each.next())
      if (setsSpeed(context.tree, each) || !context.model.callsIn(each, each.next()).empty())
        return Called::MayChangeAnything;
    called = Called::KeepsSpeed;
  }
  return called;
}

/// The first block behind that cuts before another speed is set.  Lasers begin with S0 and give the power later.
bool isFollowedByCut(const FileContext &context, BlockId from) {
  const Program &program = context.model.programs[context.model.programOf(from)];
  for (BlockId block = from.next(); block < program.last; block = block.next()) {
    if (setsSpeed(context.tree, block) || findAction(context, block, {CodeAction::SpindleStop}) ||
        flowAfter(context.tree, block, context.dialect) >= FlowAfter::Jumps)
      return false;
    const Called called = calledIn(context, block);
    if (called != Called::Nothing || cuts(context, block))
      return called != Called::MayChangeAnything;
  }
  return false;
}

void check(BlockId block, const FileContext &context, const Reporter &reporter) {
  const Word *start = findAction(context, block, {CodeAction::SpindleClockwise, CodeAction::SpindleCounterclockwise});
  const Word *speed = start ? findWord(context.tree, block, 'S') : nullptr;
  if (!speed || !speed->isNumber() || !speed->number().isZero() || !isFollowedByCut(context, block))
    return;
  reporter.report({.message = fmt::format("{} starts the spindle with speed 0", context.quoted(start->span())),
                   .span = speed->span(),
                   .notes = {"the spindle stands still, and the tool is fed into the part all the same",
                             "write the speed of the tool"}});
}

} // namespace

extern const Rule zeroSpindleSpeed;
const Rule zeroSpindleSpeed{
    .info = {"zero-spindle-speed", Category::Motion, Severity::Warning,
             "Reports `M03` or `M04` with `S0` when a cut follows before another speed is set."},
    .hooks = {.block = check}};

} // namespace feedhold::rules::zero_spindle_speed
