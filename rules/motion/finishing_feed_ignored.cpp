// finishing-feed-ignored: `G70 P10 Q20 F0.1`, and the contour has `F0.15` in its first cut.
#include "rules/motion/turning_walk.h"

#include <fmt/format.h>

namespace feedhold::rules::finishing_feed_ignored {
namespace {

/// The F of the first block of the contour that feeds, if the block has one.
const Word *firstFeedOf(const Contour &contour, const FileContext &context) {
  bool isRapid = true;
  for (BlockId block = contour.first; block <= contour.last; block = block.next()) {
    if (findAction(context.tree, block, context.dialect, {CodeAction::Rapid}))
      isRapid = true;
    else if (findCode(context.tree, block, context.dialect, CodeRole::Motion) ||
             findCode(context.tree, block, context.dialect, CodeRole::Arc))
      isRapid = false;
    if (const Word *feed = findWord(context.tree, block, 'F'))
      return feed;
    if (!isRapid)
      return nullptr;
  }
  return nullptr;
}

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.machine != MachineKind::Turning)
    return;
  for (const Contour &contour : contoursOf(program, context)) {
    const BlockId block = contour.cycle->block;
    if (!findAction(context.tree, block, context.dialect, {CodeAction::FinishContour}))
      continue;
    const Word *feed = findWord(context.tree, block, 'F');
    const Word *own = feed ? firstFeedOf(contour, context) : nullptr;
    if (!own || !feed->isNumber() || !own->isNumber() || feed->number() == own->number())
      continue;
    reporter.report({.message = fmt::format("{} has no effect: the contour has {}", context.quoted(feed->span()),
                                            context.quoted(own->span())),
                     .span = feed->span(),
                     .labels = {{own->span(), "in force from the first cut of the contour"}},
                     .notes = {"the finishing cut feeds as the contour says",
                               "change the F of the contour, which roughing ignores, or delete this one"}});
  }
}

} // namespace

extern const Rule finishingFeedIgnored;
const Rule finishingFeedIgnored{
    .info = {"finishing-feed-ignored", Category::Motion, Severity::Warning,
             "Reports an `F` of a finishing cycle that the contour replaces in its first cut."},
    .hooks = {.program = check}};

} // namespace feedhold::rules::finishing_feed_ignored
