#include "language/model/contours.h"

#include "language/model/block_facts.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace feedhold {

namespace {

bool isOfPath(const Word &word, const Dialect &dialect, ContourCodes codes) {
  if (word.isCode()) {
    constexpr std::array kMotions = {CodeAction::Rapid, CodeAction::Linear, CodeAction::ArcClockwise,
                                     CodeAction::ArcCounterclockwise};
    const Code *code = codeOf(word, dialect);
    if (!code)
      return false;
    const bool isOfCompensation = code->action == CodeAction::CompensationOff ||
                                  code->action == CodeAction::CompensationLeft ||
                                  code->action == CodeAction::CompensationRight;
    return (codes == ContourCodes::OfCompensation && isOfCompensation) ||
           std::ranges::find(kMotions, code->action) != kMotions.end();
  }
  constexpr std::string_view kLetters = "NXZUWIKRF";
  return !word.has(Word::kComma) && word.form() != WordForm::Broken &&
         kLetters.find(word.address()) != std::string_view::npos;
}

} // namespace

std::optional<ContourBlocks> contourAt(const ProgramModel &model, BlockId cycle) {
  std::optional<BlockId> first;
  std::optional<BlockId> last;
  for (const Jump &jump : model.jumpsIn(cycle, cycle.next())) {
    if (jump.kind == JumpKind::ContourFrom)
      first = jump.target;
    if (jump.kind == JumpKind::ContourTo)
      last = jump.target;
  }
  return first && last && *first <= *last ? std::optional(ContourBlocks{*first, *last}) : std::nullopt;
}

bool isContourUnambiguous(const ProgramModel &model, BlockId cycle) {
  const auto labels = model.sequenceNumbersOf(model.programOf(cycle));
  return std::ranges::all_of(model.jumpsIn(cycle, cycle.next()), [&](const Jump &jump) {
    const std::optional<std::uint32_t> wanted = targetNumber(jump);
    return (jump.kind != JumpKind::ContourFrom && jump.kind != JumpKind::ContourTo) ||
           std::ranges::count_if(labels, [&](const SequenceNumber &label) { return label.number == wanted; }) == 1;
  });
}

bool isPlainContour(const SyntaxTree &tree, const ProgramModel &model, const Dialect &dialect,
                    const ContourBlocks &contour, ContourCodes codes) {
  constexpr std::uint16_t kOther = Block::kBroken | Block::kCommentTail | Block::kSkip | Block::kSkipInside;
  for (BlockId block = contour.first; block <= contour.last; block = block.next())
    if ((tree.blocks[block].flags & kOther) != 0 || !tree.statementsOf(block).empty() ||
        !model.callsIn(block, block.next()).empty() ||
        !std::ranges::all_of(tree.wordsOf(block), [&](const Word &word) { return isOfPath(word, dialect, codes); }))
      return false;
  return true;
}

} // namespace feedhold
