// compensation-from-corner: `G41 D1 X20. Y15.` from the middle of a pocket, whose contour comes back to this corner.
#include "rules/motion/compensated_way.h"

#include <fmt/format.h>

namespace feedhold::rules::compensation_from_corner {
namespace {

constexpr std::size_t kFewestEdges = 3;
/// In radians: in a corner that turns less, the cutter hardly reaches the wall; one that turns more is a way back.
constexpr double kLeastTurn = 0.25;
constexpr double kMostTurn = 3;

/// Positive on the side of the cutter: how far the point lies beside the line of the edge.
double besideOf(const Stretch &edge, const PlaneVector &point, bool isLeft) {
  const PlaneVector way = between(edge.from, point);
  const double distance = lengthOf(way) * std::sin(turnBetween(directionOf(edge), way));
  return isLeft ? distance : -distance;
}

/// The edge by which the contour comes back to the corner in which it began.
const Stretch *edgeInto(const CompensatedWay &way) {
  const auto contour = way.contour();
  const auto loop = contour.empty() ? contour : way.loopTo(contour.front().from);
  if (loop.size() < kFewestEdges || !isEdge(loop.front()) || !isEdge(loop.back()))
    return nullptr;
  const double turn = turnBetween(directionOf(loop.back()), directionOf(loop.front())) * (way.isLeft ? 1 : -1);
  return kLeastTurn < turn && turn < kMostTurn ? &loop.back() : nullptr;
}

class CompensationFromCorner final : public CompensatedWayRule {
public:
  using CompensatedWayRule::CompensatedWayRule;

private:
  /// From within the corner: a cutter that comes from elsewhere may have to be on the other side.  Where the approach
  /// counts as an edge of the contour, the cutter goes into the corner no further than it fits.
  bool isWrong(const CompensatedWay &way) const override {
    const bool toNext = view().context().dialect.behaviour.cutterEntry == CutterEntry::ToNext;
    const Stretch *into = toNext ? edgeInto(way) : nullptr;
    if (!into)
      return false;
    const Stretch &approach = way.stretches.front();
    const auto isBeside = [&](const Stretch &edge) { return besideOf(edge, approach.from, way.isLeft) > way.near(); };
    return !approach.middle && isBeside(*into) && isBeside(way.contour().front());
  }

  void tell(const CompensatedWay &way, const FileContext &context, const Reporter &reporter) const override {
    const Span code = codeOf(way);
    reporter.report({.message = fmt::format("the approach behind {} ends in an inside corner", context.quoted(code)),
                     .span = moveOf(way.stretches.front()),
                     .labels = {{code, "the compensation"},
                                {moveOf(*edgeInto(way)), "the contour comes back to the corner along this edge"}},
                     .notes = {"the control brings the cutter to its offset from the next edge alone, square to where "
                               "that starts: it cuts into the wall of the edge that comes back, up to its radius",
                               "begin the contour within an edge, and end it there"}});
  }
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<CompensationFromCorner>(program, context);
}

} // namespace

extern const Rule compensationFromCorner;
const Rule compensationFromCorner{
    .info = {"compensation-from-corner", Category::Motion, Severity::Warning,
             "Reports cutter compensation whose approach ends in an inside corner of the contour."},
    .hooks = {.watch = watch}};

} // namespace feedhold::rules::compensation_from_corner
