// zero-compensation-number: `G41 D0`, and a program whose first length offset is `G43 H0`.
#include "rules/motion/folder_programs.h"
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <string>
#include <utility>

namespace feedhold::rules::zero_compensation_number {
namespace {

constexpr std::initializer_list<CodeAction> kLengths = {CodeAction::LengthPlus, CodeAction::LengthMinus,
                                                        CodeAction::LengthGiven};
constexpr std::initializer_list<CodeAction> kCuts = {CodeAction::Linear, CodeAction::ArcClockwise,
                                                     CodeAction::ArcCounterclockwise};

void tell(const Word &code, const Word &number, std::string_view effect, std::pair<std::string, std::string> notes,
          const FileContext &context, const Reporter &reporter) {
  reporter.report(
      {.message = fmt::format("{} with {} {}", context.quoted(code.span()), context.quoted(number.span()), effect),
       .span = number.span(),
       .notes = {std::move(notes.first), std::move(notes.second)}});
}

/// No length offset comes before the block in the text of its program.
bool isFirstLength(BlockId block, ProgramId program, const FileContext &context) {
  for (BlockId before = context.model.programs[program].first; before < block; before = before.next())
    if (findAction(context.tree, before, context.dialect, kLengths))
      return false;
  return true;
}

/// Something is cut behind the block, before another length offset.
bool cutsBehind(BlockId block, ProgramId program, const FileContext &context) {
  for (BlockId at = block.next(); at < context.model.programs[program].last; at = at.next()) {
    if (findAction(context.tree, at, context.dialect, kLengths))
      return false;
    if (findAction(context.tree, at, context.dialect, kCuts) ||
        findAction(context.tree, at, context.dialect, kDrillingCycles))
      return true;
  }
  return false;
}

void checkLength(const Word &word, BlockId block, const FileContext &context, const Reporter &reporter) {
  const Word *begins =
      findAction(context.tree, block, context.dialect, {CodeAction::LengthPlus, CodeAction::LengthMinus});
  const ProgramId program = context.model.programOf(block);
  // Behind another length offset, H0 takes it back.
  if (!begins || startedBy(context, program) != StartedBy::Operator || !isFirstLength(block, program, context) ||
      !cutsBehind(block, program, context))
    return;
  tell(*begins, word, "sets no tool length",
       {"the spindle nose, not the tip of the tool, goes to the programmed Z: the tool runs into the part",
        "write the number of the tool's length offset"},
       context, reporter);
}

void check(const Word &word, BlockId block, const FileContext &context, const Reporter &reporter) {
  if (!word.isNumber() || !word.number().isZero() || context.dialect.grammar.oWords ||
      meansOwnWords(context.tree, block, context.dialect))
    return; // where subroutines are o-words, the tool table says what number 0 is
  if (word.address() == 'H')
    return checkLength(word, block, context, reporter);
  if (const Word *begins = findAction(context.tree, block, context.dialect,
                                      {CodeAction::CompensationLeft, CodeAction::CompensationRight}))
    tell(*begins, word, "offsets by nothing",
         {"the centre of the tool goes along the contour and cuts its radius too deep",
          "write the number of the cutter's offset"},
         context, reporter);
}

} // namespace

extern const Rule zeroCompensationNumber;
const Rule zeroCompensationNumber{
    .info = {"zero-compensation-number", Category::Motion, Severity::Warning,
             "Reports `G41` or `G42` with `D0`, and a program whose first length offset is `G43 H0`."},
    .hooks = {.word = check, .wordAddresses = "DH"}};

} // namespace feedhold::rules::zero_compensation_number
