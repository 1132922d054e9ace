// radius-and-centre: `G03 X79.5 R12.25 I-15. J0.`
#include "rules/words/block_words.h"

#include <fmt/format.h>

namespace feedhold::rules::radius_and_centre {
namespace {

/// A centre word in the plane of the machine.  The third one may be the pitch of a helix.
const Word *centreIn(BlockId block, const FileContext &context) {
  const bool isLathe = context.dialect.machine == MachineKind::Turning;
  const Word *first = findWord(context.tree, block, 'I');
  return first ? first : findWord(context.tree, block, isLathe ? 'K' : 'J');
}

void check(const Word &radius, BlockId block, const FileContext &context, const Reporter &reporter) {
  const Word *arc = findCode(context.tree, block, context.dialect, CodeRole::Arc);
  if (!arc || radius.has(Word::kComma) || radius.has(Word::kArgument) || meansOwnWords(context, block) ||
      context.tree.blocks[block].has(Block::kBroken))
    return;
  const Word *centre = centreIn(block, context);
  if (!centre)
    return;
  reporter.report({.message = fmt::format("{} has {} and {}", context.quoted(arc->span()),
                                          context.quoted(radius.span()), context.quoted(centre->span())),
                   .span = arc->span(),
                   .notes = {context.dialect.grammar.oWords
                                 ? "the control stops with an error: an arc has either a radius or a centre"
                                 : "the control takes the radius, and the centre has no effect",
                             "delete the one that is not meant"}},
                  context.dialect.grammar.oWords ? Severity::Error : Severity::Warning);
}

} // namespace

extern const Rule radiusAndCentre;
const Rule radiusAndCentre{.info = {"radius-and-centre", Category::Word, Severity::Warning,
                                    "Reports an arc with `R` and with `I`, `J` or `K`, of which one has no effect."},
                           .hooks = {.word = check, .wordAddresses = "R"}};

} // namespace feedhold::rules::radius_and_centre
