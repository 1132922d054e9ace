// extended-offset-lost: `G54 P1` in a program that says `G54.1 P1` elsewhere.
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules::extended_offset_lost {
namespace {

bool isExtended(const Word &word, const FileContext &context) {
  const Code *code = word.address() == 'G' ? codeOf(word, context.dialect) : nullptr;
  return code && code->action == CodeAction::ExtendedWorkOffset;
}

/// P belongs to another code of the block.
bool hasOtherTakerOfP(BlockId block, const FileContext &context) {
  return std::ranges::any_of(context.tree.wordsOf(block), [&](const Word &word) {
    if (!word.isCode())
      return false;
    const Code *code = codeOf(word, context.dialect);
    return !code || code->action == CodeAction::ExtendedWorkOffset ||
           (code->role != CodeRole::Plain && code->role != CodeRole::Motion) || code->action == CodeAction::ScalingOn;
  });
}

const Word *elsewhere(ProgramId program, const FileContext &context) {
  const Program &its = context.model.programs[program];
  for (BlockId block = its.first; block < its.last; block = block.next())
    for (const Word &word : context.tree.wordsOf(block))
      if (isExtended(word, context))
        return &word;
  return nullptr;
}

void check(const Word &word, BlockId block, const FileContext &context, const Reporter &reporter) {
  const Code *code = codeOf(word, context.dialect);
  const Word *number = findWord(context.tree, block, 'P');
  if (!code || code->action != CodeAction::WorkOffset || !number || hasOtherTakerOfP(block, context))
    return;
  const Word *extended = elsewhere(context.model.programOf(block), context);
  if (!extended)
    return;
  reporter.report(
      {.message = fmt::format("{} with {}, but this program uses {} elsewhere", context.quoted(word.span()),
                              context.quoted(number->span()), context.quoted(extended->span())),
       .span = word.span(),
       .labels = {{extended->span(), "the extended work offset"}},
       .notes = {
           context.dialect.hasFanucParameters
               ? "older controls, and those without the option, ignore this P: the part is cut at the first work offset"
               : "many controls ignore this P: the part is cut at the first work offset",
           fmt::format("write {} if the extended offset is meant", context.quoted(extended->span()))}});
}

} // namespace

extern const Rule extendedOffsetLost;
const Rule extendedOffsetLost{
    .info = {"extended-offset-lost", Category::Motion, Severity::Warning,
             "Reports a `P` with `G54` to `G59` in a program that uses the code for extended work offsets elsewhere."},
    .hooks = {.word = check, .wordAddresses = "G"}};

} // namespace feedhold::rules::extended_offset_lost
