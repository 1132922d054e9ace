// arc-of-no-radius: `G02 X60. Y40. I0 J0`.
#include "findings/rule/rule.h"

#include "rules/words/block_words.h"

#include <fmt/format.h>

namespace feedhold::rules::arc_of_no_radius {
namespace {

/// The first of the words for the centre, if there are some and all are 0.
const Word *centreAtStart(BlockId block, const FileContext &context) {
  const Word *first = nullptr;
  for (const char address : {'I', 'J', 'K'})
    if (const Word *word = findWord(context.tree, block, address)) {
      if (!word->isNumber() || word->number().asInteger() != 0)
        return nullptr;
      first = first ? first : word;
    }
  return first;
}

/// Under G90.1 they are the centre itself.
bool mayBeCentre(const FileContext &context) {
  return context.dialect.behaviour.arcDistanceModes && context.source.text().find("90.1") != std::string_view::npos;
}

void check(BlockId block, const FileContext &context, const Reporter &reporter) {
  if (mayBeCentre(context))
    return;
  const Word *arc =
      findAction(context.tree, block, context.dialect, {CodeAction::ArcClockwise, CodeAction::ArcCounterclockwise});
  const Word *centre = arc && !findWord(context.tree, block, 'R') ? centreAtStart(block, context) : nullptr;
  if (!centre || findWord(context.tree, block, 'P')) // P: turns, or an involute
    return;
  reporter.report(
      {.message = fmt::format("{} has its centre where it starts: its radius is 0", context.quoted(arc->span())),
       .span = centre->span(),
       .labels = {{arc->span(), "of this arc"}},
       .notes = {"I, J and K are the way from the start of the arc to its centre",
                 "write that way, or the radius as `R`"}},
      context.dialect.behaviour.stopsAtStrayWords ? Severity::Error : Severity::Warning);
}

} // namespace

extern const Rule arcOfNoRadius;
const Rule arcOfNoRadius{.info = {"arc-of-no-radius", Category::Word, Severity::Warning,
                                  "Reports an arc of which `I`, `J` and `K` are all 0."},
                         .hooks = {.block = check}};

} // namespace feedhold::rules::arc_of_no_radius
