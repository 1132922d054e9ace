// nose-compensation-on-other-side: `G41`, a cut along -Z, and a rapid move away from the centre: an outside diameter.
#include "rules/motion/turning_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace feedhold::rules::nose_compensation_on_other_side {
namespace {

constexpr std::initializer_list<CodeAction> kOn = {CodeAction::CompensationLeft, CodeAction::CompensationRight};

bool isLeft(const Word &code, const FileContext &context) {
  return codeOf(code, context.dialect)->action == CodeAction::CompensationLeft;
}

class Reader {
public:
  Reader(ProgramId program, const FileContext &context)
      : context_(context), walk_(program, context), hidden_(program, context) {}

  void read(BlockId block, const Reporter &reporter) {
    const TurningPoint before = walk_.at();
    const TurningMove move = walk_.read(block);
    const TurningPoint &at = walk_.at();
    if (move == TurningMove::Cycle)
      readContour(block, before, reporter);
    if (hidden_.isIn(block) || move == TurningMove::Cycle || move == TurningMove::Unknown ||
        findWord(context_.tree, block, 'T'))
      cut_ = nullptr;
    else if (cut_ && move == TurningMove::Rapid)
      judge(before, at, reporter);
    if (!walk_.isInContour(block))
      switchTo(block);
    if (move == TurningMove::Feed)
      noteCut(block, before, at);
  }

private:
  void switchTo(BlockId block) {
    if (const Word *code = findAction(context_.tree, block, context_.dialect, kOn))
      code_ = code;
    else if (findAction(context_.tree, block, context_.dialect, {CodeAction::CompensationOff}) ||
             findCode(context_.tree, block, context_.dialect, CodeRole::ProgramEnd) || hidden_.isIn(block))
      code_ = nullptr;
  }
  /// Along a cylinder towards the chuck.
  void noteCut(BlockId block, const TurningPoint &from, const TurningPoint &to) {
    const bool isAlong = from.x && to.x && from.z && to.z && *from.x == *to.x && *to.z<*from.z && * to.x> 0;
    cut_ = isAlong && code_ ? &context_.tree.blocks[block] : nullptr;
  }
  /// The tool leaves the cylinder to the side that it came from: outwards from an outside diameter.
  void judge(const TurningPoint &from, const TurningPoint &to, const Reporter &reporter) {
    const Block *cut = cut_;
    cut_ = nullptr;
    if (!code_ || !from.x || !to.x || !from.z || !to.z || *from.x == *to.x || *to.z < *from.z)
      return;
    const bool isOutside = *to.x > *from.x;
    // With both axes in one block the way may go along a bore first.
    if (*to.z != *from.z && isOutside)
      return;
    if (isOutside == isLeft(*code_, context_) && told_ != code_)
      tell(*code_, isOutside, cut->span(), reporter);
  }
  void readContour(BlockId block, const TurningPoint &start, const Reporter &reporter) {
    for (const Contour &contour : walk_.contours()) {
      if (contour.cycle->block != block || !contour.standsBehindCycle() || !start.x || !start.z)
        continue;
      const Word *code = code_;
      for (BlockId each = contour.first; each <= contour.last; each = each.next())
        if (const Word *word = findAction(context_.tree, each, context_.dialect, kOn))
          code = word;
      const auto corners = walk_.cornersOf(contour, start);
      if (!code || corners.size() < 3 || told_ == code ||
          !findAction(context_.tree, block, context_.dialect, {CodeAction::TurnContour}))
        continue;
      const auto [least, most] = std::ranges::minmax(corners, {}, [](const TurningPoint &point) { return *point.x; });
      const bool isOutside = *start.x >= *most.x, isBore = *start.x <= *least.x;
      const bool goesIn = *corners.back().z < *start.z && corners[1].z <= start.z;
      if (isOutside != isBore && goesIn && isOutside == isLeft(*code, context_))
        tell(*code, isOutside, context_.tree.blocks[block].span(), reporter);
    }
  }
  void tell(const Word &code, bool isOutside, Span cut, const Reporter &reporter) {
    told_ = &code;
    reporter.report(
        {.message = fmt::format("{} puts the tool nose on the wrong side of {}", context_.quoted(code.span()),
                                isOutside ? "this outside diameter" : "this bore"),
         .span = code.span(),
         .labels = {{cut, isOutside ? "an outside diameter, cut towards the chuck" : "a bore, cut towards the chuck"}},
         .notes = {"the nose radius is compensated into the part: cones, radii and shoulders get the wrong "
                   "size",
                   fmt::format("write `{}`: towards the chuck an outside diameter needs G42 and a bore G41",
                               isOutside ? "G42" : "G41")}});
  }

  const FileContext &context_;
  TurningWalk walk_;
  HiddenWork hidden_;
  const Word *code_ = nullptr; // G41 or G42 in force
  const Block *cut_ = nullptr; // the last block, along a cylinder
  const Word *told_ = nullptr;
};

} // namespace

extern const Rule noseCompensationOnOtherSide;
const Rule noseCompensationOnOtherSide{
    .info = {"nose-compensation-on-other-side", Category::Motion, Severity::Warning,
             "Reports `G41` on an outside diameter and `G42` in a bore of a lathe, cut towards the chuck."},
    .hooks = {.program = readTurningProgram<Reader>}};

} // namespace feedhold::rules::nose_compensation_on_other_side
