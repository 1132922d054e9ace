// move-before-rigid-tapping: `M29 S500`, `X20. Y5.`, `G84 ..`.
#include "rules/motion/tool_sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace feedhold::rules::move_before_rigid_tapping {
namespace {

constexpr std::int64_t kRigid = 29;
constexpr std::size_t kNear = 6; // blocks from the one to the other

const Word *rigidIn(BlockId block, const FileContext &context) {
  for (const Word &word : context.tree.wordsOf(block))
    if (word.address() == 'M' && word.isCode() && word.isNumber() && word.number().asInteger() == kRigid)
      return &word;
  return nullptr;
}

/// G74 and G84 of a mill, G84 and G88 of a lathe.
bool taps(BlockId block, const FileContext &context) {
  constexpr std::array<std::uint16_t, 2> kTapsOfLathes = {840, 880};
  for (const Word &word : context.tree.wordsOf(block))
    if (const Code *code = word.address() == 'G' ? codeOf(word, context.dialect) : nullptr)
      if (code->action == CodeAction::CycleTap || code->action == CodeAction::CycleTapLeft ||
          (code->action == CodeAction::SideCycle &&
           std::ranges::find(kTapsOfLathes, code->tenths) != kTapsOfLathes.end()))
        return true;
  return false;
}

/// A word that may not stand between the two: an axis, or S.
const Word *disturberIn(BlockId block, const FileContext &context) {
  for (const Word &word : context.tree.wordsOf(block))
    if (std::string_view("XYZUVWABCS").find(word.address()) != std::string_view::npos && !word.has(Word::kArgument) &&
        !word.has(Word::kComma))
      return &word;
  return nullptr;
}

bool isOther(BlockId block, const HiddenWork &hidden, const FileContext &context) {
  return hidden.isIn(block) || !context.tree.statementsOf(block).empty() || rigidIn(block, context) ||
         meansOwnWords(context.tree, block, context.dialect) ||
         findAction(context.tree, block, context.dialect, {CodeAction::CycleOff, CodeAction::SpindleStop});
}

void checkFrom(BlockId rigid, const Program &program, const HiddenWork &hidden, const FileContext &context,
               const Reporter &reporter) {
  const Word *disturber = nullptr;
  std::size_t count = 0;
  for (BlockId block = rigid.next(); block < program.last && count < kNear; block = block.next(), ++count) {
    if (taps(block, context)) {
      if (disturber) {
        const bool isSpeed = disturber->address() == 'S';
        reporter.report(
            {.message = fmt::format("{} stands between `M29` and the tapping cycle", context.quoted(disturber->span())),
             .span = disturber->span(),
             .labels = {{rigidIn(rigid, context)->span(), "rigid tapping begins"}},
             .notes = {isSpeed ? "the control stops with PS0203 (S between M29 and the cycle)"
                               : "the control stops with PS0204 (axis moved between M29 and the cycle)",
                       isSpeed ? "write S in the block of `M29`"
                               : "write the position before `M29`, or in the block of the cycle"}});
      }
      return;
    }
    if (isOther(block, hidden, context))
      return;
    if (!disturber)
      disturber = disturberIn(block, context);
  }
}

void check(ProgramId id, const FileContext &context, const Reporter &reporter) {
  if (!context.dialect.hasFanucParameters)
    return;
  const Program &program = context.model.programs[id];
  std::optional<HiddenWork> hidden;
  for (BlockId block = program.first; block < program.last; block = block.next()) {
    if (!rigidIn(block, context) || taps(block, context))
      continue;
    if (!hidden)
      hidden.emplace(id, context);
    checkFrom(block, program, *hidden, context, reporter);
  }
}

} // namespace

extern const Rule moveBeforeRigidTapping;
const Rule moveBeforeRigidTapping{
    .info = {"move-before-rigid-tapping", Category::Motion, Severity::Warning,
             "Reports a move or an `S` between `M29` and the tapping cycle that it makes rigid."},
    .hooks = {.program = check}};

} // namespace feedhold::rules::move_before_rigid_tapping
