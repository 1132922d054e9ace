// corner-without-second-move: `Y10. ,C10.`, and the next block moves Z, or is a `G00`.
#include "rules/motion/tool_sections.h"
#include "rules/structure/structure_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
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

/// Another plane than XY may be in force, on a lathe another than ZX.
bool choosesPlane(const Program &program, const FileContext &context) {
  const bool isTurning = context.dialect.machine == MachineKind::Turning;
  const CodeAction other = isTurning ? CodeAction::PlaneXY : CodeAction::PlaneZX;
  for (BlockId block = program.first; block < program.last; block = block.next())
    if (findAction(context.tree, block, context.dialect, {other, CodeAction::PlaneYZ}))
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

/// The next block positions: PS0052 of FANUC controls.
const Word *rapidIn(BlockId block, const FileContext &context) {
  return context.dialect.hasFanucParameters ? findAction(context.tree, block, context.dialect, {CodeAction::Rapid})
                                            : nullptr;
}

/// The last block of the contour of a turning cycle: PS0069.
void tellLast(const Word &corner, const Contour &contour, const FileContext &context, const Reporter &reporter) {
  reporter.report(
      {.message = fmt::format("{} has no second side: the contour ends with this block", context.quoted(corner.span())),
       .span = corner.span(),
       .labels = {{contour.cycle->span, "its Q names this block"}},
       .notes = {"the control stops with PS0069 (corner in the last block of a contour)",
                 "write the move that goes on from the corner into the contour"}},
      Severity::Error);
}

void checkContours(ProgramId id, const FileContext &context, const Reporter &reporter) {
  if (!context.dialect.hasFanucParameters || context.dialect.machine != MachineKind::Turning)
    return;
  std::set<BlockId> told; // G70 names the contour again
  for (const Contour &contour : contoursOf(id, context))
    if (const Word *corner = cornerIn(contour.last, context); corner && told.insert(contour.last).second)
      tellLast(*corner, contour, context, reporter);
}

void tellRapid(const Word &corner, const Word &rapid, const FileContext &context, const Reporter &reporter) {
  reporter.report({.message = fmt::format("{} has no second side: the next block is a {}",
                                          context.quoted(corner.span()), context.quoted(rapid.span())),
                   .span = corner.span(),
                   .labels = {{rapid.span(), "positions, and cuts no corner"}},
                   .notes = {"the control stops with PS0052 (no G01 behind a chamfer or a corner radius)",
                             fmt::format("write the cutting move that goes on from the corner, or take {} out",
                                         context.quoted(corner.span()))}},
                  Severity::Error);
}

void check(ProgramId id, const FileContext &context, const Reporter &reporter) {
  const Program &program = context.model.programs[id];
  const bool isTurning = context.dialect.machine == MachineKind::Turning;
  const std::string_view inPlane = isTurning ? "XZACUVWIJKR" : "XYABCUVWIJKR";
  if (choosesPlane(program, context))
    return;
  checkContours(id, context, reporter);
  const HiddenWork hidden(id, context);
  for (BlockId block = program.first; block < program.last; block = block.next()) {
    const Word *corner = hidden.isIn(block) ? nullptr : cornerIn(block, context);
    const auto next = corner ? nextMove(block, program, hidden, context) : std::nullopt;
    if (!next)
      continue;
    if (const Word *rapid = rapidIn(*next, context)) {
      tellRapid(*corner, *rapid, context, reporter);
      continue;
    }
    if (hasAny(*next, inPlane, context))
      continue;
    reporter.report({.message = fmt::format("{} has no second side: the next block does not move in {}",
                                            context.quoted(corner->span()), isTurning ? "X or Z" : "X or Y"),
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
const Rule cornerWithoutSecondMove{
    .info = {"corner-without-second-move", Category::Word, Severity::Warning,
             "Reports `,C` or `,R` when the next block does not move in the plane, or is a `G00`."},
    .hooks = {.program = check}};

} // namespace feedhold::rules::corner_without_second_move
