// See the header.
#include "rules/motion/straight_cuts.h"

#include <algorithm>
#include <string_view>
#include <utility>

namespace feedhold::rules {
namespace {

class CutReader {
public:
  CutReader(ProgramId program, const FileContext &context) : context_(context), walk_(program, context) {}

  void read(BlockId block) {
    const TurningPoint before = walk_.at();
    if (walk_.read(block) == TurningMove::Feed && !isCurveOrThread(block))
      note(block, before, walk_.at());
    for (const Contour &contour : walk_.contours())
      if (contour.cycle->block == block && contour.standsBehindCycle())
        readContour(contour, before);
  }
  std::map<BlockId, StraightCut> take() { return std::move(cuts_); }

private:
  bool isCurveOrThread(BlockId block) const {
    return findCode(context_.tree, block, context_.dialect, CodeRole::Arc) ||
           findAction(context_.tree, block, context_.dialect, {CodeAction::Thread});
  }
  bool has(BlockId block, std::string_view addresses) const {
    return std::ranges::any_of(context_.tree.wordsOf(block), [&](const Word &word) {
      return addresses.find(word.address()) != std::string_view::npos;
    });
  }
  void readContour(const Contour &contour, TurningPoint from) {
    const auto corners = walk_.cornersOf(contour, from);
    auto corner = corners.begin();
    bool isStraight = false;
    for (BlockId block = contour.first; block <= contour.last && corner != corners.end(); block = block.next()) {
      if (findAction(context_.tree, block, context_.dialect, {CodeAction::Rapid}) || isCurveOrThread(block))
        isStraight = false;
      else if (findAction(context_.tree, block, context_.dialect, {CodeAction::Linear}))
        isStraight = true;
      if (!has(block, "XZUW"))
        continue;
      if (isStraight)
        note(block, from, *corner);
      from = *corner++;
    }
  }
  void note(BlockId block, const TurningPoint &from, const TurningPoint &to) {
    if (from.x && from.z && to.x && to.z && !has(block, "ACR"))
      cuts_.emplace(block, StraightCut{from, to});
  }

  const FileContext &context_;
  TurningWalk walk_;
  std::map<BlockId, StraightCut> cuts_;
};

} // namespace

std::map<BlockId, StraightCut> straightCutsOf(ProgramId program, const FileContext &context) {
  CutReader reader(program, context);
  const Program &its = context.model.programs[program];
  for (BlockId block = its.first; block < its.last; block = block.next())
    reader.read(block);
  return reader.take();
}

} // namespace feedhold::rules
