// allowance-into-part: `G71 P10 Q20 U0.4 W0.1` in a bore: the allowance lies in the part, and roughing cuts too deep.
#include "rules/motion/turning_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <utility>

namespace feedhold::rules::allowance_into_part {
namespace {

/// mm or inch: less is not told from a start on the contour.
constexpr double kClearly = 0.05;

/// On which side of the start all corners of a contour lie along one axis.
enum class Side : std::uint8_t { Unknown, Below, Above };

Side sideOf(const std::vector<TurningPoint> &corners, double start, std::optional<double> TurningPoint::*axis) {
  const auto [least, most] =
      std::ranges::minmax(corners, {}, [&](const TurningPoint &corner) { return *(corner.*axis); });
  const bool below = *(most.*axis) <= start + kClearly;
  const bool above = *(least.*axis) >= start - kClearly;
  return below == above ? Side::Unknown : below ? Side::Below : Side::Above;
}

/// The contour never turns back along Z: then its faces all look to one side.
bool isMonotone(const std::vector<TurningPoint> &corners) {
  const auto z = [](const TurningPoint &corner) { return *corner.z; };
  return std::ranges::is_sorted(corners, std::ranges::greater{}, z) ||
         std::ranges::is_sorted(corners, std::ranges::less{}, z);
}

class Reader {
public:
  Reader(ProgramId program, const FileContext &context) : context_(context), walk_(program, context) {}

  void read(BlockId block, const Reporter &reporter) {
    const TurningPoint start = walk_.at();
    walk_.read(block);
    if (!start.x || !start.z)
      return;
    for (const Contour &contour : walk_.contours())
      if (contour.cycle->block == block && contour.standsBehindCycle())
        judge(contour, start, reporter);
  }

private:
  void judge(const Contour &contour, const TurningPoint &start, const Reporter &reporter) const {
    const std::vector<TurningPoint> corners = walk_.cornersOf(contour, start);
    if (corners.empty())
      return;
    const BlockId block = contour.cycle->block;
    const Side side = sideOf(corners, *start.x, &TurningPoint::x);
    // The contour of a bore that lies below the start is cut from the wrong side: its allowance is right.
    if (side != Side::Below || !isOfBore(corners))
      judge(findWord(context_.tree, block, 'U'), 'X', *start.x, side, contour, reporter);
    if (isMonotone(corners))
      judge(findWord(context_.tree, block, 'W'), 'Z', *start.z, sideOf(corners, *start.z, &TurningPoint::z), contour,
            reporter);
  }
  void judge(const Word *allowance, char axis, double start, Side side, const Contour &contour,
             const Reporter &reporter) const {
    if (!allowance || !allowance->isNumber() || allowance->number().isZero() || side == Side::Unknown ||
        allowance->number().isNegative() == (side == Side::Above))
      return;
    const Word *code = findCode(context_.tree, contour.cycle->block, context_.dialect, CodeRole::Contour);
    reporter.report(
        {.message = fmt::format("the allowance {} of {} shifts the contour into the part",
                                context_.quoted(allowance->span()), context_.quoted(code->span())),
         .span = allowance->span(),
         .labels = {{context_.tree.blocks[contour.first].span(), "the contour"}},
         .notes = {fmt::format("the cycle starts at {}{:g} and cuts towards {} {}: with this sign roughing cuts deeper "
                               "than the finished part",
                               axis, start, side == Side::Below ? "smaller" : "larger", axis),
                   fmt::format("write it {}", side == Side::Below ? "positive" : "negative")}});
  }

  const FileContext &context_;
  TurningWalk walk_;
};

} // namespace

extern const Rule allowanceIntoPart;
const Rule allowanceIntoPart{
    .info = {"allowance-into-part", Category::Motion, Severity::Warning,
             "Reports a roughing cycle of a lathe whose `U` or `W` leaves the finishing allowance on the wrong side of "
             "the contour."},
    .hooks = {.program = readTurningProgram<Reader>}};

} // namespace feedhold::rules::allowance_into_part
