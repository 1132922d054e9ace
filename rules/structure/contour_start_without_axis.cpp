// contour-start-without-axis: `G71 P100 Q200`, and N100 has no X.
#include "rules/structure/structure_view.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules::contour_start_without_axis {
namespace {

bool hasAny(BlockId block, std::string_view addresses, const FileContext &context) {
  return std::ranges::any_of(context.tree.wordsOf(block), [&](const Word &word) {
    return addresses.find(word.address()) != std::string_view::npos && !word.has(Word::kComma);
  });
}

/// Its sequence number alone.
bool holdsNothing(BlockId block, const FileContext &context) {
  return context.tree.statementsOf(block).empty() &&
         std::ranges::all_of(context.tree.wordsOf(block), [](const Word &word) { return word.address() == 'N'; });
}

/// A FANUC control looks for G00 or G01 in the block itself (PS0065).
bool isMissingMotion(BlockId block, const FileContext &context) {
  return context.dialect.hasFanucParameters && context.tree.statementsOf(block).empty() &&
         (std::ranges::none_of(context.tree.wordsOf(block), [](const Word &word) { return word.address() == 'G'; }) ||
          findCode(context.tree, block, context.dialect, CodeRole::Arc));
}

void tellMotion(const Contour &contour, const Word &cycle, const FileContext &context, const Reporter &reporter) {
  reporter.report(
      {.message = fmt::format("the contour of {} begins without `G00` or `G01`", context.quoted(cycle.span())),
       .span = context.tree.blocks[contour.first].span(),
       .labels = {{context.tree.blocks[contour.cycle->block].span(), "its P names this block"}},
       .notes = {"the control stops: one of the two has to stand in the first block of a contour, whatever "
                 "is in force",
                 "write `G00` in this block"}});
}

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.machine != MachineKind::Turning)
    return;
  for (const Contour &contour : contoursOf(program, context)) {
    const Word *word = findCode(context.tree, contour.cycle->block, context.dialect, CodeRole::Contour);
    const Code *code = word ? codeOf(*word, context.dialect) : nullptr;
    const bool isAlongZ = code && code->action == CodeAction::TurnContour;
    const Block &first = context.tree.blocks[contour.first];
    if (!(isAlongZ || (code && code->action == CodeAction::FaceContour)) || first.has(Block::kBroken) ||
        first.has(Block::kSkip) || contour.first == contour.last)
      continue;
    const bool hasOwn = hasAny(contour.first, isAlongZ ? "XU" : "ZW", context);
    const bool hasOther = hasAny(contour.first, isAlongZ ? "ZW" : "XU", context);
    const bool isBare = context.dialect.hasFanucParameters && holdsNothing(contour.first, context);
    if (hasOwn && isMissingMotion(contour.first, context)) {
      tellMotion(contour, *word, context, reporter);
      continue;
    }
    if (hasOwn || (!hasOther && !isBare))
      continue;
    const char axis = isAlongZ ? 'X' : 'Z';
    reporter.report(
        {.message =
             isBare ? fmt::format("the contour of {} begins with a block that is empty", context.quoted(word->span()))
                    : fmt::format("the contour of {} begins without {}", context.quoted(word->span()), axis),
         .span = first.span(),
         .labels = {{context.tree.blocks[contour.cycle->block].span(), "its P names this block"}},
         .notes = {fmt::format("the first block of the contour is the infeed: it needs `G00` or `G01` with {}; the "
                               "control stops, or does not know to which {} to go down",
                               axis, axis),
                   fmt::format("write `G00 {}..` of the start of the contour in this block", axis)}});
  }
}

} // namespace

extern const Rule contourStartWithoutAxis;
const Rule contourStartWithoutAxis{
    .info =
        {"contour-start-without-axis", Category::Structure, Severity::Warning,
         "Reports a contour whose first block is empty, or has no `G00` or `G01`, no `X` for a roughing cycle along "
         "Z, no `Z` for one along X."},
    .hooks = {.program = check}};

} // namespace feedhold::rules::contour_start_without_axis
