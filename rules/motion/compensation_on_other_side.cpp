// compensation-on-other-side: `G41` round a contour anticlockwise puts the cutter inside, and it comes from outside.
#include "rules/motion/compensated_way.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace feedhold::rules::compensation_on_other_side {
namespace {

/// Of the largest extent: the end of a contour that is as near to its start closes it.
constexpr double kClosed = 0.02;
constexpr std::size_t kLeastPoints = 3;

/// Twice the area; above zero for a contour that runs anticlockwise.
double areaOf(const std::vector<PlaneVector> &corners) {
  double area = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const PlaneVector &from = corners[i];
    const PlaneVector &to = corners[(i + 1) % corners.size()];
    area += from[0] * to[1] - to[0] * from[1];
  }
  return area;
}

enum class Place : std::uint8_t { Inside, Outside, Near };

/// By the sides that a ray crosses.
Place placeOf(const PlaneVector &point, const std::vector<PlaneVector> &corners, double near) {
  bool isInside = false;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const PlaneVector &from = corners[i];
    const PlaneVector &to = corners[(i + 1) % corners.size()];
    if (distanceToSide(point, from, to) <= near)
      return Place::Near;
    if ((from[1] > point[1]) != (to[1] > point[1]) &&
        point[0] < from[0] + (point[1] - from[1]) / (to[1] - from[1]) * (to[0] - from[0]))
      isInside = !isInside;
  }
  return isInside ? Place::Inside : Place::Outside;
}

/// The closed part of a way, and the points that lead there and away.
struct ClosedContour {
  std::vector<PlaneVector> corners;
  std::vector<PlaneVector> leads;
};

std::optional<ClosedContour> closedIn(const CompensatedWay &way) {
  const auto points = way.points();
  if (points.size() < kLeastPoints + 2)
    return std::nullopt;
  const double near = kClosed * extentOf(points);
  for (std::size_t length = points.size() - 1; length >= kLeastPoints; --length)
    for (std::size_t first = 1; first + length < points.size(); ++first)
      if (lengthOf(between(points[first], points[first + length])) <= near) {
        const auto at = [&](std::size_t index) { return points.begin() + static_cast<std::ptrdiff_t>(index); };
        ClosedContour contour{{at(first), at(first + length)}, {points.begin(), at(first)}};
        contour.leads.insert(contour.leads.end(), at(first + length + 1), points.end());
        return contour;
      }
  return std::nullopt;
}

/// The tool stands inside; only of a contour that has an area.
std::optional<bool> isInside(const CompensatedWay &way, const std::optional<ClosedContour> &contour) {
  const double area = contour ? areaOf(contour->corners) : 0;
  return area != 0 ? std::optional((area > 0) == way.isLeft) : std::nullopt;
}

class CompensationOnOtherSide final : public CompensatedWayRule {
public:
  using CompensatedWayRule::CompensatedWayRule;

private:
  /// The cutter stands on one side of the contour, and comes from the other one.
  bool isWrong(const CompensatedWay &way) const override {
    const auto contour = closedIn(way);
    const auto inside = isInside(way, contour);
    if (!inside || contour->leads.empty())
      return false;
    const double near = kClosed * extentOf(contour->corners);
    return std::ranges::all_of(contour->leads, [&](const PlaneVector &point) {
      return placeOf(point, contour->corners, near) == (*inside ? Place::Outside : Place::Inside);
    });
  }

  void tell(const CompensatedWay &way, const FileContext &context, const Reporter &reporter) const override {
    const Span code = codeOf(way);
    const bool inside = isInside(way, closedIn(way)).value_or(false);
    reporter.report(
        {.message = fmt::format("{} puts the cutter {} the contour, but it comes from {}", context.quoted(code),
                                inside ? "inside" : "outside", inside ? "outside" : "inside"),
         .span = code,
         .notes = {fmt::format("the contour runs {}: the cutter crosses it on its way there and cuts into "
                               "the part",
                               way.isLeft == inside ? "anticlockwise" : "clockwise"),
                   fmt::format("write `{}`, or turn the contour round", way.isLeft ? "G42" : "G41")}});
  }
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<CompensationOnOtherSide>(program, context);
}

} // namespace

extern const Rule compensationOnOtherSide;
const Rule compensationOnOtherSide{
    .info =
        {"compensation-on-other-side", Category::Motion, Severity::Warning,
         "Reports `G41` or `G42` round a closed contour that puts the cutter on one side of it, while it comes from "
         "the other side."},
    .hooks = {.watch = watch}};

} // namespace feedhold::rules::compensation_on_other_side
