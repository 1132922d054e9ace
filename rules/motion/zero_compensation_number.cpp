// zero-compensation-number: `G41 D0`.
#include "findings/rule/rule.h"

#include <fmt/format.h>

namespace feedhold::rules::zero_compensation_number {
namespace {

void check(const Word &word, BlockId block, const FileContext &context, const Reporter &reporter) {
  if (!word.isNumber() || !word.number().isZero() || context.dialect.grammar.oWords)
    return; // where subroutines are o-words, the tool table says what D0 is
  const Word *begins =
      findAction(context.tree, block, context.dialect, {CodeAction::CompensationLeft, CodeAction::CompensationRight});
  if (!begins || meansOwnWords(context.tree, block, context.dialect))
    return;
  reporter.report({.message = fmt::format("{} with {} offsets by nothing", context.quoted(begins->span()),
                                          context.quoted(word.span())),
                   .span = word.span(),
                   .notes = {"the centre of the tool goes along the contour and cuts its radius too deep",
                             "write the number of the cutter's offset"}});
}

} // namespace

extern const Rule zeroCompensationNumber;
const Rule zeroCompensationNumber{
    .info = {"zero-compensation-number", Category::Motion, Severity::Warning, "Reports `G41` or `G42` with `D0`."},
    .hooks = {.word = check, .wordAddresses = "D"}};

} // namespace feedhold::rules::zero_compensation_number
