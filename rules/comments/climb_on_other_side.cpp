// climb-on-other-side: `G42 D1 X10. (CLIMB MILLING)` with the spindle in M03: the cutter stands on the conventional
// side.
#include "rules/comments/remarks_of_block.h"

#include <fmt/format.h>

namespace feedhold::rules::climb_on_other_side {
namespace {

/// The spindle of the whole file turns one way, and that is M03.
bool turnsRightOnly(const FileContext &context) {
  bool starts = false;
  for (BlockId block(0); block.index() < context.tree.blockCount(); block = block.next()) {
    if (findAction(context.tree, block, context.dialect, {CodeAction::SpindleCounterclockwise}))
      return false;
    starts = starts || findAction(context.tree, block, context.dialect, {CodeAction::SpindleClockwise});
  }
  return starts;
}

void check(BlockId block, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.machine != MachineKind::Milling || context.tree.commentsOf(block).empty())
    return;
  const Word *left = findAction(context.tree, block, context.dialect, {CodeAction::CompensationLeft});
  const Word *right = findAction(context.tree, block, context.dialect, {CodeAction::CompensationRight});
  const std::string remark = remarksOf(context, block);
  const bool saysClimb = saysAny(remark, {"CLIMB"});
  const bool saysConventional = saysAny(remark, {"CONVENTIONAL"});
  const Word *wrong = saysClimb == saysConventional ? nullptr : saysClimb ? right : left;
  if (!wrong || saysAny(remark, {"NOT ", "NO ", "INSTEAD"}) || !turnsRightOnly(context))
    return;
  reporter.report(
      {.message = fmt::format("{} does not make this {} milling", context.quoted(wrong->span()),
                              saysClimb ? "climb" : "conventional"),
       .span = wrong->span(),
       .labels = {{context.tree.commentsOf(block).front().span, "the remark"}},
       .notes = {"with the spindle in M03 a cutter to the left of its path, G41, mills climb, and to the right, G42, "
                 "conventional",
                 "turn the path round together with the code, or correct the remark"}});
}

} // namespace

extern const Rule climbOnOtherSide;
const Rule climbOnOtherSide{.info = {"climb-on-other-side", Category::Comment, Severity::Warning,
                                     "Reports a cutter compensation on the other side than the remark beside it says: "
                                     "climb or conventional."},
                            .hooks = {.block = check}};

} // namespace feedhold::rules::climb_on_other_side
