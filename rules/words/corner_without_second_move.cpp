// corner-without-second-move: `Y10. ,C10.`, and the next block moves Z.
#include "rules/motion/tool_sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace feedhold::rules::corner_without_second_move {
namespace {

const Word *cornerIn(BlockId block, const FileContext &context) {
  const auto words = context.tree.wordsOf(block);
  const auto found = std::ranges::find_if(words, [](const Word &word) {
    return word.has(Word::kComma) && (word.address() == 'R' || word.address() == 'C') && !word.has(Word::kArgument);
  });
  return found == words.end() ? nullptr : &*found;
}

bool hasAny(BlockId block, std::string_view addresses, const FileContext &context) {
  return std::ranges::any_of(context.tree.wordsOf(block), [&](const Word &word) {
    return !word.has(Word::kComma) && addresses.find(word.address()) != std::string_view::npos;
  });
}

/// Another plane than XY may be in force.
bool choosesPlane(const Program &program, const FileContext &context) {
  for (BlockId block = program.first; block < program.last; block = block.next())
    if (findAction(context.tree, block, context.dialect, {CodeAction::PlaneZX, CodeAction::PlaneYZ}))
      return true;
  return false;
}

/// What comes next, beginning with an axis, or with the end of the program.
std::optional<BlockId> nextMove(BlockId corner, const Program &program, const HiddenWork &hidden,
                                const FileContext &context) {
  for (BlockId block = corner.next(); block < program.last; block = block.next()) {
    if (hidden.isIn(block) || !context.tree.statementsOf(block).empty())
      return std::nullopt;
    if (hasAny(block, "XYZABCUVWIJKR", context) || findCode(context.tree, block, context.dialect, CodeRole::ProgramEnd))
      return block;
  }
  return std::nullopt;
}

void check(ProgramId id, const FileContext &context, const Reporter &reporter) {
  const Program &program = context.model.programs[id];
  if (context.dialect.machine != MachineKind::Milling || choosesPlane(program, context))
    return;
  const HiddenWork hidden(id, context);
  for (BlockId block = program.first; block < program.last; block = block.next()) {
    const Word *corner = hidden.isIn(block) ? nullptr : cornerIn(block, context);
    const auto next = corner ? nextMove(block, program, hidden, context) : std::nullopt;
    if (!next || hasAny(*next, "XYABCUVWIJKR", context))
      continue;
    reporter.report({.message = fmt::format("{} has no second side: the next block does not move in X or Y",
                                            context.quoted(corner->span())),
                     .span = corner->span(),
                     .labels = {{context.tree.blocks[*next].span(), "the next block"}},
                     .notes = {"the control puts a chamfer or a radius between two moves in the plane; without the "
                               "second one it stops with an alarm",
                               fmt::format("write the block that goes on from the corner, or take {} out",
                                           context.quoted(corner->span()))}});
  }
}

} // namespace

extern const Rule cornerWithoutSecondMove;
const Rule cornerWithoutSecondMove{.info = {"corner-without-second-move", Category::Word, Severity::Warning,
                                            "Reports `,C` or `,R` when the next block does not move in the plane."},
                                   .hooks = {.program = check}};

} // namespace feedhold::rules::corner_without_second_move
