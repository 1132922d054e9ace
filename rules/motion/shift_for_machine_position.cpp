// shift-for-machine-position: `G53 X0`, `G52 Z0`: the second was to be a G53, too.
#include "findings/rule/dead_blocks.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace feedhold::rules::shift_for_machine_position {
namespace {

constexpr std::string_view kAxes = "XYZABCUVW";
bool isAxis(const Word &word) { return kAxes.find(word.address()) != std::string_view::npos; }

/// The only word of the block beside its code and N: an axis with 0.
const Word *onlyZero(BlockId block, const FileContext &context) {
  const Word *zero = nullptr;
  for (const Word &word : context.tree.wordsOf(block)) {
    if (word.isCode() ? word.address() != 'G' : word.address() == 'N')
      continue;
    if (word.isCode())
      continue;
    if (zero || !isAxis(word) || !word.isNumber() || !word.number().isZero())
      return nullptr;
    zero = &word;
  }
  return zero;
}

std::optional<BlockId> before(BlockId block, BlockId first, const FileContext &context) {
  for (std::uint32_t i = block.index(); i-- > first.index();)
    if (hasContent(context, BlockId(i)))
      return BlockId(i);
  return std::nullopt;
}

/// Behind it the axes stand still up to the end of the program.
bool isLastMove(BlockId block, const Program &program, const FileContext &context) {
  for (BlockId each = block.next(); each < program.last; each = each.next()) {
    const auto words = context.tree.wordsOf(each);
    if (std::ranges::any_of(words, isAxis) || !context.tree.statementsOf(each).empty())
      return false;
    if (leavesForGood(context, each))
      return true;
  }
  return false;
}

void check(ProgramId id, const FileContext &context, const Reporter &reporter) {
  const Program &program = context.model.programs[id];
  const Word *shift = nullptr;
  BlockId at = program.first;
  for (BlockId block = program.first; block < program.last; block = block.next())
    if (const Word *code = findAction(context.tree, block, context.dialect, {CodeAction::LocalShift})) {
      if (shift)
        return; // it cancels another one
      shift = code;
      at = block;
    }
  const Word *zero = shift ? onlyZero(at, context) : nullptr;
  const auto previous = zero ? before(at, program.first, context) : std::nullopt;
  const Word *machine =
      previous ? findAction(context.tree, *previous, context.dialect, {CodeAction::MachineMove}) : nullptr;
  if (!machine || findWord(context.tree, *previous, zero->address()) || !isLastMove(at, program, context))
    return;
  reporter.report({.message = fmt::format("{} moves nothing: it sets a shift of 0",
                                          context.quoted(cover(shift->span(), zero->span()))),
                   .span = shift->span(),
                   .labels = {{machine->span(), "the other axis moves by this code"}},
                   .notes = {"the axis stays where it is when the program ends",
                             "write `G53` to move the axis to a machine position"},
                   .fixes = {{.title = "write `G53`", .edits = {{shift->span(), "G53"}}}}});
}

} // namespace

extern const Rule shiftForMachinePosition;
const Rule shiftForMachinePosition{
    .info = {"shift-for-machine-position", Category::Motion, Severity::Warning,
             "Reports a `G52` with 0 for one axis behind a `G53` for another one, where no shift is to be cancelled."},
    .hooks = {.program = check}};

} // namespace feedhold::rules::shift_for_machine_position
