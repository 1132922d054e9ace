#include "proof/geometry/gouge.h"

#include "base/support/check.h"
#include "proof/geometry/gouge_reach.h"
#include "proof/geometry/gouge_search.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace feedhold::geometry {

namespace {

/// Depths up to here come from rounding: the tool touches.
constexpr double kTouch = 1e-7;

bool isCutting(MoveKind kind) { return kind == MoveKind::Feed || isArc(kind); }

bool isFollowed(const RecordedMove &recorded) {
  return recorded.isOfTool && recorded.move.kind != MoveKind::Unmodelled && recorded.move.kind != MoveKind::Dwell;
}

/// Where no tool is known, its point.
Tool<double> toolOf(const PlainSpace &space) {
  const Tool<double> tool = space.tool.value_or(Tool<double>{0, 0});
  return {tool.radius, std::clamp(tool.corner, 0.0, std::max(0.0, tool.radius))};
}

/// Of points that are tried where nothing is known of how a depth changes.
double stepOf(const Tool<double> &tool) { return std::max(tool.radius / 4, 0.05); }

std::optional<Deepest> outsideOnPath(const PlainRegion &region, const ToolReach &reach, const GougePath &path,
                                     double floor) {
  const auto &parts = region.parts;
  const bool isConvexLine = path.isStraight() && std::all_of(parts.begin(), parts.end(), isConvex);
  const auto atEnds = [&](const PlainShape &part) {
    return std::max(reach.outside({"", {part}}, path.start()), reach.outside({"", {part}}, path.end()));
  };
  if (isConvexLine && parts.size() > 1 &&
      std::any_of(parts.begin(), parts.end(), [&](const PlainShape &part) { return atEnds(part) <= floor; }))
    return std::nullopt;
  const auto course = [&] {
    if (!std::all_of(parts.begin(), parts.end(), hasDistances))
      return Course::Any;
    if (parts.size() == 1 && std::holds_alternative<Box<double>>(parts.front()))
      return Course::SingleAxes;
    return isConvexLine && parts.size() == 1 ? Course::RisesToEnds : Course::NoFaster;
  };
  const Depth depth = [&](const Point<double> &point) { return reach.outside(region, point); };
  return deepestOnPath(path, {depth, course(), floor, stepOf(reach.tool())});
}

/// Axes that each go at a rate of their own may be anywhere in the box between the ends; the tool reaches up without
/// end, so that it is deepest at the lower end.
std::optional<Deepest> insideInBox(const PlainShape &part, const ToolReach &reach, const GougePath &path,
                                   double floor) {
  const Depth depth = [&](const Point<double> &point) { return reach.inside(part, point); };
  Point<double> low = path.start();
  Point<double> high = path.end();
  low[2] = high[2] = std::min(low[2], high[2]);
  const auto place = deepestInRectangle(part, low, high);
  if (!place) {
    const Course course = hasDistances(part) ? Course::NoFaster : Course::Any;
    return deepestInRectangle(low, high, {depth, course, floor, 2 * stepOf(reach.tool())});
  }
  const Point<double> point{(*place)[0], (*place)[1], low[2]};
  const double there = depth(point);
  return there > floor ? std::optional(Deepest{point, there}) : std::nullopt;
}

std::optional<Deepest> insideOnPath(const PlainShape &part, const ToolReach &reach, const GougePath &path,
                                    double floor) {
  const Depth depth = [&](const Point<double> &point) { return reach.inside(part, point); };
  const bool isHill = path.isStraight() && isConvex(part);
  const Course course = !hasDistances(part) ? Course::Any : isHill ? Course::RisesToOne : Course::NoFaster;
  return deepestOnPath(path, {depth, course, floor, stepOf(reach.tool())});
}

std::optional<Deepest> insideOfRegion(const PlainRegion &region, const ToolReach &reach,
                                      const Move<ConcreteValue> &move, const GougePath &path, double floor) {
  std::optional<Deepest> worst;
  for (const PlainShape &part : region.parts) {
    const double least = worst ? worst->depth : floor;
    const auto found = isInBox(move) ? insideInBox(part, reach, path, least) : insideOnPath(part, reach, path, least);
    if (found)
      worst = found;
  }
  return worst;
}

/// Rapid moves below the clearance height are free straight up, and straight down to where a cutting move has been
/// since any axis but Z last moved: back into the hole.
class ClearanceWatch {
public:
  explicit ClearanceWatch(double height) : height_(height) {}

  /// How deep a move is too low; absent: it is free wherever it is.
  std::optional<Deepest> follow(const RecordedMove &recorded, const GougePath &path) {
    const Point<double> &start = path.start();
    const Point<double> &end = path.end();
    if (!hole_ || !isSamePlace(*hole_, start))
      hole_.reset();
    const bool isUpright = path.isStraight() && isSamePlace(start, end) && !movesOtherAxis(recorded.move);
    std::optional<Deepest> found;
    if (recorded.move.kind == MoveKind::Rapid)
      found = isUpright ? depthUpright(start, end) : Deepest{lower(start, end), height_ - lower(start, end)[2]};
    if (isCutting(recorded.move.kind))
      hole_ = isUpright ? deeper(lower(start, end)) : end;
    else if (!isUpright)
      hole_.reset();
    return found;
  }
  void forget() { hole_.reset(); }

private:
  static bool movesOtherAxis(const Move<ConcreteValue> &move) {
    const auto isSame = [](const ConcreteValue &a, const ConcreteValue &b) { return a.number == b.number; };
    return std::ranges::any_of(kAllAxes, [&](Axis axis) { return axis > Axis::Z && mayMove(move, axis, isSame); });
  }
  static bool isSamePlace(const Point<double> &a, const Point<double> &b) {
    constexpr double kSame = 1e-9;
    return std::abs(a[0] - b[0]) <= kSame && std::abs(a[1] - b[1]) <= kSame;
  }
  static Point<double> lower(const Point<double> &a, const Point<double> &b) { return a[2] < b[2] ? a : b; }
  Point<double> deeper(const Point<double> &point) const { return hole_ ? lower(*hole_, point) : point; }
  std::optional<Deepest> depthUpright(const Point<double> &start, const Point<double> &end) const {
    if (end[2] >= start[2])
      return std::nullopt;
    const double floor = hole_ ? std::min(height_, (*hole_)[2]) : height_;
    return Deepest{end, floor - end[2]};
  }

  double height_;
  std::optional<Point<double>> hole_; // the lowest point cut at the present X Y
};

/// The deepest point of all moves, above `floor`.
class Run {
public:
  Run(const PlainSpace &space, SpaceClaim claim, std::size_t region, const MoveFilter &filter, double floor)
      : space_(space), tool_(toolOf(space)), reach_(tool_, isOfToolBesidePath(claim) ? space.corner : 0), claim_(claim),
        region_(region), filter_(filter), floor_(floor), clearance_(space.clearance.value_or(0) + reach_.beside()) {}

  std::optional<Gouge> deepest(std::span<const RecordedMove> moves) {
    std::optional<Gouge> worst;
    for (std::size_t i = 0; i < moves.size(); ++i) {
      if (!concerns(moves[i]))
        continue;
      forEachOfClaim(moves[i], [&](const RecordedMove &move) {
        if (const auto found = deeperThan(worst ? worst->depth + kDeeper : floor_, move))
          worst = Gouge{i, found->at, found->depth, isBelow(move) ? space_.longest : std::nullopt, reach_.beside()};
      });
    }
    if (worst && space_.tip)
      worst->at = fromHalfPlane(worst->at, *space_.tip, claim_ == SpaceClaim::Travel ? 0 : tool_.radius);
    for (std::size_t axis = 0; worst && claim_ == SpaceClaim::Machine && axis < worst->at.size(); ++axis)
      worst->at[axis] += moves[worst->move].zero[axis] - moves[worst->move].machineZero[axis];
    return worst;
  }
  /// What is deeper than is known of its block.
  void deepen(std::map<Place, double> &depths, std::span<const RecordedMove> moves) {
    for (const RecordedMove &recorded : moves) {
      const auto known = depths.find(recorded.own);
      double floor = known != depths.end() ? known->second + kDeeper : floor_;
      forEachOfClaim(recorded, [&](const RecordedMove &move) {
        if (const auto found = deeperThan(floor, move)) {
          depths.insert_or_assign(recorded.own, found->depth);
          floor = found->depth + kDeeper;
        }
      });
    }
  }

private:
  /// The moves that the claim is about, where it means them.
  template <typename Look> void forEachOfClaim(const RecordedMove &recorded, const Look &look) const {
    if (claim_ == SpaceClaim::Travel) // limits are those of programmed points
      return space_.tip ? look(inHalfPlane(recorded, *space_.tip, 0)) : look(recorded);
    if (recorded.centre.empty())
      return lookAtPlaced(recorded, look);
    for (const RecordedMove &move : movesOfTip(recorded))
      lookAtPlaced(move, look);
  }
  template <typename Look> void lookAtPlaced(const RecordedMove &move, const Look &look) const {
    if (space_.tip)
      return look(inHalfPlane(move, *space_.tip, tool_.radius)); // the centre of the nose is meant
    if (claim_ == SpaceClaim::Machine)
      return look(inMachine(move));
    return space_.knowsLengths ? look(ofTip(move)) : look(move);
  }
  std::optional<Deepest> deeperThan(double floor, const RecordedMove &move) {
    const auto found = depthOf(move, floor);
    return found && found->depth > floor ? found : std::nullopt;
  }
  /// Whether rapid moves are free below the clearance height depends on those before them.
  bool concerns(const RecordedMove &move) const { return claim_ == SpaceClaim::Clearance || !filter_ || filter_(move); }
  std::optional<Deepest> depthOf(const RecordedMove &recorded, double floor) {
    const std::optional<GougePath> path = isFollowed(recorded) ? std::optional(GougePath(recorded)) : std::nullopt;
    if (!path || !std::isfinite(path->length())) {
      if (recorded.move.kind != MoveKind::Dwell)
        clearance_.forget();
      return std::nullopt;
    }
    const auto tooLow =
        space_.clearance && claim_ == SpaceClaim::Clearance ? clearance_.follow(recorded, *path) : std::nullopt;
    if (filter_ && !filter_(recorded))
      return std::nullopt;
    switch (claim_) {
    case SpaceClaim::KeepIn:
      if (!isCutting(recorded.move.kind))
        return std::nullopt;
      return outsideOnPath(space_.keepIn[region_], reach_, *path, floor);
    case SpaceClaim::KeepOut: return insideOfRegion(space_.keepOut[region_], reach_, recorded.move, *path, floor);
    case SpaceClaim::Clearance: return tooLow;
    case SpaceClaim::Travel: return outsideOfLimits(space_.travel, *path, floor);
    case SpaceClaim::Machine: return outsideOfLimits(space_.machine, *path, floor);
    }
    FEEDHOLD_UNREACHABLE("the switch names every claim");
  }
  static std::optional<Deepest> outsideOfLimits(const std::optional<Box<double>> &limits, const GougePath &path,
                                                double floor) {
    if (!limits)
      return std::nullopt;
    const Depth depth = [&](const Point<double> &point) { return depthOutside(*limits, point); };
    return deepestOnPath(path, {depth, Course::SingleAxes, floor, 0});
  }
  bool isOfTip() const { return claim_ != SpaceClaim::Machine && claim_ != SpaceClaim::Travel; }
  /// The tip is lower than its coordinates by the length of the tool.
  bool isBelow(const RecordedMove &move) const {
    return isOfTip() && space_.knowsLengths && move.length == LengthInForce::None;
  }
  /// Where the contract tells lengths, as G43 takes them.
  RecordedMove ofTip(RecordedMove move) const {
    move.isOfTool = move.isOfToolButForLength && move.length != LengthInForce::Subtracted;
    if (isBelow(move)) {
      move.zero[2] -= space_.longest.value_or(0);
      move.isOfTool = move.isOfTool && space_.longest;
    }
    return move;
  }
  /// Machine coordinates are known whatever the length of the tool.
  static RecordedMove inMachine(RecordedMove move) {
    move.zero = move.machineZero;
    move.isOfTool = move.isOfAxes;
    return move;
  }

  const PlainSpace &space_;
  Tool<double> tool_;
  ToolReach reach_;
  SpaceClaim claim_;
  std::size_t region_;
  const MoveFilter &filter_;
  double floor_;
  ClearanceWatch clearance_;
};

/// Of one block, and in the same place; where the tool leaves the programmed path, that is not looked at.  Work offsets
/// are inputs of each program, and only one claim asks for them.
bool isSameFor(SpaceClaim claim, const RecordedMove &a, const RecordedMove &b) {
  const auto isSame = [](const ConcreteValue &left, const ConcreteValue &right) { return left.number == right.number; };
  const auto parts = [](const RecordedMove &move) {
    return std::tuple(move.own, move.move.kind, move.move.turns, move.zero, move.isOfTool, move.isOfToolButForLength,
                      move.length, move.isOfAxes, move.move.plane.first, move.move.plane.second,
                      move.move.plane.normal);
  };
  return parts(a) == parts(b) && a.centre.empty() && b.centre.empty() &&
         (claim != SpaceClaim::Machine || a.machineZero == b.machineZero) &&
         std::ranges::equal(a.move.start, b.move.start, isSame) && std::ranges::equal(a.move.end, b.move.end, isSame) &&
         isSame(a.move.firstCentre, b.move.firstCentre) && isSame(a.move.secondCentre, b.move.secondCentre);
}

} // namespace

bool isOfToolBesidePath(SpaceClaim claim) {
  switch (claim) {
  case SpaceClaim::KeepIn:
  case SpaceClaim::KeepOut:
  case SpaceClaim::Clearance: return true;
  case SpaceClaim::Travel:
  case SpaceClaim::Machine: return false;
  }
  FEEDHOLD_UNREACHABLE("the switch names every claim");
}

std::optional<Gouge> deepestGouge(const PlainSpace &space, SpaceClaim claim, std::size_t region,
                                  std::span<const RecordedMove> moves, const MoveFilter &filter) {
  return Run(space, claim, region, filter, kTouch).deepest(moves);
}

std::optional<double> smallestMargin(const PlainSpace &space, SpaceClaim claim, std::size_t region,
                                     std::span<const RecordedMove> moves, const MoveFilter &filter) {
  const auto nearest = Run(space, claim, region, filter, kNoDepth).deepest(moves);
  return nearest ? std::optional(std::max(0.0, -nearest->depth)) : std::nullopt;
}

BlockDepths BlockDepths::ofGouges(SpaceClaim claim, std::size_t region) { return {claim, region, kTouch}; }

BlockDepths BlockDepths::ofMargins(SpaceClaim claim, std::size_t region) { return {claim, region, kNoDepth}; }

void BlockDepths::add(const PlainSpace &space, std::span<const RecordedMove> moves) {
  const auto isSame = [&](const RecordedMove &a, const RecordedMove &b) { return isSameFor(claim_, a, b); };
  if (!space_ || !std::ranges::equal(moves, moves_, isSame) || !(space == *space_))
    Run(space, claim_, region_, {}, floor_).deepen(depths_, moves);
  space_ = &space;
  moves_ = moves;
}

Point<double> pointOf(const RecordedMove &move, double share) { return GougePath(move).at(share); }

} // namespace feedhold::geometry
