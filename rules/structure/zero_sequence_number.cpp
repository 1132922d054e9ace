// zero-sequence-number: `N0`.
#include "findings/rule/rule.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules::zero_sequence_number {
namespace {

/// A jump of the file wants to come to it; numbers that only count blocks do no harm.
bool isJumpedTo(const FileContext &context) {
  return std::ranges::any_of(context.model.jumps,
                             [&](const Jump &jump) { return jump.number && jump.number->isZero(); });
}

void check(const Word &word, BlockId block, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.grammar.sequenceZero || word.integer() != 0u || context.tree.blocks[block].has(Block::kData))
    return;
  // A second N word is no sequence number; misplaced-sequence-number reports it.
  if (findWord(context.tree, block, 'N') != &word)
    return;
  reporter.report({.message = fmt::format("{} is not a sequence number; they begin at 1", context.quoted(word.span())),
                   .span = word.span(),
                   .notes = {"no jump and no sequence number search finds this block"}},
                  isJumpedTo(context) ? Severity::Warning : Severity::Info);
}

} // namespace

extern const Rule zeroSequenceNumber;
const Rule zeroSequenceNumber{.info = {"zero-sequence-number", Category::Structure, Severity::Warning,
                                       "Reports `N0` on a control whose sequence numbers begin at 1."},
                              .hooks = {.word = check, .wordAddresses = "N"}};

} // namespace feedhold::rules::zero_sequence_number
