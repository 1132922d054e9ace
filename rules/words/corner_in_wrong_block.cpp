// corner-in-wrong-block: `G41 D1 X10. ,R3.`, `G32 Z-20. F1. ,C2.`.
#include "rules/words/block_words.h"
#include "rules/words/word_values.h"

#include <fmt/format.h>

#include <string_view>

namespace feedhold::rules::corner_in_wrong_block {
namespace {

void tell(const Word &corner, const Word &code, std::string_view why, const FileContext &context,
          const Reporter &reporter) {
  reporter.report(
      {.message = fmt::format("{} in the block of {}", context.quoted(corner.span()), context.quoted(code.span())),
       .span = corner.span(),
       .labels = {{code.span(), "takes no corner beside it"}},
       .notes = {fmt::format("the control stops with {}", why), "write the corner in another block"}});
}

void check(const Word &corner, BlockId block, const FileContext &context, const Reporter &reporter) {
  if (!corner.has(Word::kComma) || corner.has(Word::kArgument) || !context.dialect.hasFanucParameters ||
      hasTooManyWords(context, block) || meansOwnWords(context, block))
    return;
  if (const Word *code =
          findAction(context.tree, block, context.dialect,
                     {CodeAction::CompensationLeft, CodeAction::CompensationRight, CodeAction::CompensationOff}))
    return tell(corner, *code, "PS0039 (corner where the compensation begins or ends)", context, reporter);
  if (const Word *code =
          findAction(context.tree, block, context.dialect, {CodeAction::Thread, CodeAction::ThreadCycle}))
    tell(corner, *code, "PS0050 (corner in a thread)", context, reporter);
}

} // namespace

extern const Rule cornerInWrongBlock;
const Rule cornerInWrongBlock{.info = {"corner-in-wrong-block", Category::Word, Severity::Error,
                                       "Reports `,C` or `,R` in the block of a thread, or of a `G40`, `G41` or `G42`."},
                              .hooks = {.word = check, .wordAddresses = "CR"}};

} // namespace feedhold::rules::corner_in_wrong_block
