// finishing-start-in-contour: `G70` from X35 of a contour that ends at X85: the way back leads through the part.
#include "rules/motion/turning_program.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::rules::finishing_start_in_contour {
namespace {

/// mm or inch: less is not told from a start on the contour.
constexpr double kClearly = 0.05;

/// How far towards the centre, or away from it in a bore, the way back comes at a Z: straight, or with both axes at
/// full speed until one of them is there.  X is a diameter.
double wayBackAt(double z, const TurningPoint &end, const TurningPoint &start, bool isOutside) {
  const double part = (z - *end.z) / (*start.z - *end.z);
  const double straight = *end.x + part * (*start.x - *end.x);
  const double step = 2 * (z - *end.z);
  return isOutside ? std::min(straight, std::max(*start.x, *end.x - step))
                   : std::max(straight, std::min(*start.x, *end.x + step));
}

/// The corner that the way from the last corner back to the start leaves most on its wrong side.
const TurningPoint *cornerInTheWay(const std::vector<TurningPoint> &corners, const TurningPoint &start,
                                   bool isOutside) {
  const TurningPoint &end = corners.back();
  const TurningPoint *worst = nullptr;
  double most = kClearly;
  for (const TurningPoint &corner : corners) {
    if (*corner.z <= *end.z || *corner.z >= *start.z)
      continue;
    const double way = wayBackAt(*corner.z, end, start, isOutside);
    const double depth = isOutside ? *corner.x - way : way - *corner.x;
    if (depth > most) {
      worst = &corner;
      most = depth;
    }
  }
  return worst;
}

class Reader {
public:
  Reader(ProgramId program, const FileContext &context) : context_(context), walk_(program, context) {}

  void read(BlockId block, const Reporter &reporter) {
    const TurningPoint start = walk_.at();
    walk_.read(block);
    for (const Contour &contour : walk_.contours()) {
      if (contour.cycle->block != block || !start.x || !start.z)
        continue;
      if (contour.standsBehindCycle())
        roughed_.push_back({&contour, start});
      else
        readFinishing(contour, start, reporter);
    }
  }

private:
  struct Roughed {
    const Contour *contour;
    TurningPoint start;
  };

  void readFinishing(const Contour &contour, const TurningPoint &start, const Reporter &reporter) const {
    const auto roughed =
        std::ranges::find_if(roughed_, [&](const Roughed &other) { return other.contour->first == contour.first; });
    const Word *code = findCode(context_.tree, contour.cycle->block, context_.dialect, CodeRole::Contour);
    if (roughed == roughed_.end() || !code)
      return;
    const std::vector<TurningPoint> corners = walk_.cornersOf(contour, start);
    if (corners.empty())
      return;
    const auto [least, most] = std::ranges::minmax(corners, {}, [](const TurningPoint &corner) { return *corner.x; });
    const bool isOutside = *roughed->start.x >= *most.x - kClearly;
    const bool isBore = *roughed->start.x <= *least.x + kClearly;
    if (isOutside == isBore || (isOutside ? *start.x >= *most.x - kClearly : *start.x <= *least.x + kClearly))
      return;
    if (const TurningPoint *corner = cornerInTheWay(corners, start, isOutside))
      tell(*code, start, *roughed, *corner, corners.back(), reporter);
  }

  void tell(const Word &code, const TurningPoint &start, const Roughed &roughed, const TurningPoint &corner,
            const TurningPoint &end, const Reporter &reporter) const {
    reporter.report(
        {.message = fmt::format("{} starts at X{:g} Z{:g} inside the contour: the rapid return from X{:g} Z{:g} goes "
                                "through the part",
                                context_.quoted(code.span()), *start.x, *start.z, *end.x, *end.z),
         .span = code.span(),
         .labels = {{context_.tree.blocks[roughed.contour->cycle->block].span(),
                     fmt::format("roughed from X{:g} Z{:g}", *roughed.start.x, *roughed.start.z)}},
         .notes = {fmt::format("the cycle goes back to its start at rapid; the part has X{:g} at Z{:g} in between",
                               *corner.x, *corner.z),
                   fmt::format("start it outside the part, as the roughing cycle: X{:g} Z{:g}", *roughed.start.x,
                               *roughed.start.z)}});
  }

  const FileContext &context_;
  TurningWalk walk_;
  std::vector<Roughed> roughed_;
};

} // namespace

extern const Rule finishingStartInContour;
const Rule finishingStartInContour{
    .info = {"finishing-start-in-contour", Category::Motion, Severity::Warning,
             "Reports a finishing cycle of a lathe whose rapid return to its start leads through the part."},
    .hooks = {.program = readTurningProgram<Reader>}};

} // namespace feedhold::rules::finishing_start_in_contour
