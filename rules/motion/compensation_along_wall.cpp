// compensation-along-wall: the cutter is down on a corner of the contour, and `G41 D1 X50.` cuts the first edge; the
// last edge stands in the block of G40.
#include "rules/motion/compensated_way.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace feedhold::rules::compensation_along_wall {
namespace {

constexpr std::size_t kFewestEdges = 3;
/// In radians: a smaller turn is none.
constexpr double kClearly = 0.1;

bool isCorner(const Stretch &before, const Stretch &behind) {
  const double turn = std::abs(turnBetween(directionOf(before), directionOf(behind)));
  return behind.middle || before.middle || (turn > kClearly && turn < std::numbers::pi - kClearly);
}

/// The contour ends where the approach starts, in a corner: the approach is its first edge.
bool beginsOnWall(const CompensatedWay &way) {
  const Stretch &approach = way.stretches.front();
  const auto loop = way.loopTo(approach.from);
  return isEdge(approach) && loop.size() + 1 >= kFewestEdges && loop.size() == way.contour().size() &&
         isEdge(loop.back()) && isCorner(loop.back(), approach) && isCorner(approach, loop.front());
}

/// The move of G40 ends where the contour began, in a corner: it is the last edge.
bool closesContour(const CompensatedWay &way) {
  const Stretch &last = way.stretches.back();
  const auto contour = way.contour();
  return isEdge(last) && contour.size() + 1 >= kFewestEdges && way.isOpen() &&
         lengthOf(between(last.to, contour.front().from)) <= way.near() && isCorner(contour.back(), last) &&
         isCorner(last, contour.front());
}

/// The move of G40 goes along the first edge, the way that it was cut.
bool goesAlongFirst(const CompensatedWay &way) {
  const Stretch &last = way.stretches.back();
  const Stretch &first = way.contour().front();
  const double near = way.near();
  const bool isAlong = isEdge(last) && isEdge(first) && distanceToSide(last.from, first.from, first.to) <= near &&
                       std::abs(turnBetween(directionOf(first), directionOf(last))) <= kClearly;
  // Both ends of what lies beside each other.
  const bool isShorter = distanceToSide(last.to, first.from, first.to) <= near;
  return isAlong && (isShorter || distanceToSide(first.to, last.from, last.to) <= near) &&
         lengthOf(between(last.from, isShorter ? last.to : first.to)) > near;
}

bool endsOnWall(const CompensatedWay &way) {
  return way.endsInMove && !way.contour().empty() && (closesContour(way) || goesAlongFirst(way));
}

class CompensationAlongWall final : public CompensatedWayRule {
public:
  using CompensatedWayRule::CompensatedWayRule;

private:
  bool isWrong(const CompensatedWay &way) const override {
    return !way.stretches.empty() && (beginsOnWall(way) || endsOnWall(way));
  }

  void tell(const CompensatedWay &way, const FileContext &context, const Reporter &reporter) const override {
    if (beginsOnWall(way))
      tellBegin(way, context, reporter);
    else
      tellEnd(way, context, reporter);
  }
  void tellBegin(const CompensatedWay &way, const FileContext &context, const Reporter &reporter) const {
    const Span code = codeOf(way);
    reporter.report({.message = fmt::format("{} begins on an edge of the contour", context.quoted(code)),
                     .span = moveOf(way.stretches.front()),
                     .labels = {{code, "the compensation"},
                                {moveOf(way.contour().back()), "the contour comes back to where the edge starts"}},
                     .notes = {"the cutter stands with its centre on the contour, and goes over to its offset along "
                               "this edge: it cuts into the corner, and the edge is cut askew",
                               "begin beside the contour, and approach it in a straight move longer than the radius "
                               "of the cutter"}});
  }
  void tellEnd(const CompensatedWay &way, const FileContext &context, const Reporter &reporter) const {
    const Stretch &last = way.stretches.back();
    const Word *off = view().findAction(last.node, {CodeAction::CompensationOff});
    const bool closes = closesContour(way);
    reporter.report(
        {.message = fmt::format("{} ends the compensation on an edge of the contour", context.quoted(off->span())),
         .span = off->span(),
         .labels = {{moveOf(way.contour().front()), closes ? "the contour begins here" : "this edge"}},
         .notes = {"the centre of the cutter goes from its offset onto the end of this move: the edge is cut askew, "
                   "and the cutter gets into the part",
                   closes ? "write the last edge without `G40`, and cancel in a move that leads away from the contour"
                          : "cancel in a move that leads away from the contour"}});
  }
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<CompensationAlongWall>(program, context);
}

} // namespace

extern const Rule compensationAlongWall;
const Rule compensationAlongWall{
    .info = {"compensation-along-wall", Category::Motion, Severity::Warning,
             "Reports cutter compensation that begins or ends in a move along an edge of the contour."},
    .hooks = {.watch = watch}};

} // namespace feedhold::rules::compensation_along_wall
