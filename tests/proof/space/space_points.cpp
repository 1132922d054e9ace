#include "proof/space/space_points.h"

#include "base/support/match.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace feedhold::proof_tests {

using geometry::PlainShape;
using geometry::PlainSpace;
using geometry::SpaceClaim;
using soundness::Random;

namespace {

constexpr int kTips = 14;
constexpr double kTwoPi = 2 * std::numbers::pi;

double fraction(Random &random) { return static_cast<double>(random.below(4097)) / 4096; }

bool isCutting(MoveKind kind) { return kind == MoveKind::Feed || isArc(kind); }

/// Ends of their own for what comes often: the two ends of the way.
double share(Random &random) {
  const std::uint32_t way = random.below(4);
  return way == 0 ? 0 : way == 1 ? 1 : fraction(random);
}

SpacePoint inSpace(const RecordedMove &recorded, const std::array<ConcreteValue, kAxisCount> &point) {
  SpacePoint result;
  for (std::size_t i = 0; i < 3; ++i)
    result[i] = point[i].number + recorded.zero[i];
  return result;
}

SpacePoint onArc(const RecordedMove &recorded, double part) {
  const auto &move = recorded.move;
  const std::size_t first = indexOf(move.plane.first), second = indexOf(move.plane.second);
  const SpacePoint start = inSpace(recorded, move.start);
  const SpacePoint end = inSpace(recorded, move.end);
  const double middle[2] = {move.firstCentre.number + recorded.zero[first],
                            move.secondCentre.number + recorded.zero[second]};
  const double from = std::atan2(start[second] - middle[1], start[first] - middle[0]);
  const double to = std::atan2(end[second] - middle[1], end[first] - middle[0]);
  const double sign = move.kind == MoveKind::ArcCounterclockwise ? 1 : -1;
  double turn = sign * (to - from);
  while (turn <= 1e-9)
    turn += kTwoPi;
  turn += kTwoPi * (move.turns - 1);
  const double startRadius = std::hypot(start[first] - middle[0], start[second] - middle[1]);
  const double endRadius = std::hypot(end[first] - middle[0], end[second] - middle[1]);
  const double radius = startRadius + part * (endRadius - startRadius);
  SpacePoint point;
  for (std::size_t i = 0; i < 3; ++i)
    point[i] = start[i] + part * (end[i] - start[i]);
  point[first] = middle[0] + radius * std::cos(from + sign * part * turn);
  point[second] = middle[1] + radius * std::sin(from + sign * part * turn);
  return point;
}

// ---- shapes that are larger by `more` on all sides, or smaller ----

bool isIn(const geometry::Interval<double> &interval, double value, double more) {
  return (!interval.low || value >= *interval.low - more) && (!interval.high || value <= *interval.high + more);
}
/// By the sum of the angles under which the sides are seen.
bool isIn(const std::vector<std::array<double, 2>> &corners, double x, double y, double more) {
  double angle = 0, nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto [ax, ay] = corners[i];
    const auto [bx, by] = corners[(i + 1) % corners.size()];
    angle += std::atan2((ax - x) * (by - y) - (ay - y) * (bx - x), (ax - x) * (bx - x) + (ay - y) * (by - y));
    const double along = std::clamp(((x - ax) * (bx - ax) + (y - ay) * (by - ay)) /
                                        std::max(1e-30, (bx - ax) * (bx - ax) + (by - ay) * (by - ay)),
                                    0.0, 1.0);
    nearest = std::min(nearest, std::hypot(ax + along * (bx - ax) - x, ay + along * (by - ay) - y));
  }
  const bool isInside = std::fabs(angle) > std::numbers::pi;
  return more >= 0 ? isInside || nearest <= more : isInside && nearest >= -more;
}

bool holdsAround(const geometry::Condition<double, bool> &condition, const SpacePoint &point, double more) {
  bool all = true, any = false;
  for (int i = 0; i < 7; ++i) {
    SpacePoint beside = point;
    if (i < 6)
      beside[static_cast<std::size_t>(i / 2)] += i % 2 == 0 ? more : -more;
    const bool holds = condition.holds(beside);
    all = all && holds;
    any = any || holds;
  }
  return more >= 0 ? any : all;
}

bool contains(const PlainShape &part, const SpacePoint &point, double more) {
  return match(
      part,
      [&](const geometry::Box<double> &box) {
        return isIn(box.sides[0], point[0], more) && isIn(box.sides[1], point[1], more) &&
               isIn(box.sides[2], point[2], more);
      },
      [&](const geometry::Cylinder<double> &cylinder) {
        const std::size_t along = indexOf(cylinder.axis);
        const std::size_t first = along == 0 ? 1 : 0, second = along == 2 ? 1 : 2;
        return std::hypot(point[first] - cylinder.centre[0], point[second] - cylinder.centre[1]) <=
                   cylinder.radius + more &&
               isIn(cylinder.along, point[along], more);
      },
      [&](const geometry::Sphere<double> &sphere) {
        return std::hypot(point[0] - sphere.centre[0], point[1] - sphere.centre[1], point[2] - sphere.centre[2]) <=
               sphere.radius + more;
      },
      [&](const geometry::Prism<double> &prism) {
        return isIn(prism.height, point[2], more) && isIn(prism.corners, point[0], point[1], more);
      },
      [&](const geometry::Condition<double, bool> &condition) { return holdsAround(condition, point, more); });
}

/// The point, and some below or above it.
template <typename Has> bool onColumn(SpacePoint point, double direction, const Has &has) {
  constexpr double kSteps[] = {0, 0.01, 0.1, 0.3, 0.6, 1, 1.5, 2, 3, 4, 5, 7, 9, 12, 16, 20, 30, 50, 80, 150};
  const double from = point[2];
  return std::any_of(std::begin(kSteps), std::end(kSteps), [&](double step) {
    point[2] = from + direction * step;
    return has(point);
  });
}
/// Heights where a region is widest may lie between the steps.
bool containsBelow(const PlainShape &part, const SpacePoint &point, double more) {
  SpacePoint level = point;
  const auto atLevel = [&](double z) {
    level[2] = std::min(point[2], z);
    return contains(part, level, more);
  };
  const bool widest = match(
      part, [&](const geometry::Sphere<double> &sphere) { return atLevel(sphere.centre[2]); },
      [&](const geometry::Cylinder<double> &cylinder) {
        return cylinder.axis == Axis::Z ? atLevel(cylinder.along.high.value_or(point[2])) : atLevel(cylinder.centre[1]);
      },
      [&](const geometry::Prism<double> &prism) { return atLevel(prism.height.high.value_or(point[2])); },
      [&](const geometry::Box<double> &box) { return atLevel(box.sides[2].high.value_or(point[2])); },
      [](const geometry::Condition<double, bool> &) { return false; });
  return widest || onColumn(point, -1, [&](const SpacePoint &below) { return contains(part, below, more); });
}

// ---- points of the tool ----

double endHeight(const geometry::Tool<double> &tool, double radius) {
  const double onRim = std::max(0.0, radius - (tool.radius - tool.corner));
  return tool.corner - std::sqrt(std::max(0.0, tool.corner * tool.corner - onRim * onRim));
}
/// A point of the border of its cutting end.
SpacePoint endPoint(const geometry::Tool<double> &tool, const SpacePoint &tip, Random &random) {
  const double away = random.oneIn(2) ? 1 : fraction(random);
  const double angle = kTwoPi * static_cast<double>(random.below(16)) / 16 + (random.oneIn(2) ? 0 : fraction(random));
  const double radius = tool.radius * away;
  return {tip[0] + radius * std::cos(angle), tip[1] + radius * std::sin(angle), tip[2] + endHeight(tool, radius)};
}

bool isOutside(const geometry::PlainRegion &region, const SpacePoint &point, double depth) {
  return std::none_of(region.parts.begin(), region.parts.end(),
                      [&](const PlainShape &part) { return containsBelow(part, point, depth); });
}
bool isInside(const geometry::PlainRegion &region, const SpacePoint &point, double depth) {
  return std::any_of(region.parts.begin(), region.parts.end(), [&](const PlainShape &part) {
    return onColumn(point, 1, [&](const SpacePoint &above) { return contains(part, above, -depth); });
  });
}

/// The middle of a part, or so: what is small lies between the points that are tried.
std::optional<SpacePoint> middleOf(const PlainShape &part, const SpacePoint &tip) {
  const auto of = [&](const geometry::Interval<double> &interval, std::size_t axis) {
    const double low = interval.low.value_or(interval.high.value_or(tip[axis]));
    return (low + interval.high.value_or(low)) / 2;
  };
  using Middle = std::optional<SpacePoint>;
  return match(
      part,
      [&](const geometry::Box<double> &box) {
        return Middle({of(box.sides[0], 0), of(box.sides[1], 1), of(box.sides[2], 2)});
      },
      [&](const geometry::Cylinder<double> &cylinder) {
        const std::size_t along = indexOf(cylinder.axis);
        SpacePoint middle{};
        middle[along == 0 ? 1 : 0] = cylinder.centre[0];
        middle[along == 2 ? 1 : 2] = cylinder.centre[1];
        middle[along] = of(cylinder.along, along);
        return Middle(middle);
      },
      [](const geometry::Sphere<double> &sphere) { return Middle(sphere.centre); },
      [&](const geometry::Prism<double> &prism) {
        SpacePoint middle{0, 0, of(prism.height, 2)};
        for (const auto &[x, y] : prism.corners) {
          middle[0] += x / static_cast<double>(prism.corners.size());
          middle[1] += y / static_cast<double>(prism.corners.size());
        }
        return Middle(middle);
      },
      [](const geometry::Condition<double, bool> &) { return Middle(); });
}
/// The point of the tool's end that is nearest to the middle of a part.
SpacePoint towards(const geometry::Tool<double> &tool, const SpacePoint &tip, const SpacePoint &middle) {
  const double away = std::hypot(middle[0] - tip[0], middle[1] - tip[1]);
  const double radius = std::min(away, tool.radius);
  const double share = away == 0 ? 0 : radius / away;
  return {tip[0] + share * (middle[0] - tip[0]), tip[1] + share * (middle[1] - tip[1]),
          tip[2] + endHeight(tool, radius)};
}

// ---- lathes: Z and the radius, in which regions lie flat (half_plane.h), by a way of their own ----

RecordedMove byRadius(RecordedMove recorded) {
  recorded.zero[0] /= 2;
  for (auto *point : {&recorded.move.start, &recorded.move.end})
    (*point)[0].number /= 2;
  (recorded.move.plane.first == Axis::X ? recorded.move.firstCentre : recorded.move.secondCentre).number /= 2;
  return recorded;
}
/// `point`: X as a radius, Y, Z of the programmed point.
SpacePoint noseAt(const PlainSpace &space, const SpacePoint &point, SpaceClaim claim) {
  const double radius = claim == SpaceClaim::Travel || !space.tool ? 0 : space.tool->radius;
  return {point[2] - radius * space.tip->z, point[0] - radius * space.tip->x, 0};
}

bool isMeant(const RecordedMove &recorded, SpaceClaim claim) {
  const MoveKind kind = recorded.move.kind;
  if (!recorded.isOfTool)
    return false;
  return claim == SpaceClaim::KeepIn      ? isCutting(kind)
         : claim == SpaceClaim::Clearance ? kind == MoveKind::Rapid
                                          : isCutting(kind) || kind == MoveKind::Rapid;
}

/// Where the tool is wrong on a move, and the wrong point of it.
std::optional<std::pair<SpacePoint, SpacePoint>> seenOn(const PlainSpace &space, SpaceClaim claim, std::size_t region,
                                                        const RecordedMove &move, double depth, Random &random) {
  const SpacePoint start = inSpace(move, move.move.start), end = inSpace(move, move.move.end);
  const bool goesAcross = std::hypot(start[0] - end[0], start[1] - end[1]) > depth;
  if (claim == SpaceClaim::Clearance && goesAcross &&
      std::min(start[2], end[2]) - space.corner < *space.clearance - depth)
    return std::pair(start, end);
  for (int tip = 0; tip < kTips; ++tip) {
    const SpacePoint at = space.tip ? noseAt(space, anyTip(byRadius(move), random), claim) : anyTip(move, random);
    const SpacePoint beside = anyBeside(space, claim, at, random);
    if (const auto wrong = wrongPoint(space, claim, region, beside, depth, random))
      return std::pair(beside, *wrong);
  }
  return std::nullopt;
}

} // namespace

SpacePoint anyTip(const RecordedMove &recorded, Random &random) {
  const SpacePoint start = inSpace(recorded, recorded.move.start), end = inSpace(recorded, recorded.move.end);
  if (isArc(recorded.move.kind))
    return onArc(recorded, share(random));
  SpacePoint point;
  const double part = share(random);
  for (std::size_t i = 0; i < 3; ++i)
    point[i] = start[i] + (isInBox(recorded.move) ? share(random) : part) * (end[i] - start[i]);
  return point;
}

std::optional<SpacePoint> wrongPoint(const PlainSpace &space, SpaceClaim claim, std::size_t region,
                                     const SpacePoint &tip, double depth, Random &random) {
  constexpr int kPoints = 40;
  if (claim == SpaceClaim::Travel)
    return space.travel && !contains(*space.travel, tip, depth) ? std::optional(tip) : std::nullopt;
  if (claim == SpaceClaim::Clearance) // whether it moves across is not seen at one point
    return std::nullopt;
  const geometry::Tool<double> tool = space.tool.value_or(geometry::Tool<double>{0, 0});
  if (claim == SpaceClaim::KeepIn) {
    const auto &parts = space.keepIn[region].parts;
    if (std::none_of(parts.begin(), parts.end(), [&](const PlainShape &part) { return contains(part, tip, depth); }))
      return tip;
  } else {
    for (const PlainShape &part : space.keepOut[region].parts)
      if (const auto middle = middleOf(part, tip))
        for (const double level : {tip[2], (*middle)[2]}) {
          SpacePoint point = towards(tool, tip, *middle);
          point[2] = std::max(point[2], level);
          if (isInside(space.keepOut[region], point, depth))
            return point;
        }
  }
  for (int i = 0; i < kPoints; ++i) {
    const SpacePoint point = endPoint(tool, tip, random);
    if (claim == SpaceClaim::KeepIn ? isOutside(space.keepIn[region], point, depth)
                                    : isInside(space.keepOut[region], point, depth))
      return point;
  }
  return std::nullopt;
}

SpacePoint anyBeside(const PlainSpace &space, SpaceClaim claim, SpacePoint tip, Random &random) {
  if (space.corner == 0 || (claim != SpaceClaim::KeepIn && claim != SpaceClaim::KeepOut))
    return tip;
  SpacePoint way;
  do
    for (double &coordinate : way)
      coordinate = random.oneIn(3) ? 0 : 2 * fraction(random) - 1;
  while (std::hypot(way[0], way[1], way[2]) == 0);
  const double length = space.corner * share(random) / std::hypot(way[0], way[1], way[2]);
  for (std::size_t i = 0; i < 3; ++i)
    tip[i] += length * way[i];
  return tip;
}

SpacePoint toolAt(const PlainSpace &space, SpaceClaim claim, const SpacePoint &programmed) {
  return space.tip ? noseAt(space, {programmed[0] / 2, programmed[1], programmed[2]}, claim) : programmed;
}

std::optional<SeenGouge> seenGouge(const PlainSpace &space, SpaceClaim claim, std::size_t region,
                                   std::span<const RecordedMove> moves, Place own, double depth, Random &random) {
  for (std::size_t i = 0; i < moves.size(); ++i) {
    if (moves[i].own != own || !isMeant(moves[i], claim))
      continue;
    const std::vector<RecordedMove> made = claim == SpaceClaim::Travel ? std::vector{moves[i]} : movesOfTip(moves[i]);
    for (const RecordedMove &move : made)
      if (const auto seen = seenOn(space, claim, region, move, depth, random))
        return SeenGouge{i, seen->first, seen->second};
  }
  return std::nullopt;
}

} // namespace feedhold::proof_tests
