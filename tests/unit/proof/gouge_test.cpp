// Gouges against distances that can be worked out by hand.
#include "proof/geometry/gouge.h"

#include <chrono>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace feedhold::geometry {
namespace {

constexpr double kNear = 1e-5;

RecordedMove moveOf(MoveKind kind, const Point<double> &start, const Point<double> &end) {
  const Place nowhere{FileId(0), NodeId(0)};
  RecordedMove recorded{.move = {}, .unit = LengthUnit::Millimetre, .place = nowhere, .own = nowhere};
  recorded.move.kind = kind;
  for (std::size_t i = 0; i < 3; ++i) {
    recorded.move.start[i] = ConcreteValue::of(start[i]);
    recorded.move.end[i] = ConcreteValue::of(end[i]);
  }
  return recorded;
}
RecordedMove feed(const Point<double> &start, const Point<double> &end) { return moveOf(MoveKind::Feed, start, end); }
RecordedMove rapid(const Point<double> &start, const Point<double> &end) { return moveOf(MoveKind::Rapid, start, end); }
RecordedMove arc(MoveKind kind, const Point<double> &start, const Point<double> &end, double first, double second,
                 Plane plane = kPlaneXY) {
  RecordedMove recorded = moveOf(kind, start, end);
  recorded.move.plane = plane;
  recorded.move.firstCentre = ConcreteValue::of(first);
  recorded.move.secondCentre = ConcreteValue::of(second);
  return recorded;
}

PlainSpace keepIn(Tool<double> tool, std::vector<PlainShape> parts) {
  return {.tool = tool, .keepIn = {{"CAVITY", std::move(parts)}}, .keepOut = {}, .clearance = {}, .travel = {}};
}
PlainSpace keepOut(Tool<double> tool, std::vector<PlainShape> parts) {
  return {.tool = tool, .keepIn = {}, .keepOut = {{"CLAMP", std::move(parts)}}, .clearance = {}, .travel = {}};
}
constexpr Tool<double> flat(double radius) { return {radius, 0}; }
constexpr Tool<double> ball(double radius) { return {radius, radius}; }

double depthIn(const PlainSpace &space, const std::vector<RecordedMove> &moves) {
  const auto gouge = deepestGouge(space, SpaceClaim::KeepIn, 0, moves);
  return gouge ? gouge->depth : 0;
}
double depthOut(const PlainSpace &space, const std::vector<RecordedMove> &moves) {
  const auto gouge = deepestGouge(space, SpaceClaim::KeepOut, 0, moves);
  return gouge ? gouge->depth : 0;
}
double marginIn(const PlainSpace &space, const std::vector<RecordedMove> &moves) {
  return smallestMargin(space, SpaceClaim::KeepIn, 0, moves).value_or(-1);
}
double marginOut(const PlainSpace &space, const std::vector<RecordedMove> &moves) {
  return smallestMargin(space, SpaceClaim::KeepOut, 0, moves).value_or(-1);
}

PlainShape box(Interval<double> x, Interval<double> y, Interval<double> z) { return Box<double>{{x, y, z}}; }
const PlainShape kPocket = box({-50, 50}, {-30, 30}, {-20, 5});

// ---- where the tool is ----

void expectPoint(const Point<double> &point, const Point<double> &wanted) {
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(point[i], wanted[i], 1e-9) << "axis " << i;
}

TEST(PointOf, LinesAndArcsOfAllPlanes) {
  expectPoint(pointOf(feed({0, 0, 0}, {10, 20, -4}), 0.25), {2.5, 5, -1});
  expectPoint(pointOf(arc(MoveKind::ArcCounterclockwise, {10, 0, 0}, {0, 10, -4}, 0, 0), 0.5),
              {10 * std::numbers::sqrt2 / 2, 10 * std::numbers::sqrt2 / 2, -2});
  expectPoint(pointOf(arc(MoveKind::ArcClockwise, {10, 0, 0}, {-10, 0, 0}, 0, 0), 0.5), {0, -10, 0});
  // G18: from Z to X; counterclockwise seen from +Y
  expectPoint(pointOf(arc(MoveKind::ArcCounterclockwise, {0, 0, 10}, {0, 0, -10}, 0, 0, kPlaneZX), 0.5), {10, 0, 0});
  expectPoint(pointOf(arc(MoveKind::ArcClockwise, {0, 10, 0}, {0, -10, 0}, 0, 0, kPlaneYZ), 0.5), {0, 0, -10});
}

TEST(PointOf, FullCirclesTurnsAndShiftedZeros) {
  RecordedMove helix = arc(MoveKind::ArcCounterclockwise, {10, 0, 0}, {10, 0, -8}, 0, 0);
  expectPoint(pointOf(helix, 0.5), {-10, 0, -4});
  helix.move.turns = 2;
  expectPoint(pointOf(helix, 0.5), {10, 0, -4});
  expectPoint(pointOf(helix, 0.25), {-10, 0, -2});
  helix.zero = {100, 0, 1};
  expectPoint(pointOf(helix, 0.25), {90, 0, -1});
  expectPoint(pointOf(helix, 1), {110, 0, -7});
}

// ---- keep in ----

TEST(KeepIn, BoxLeavesRoomForTheRadius) {
  const PlainSpace space = keepIn(flat(6), {kPocket});
  const std::vector inside{feed({0, 0, 5}, {0, 0, -20}), feed({0, 0, -20}, {44, 24, -20})};
  EXPECT_EQ(depthIn(space, inside), 0);
  EXPECT_NEAR(marginIn(space, inside), 0, kNear);
  EXPECT_NEAR(marginIn(space, {feed({0, 0, -10}, {40, 21, -10})}), 3, kNear);
  const auto gouge = deepestGouge(space, SpaceClaim::KeepIn, 0,
                                  std::vector{feed({0, 0, 0}, {40, 0, 0}), feed({40, 0, 0}, {44.25, 0, -5})});
  ASSERT_TRUE(gouge);
  EXPECT_EQ(gouge->move, 1U);
  EXPECT_NEAR(gouge->depth, 0.25, kNear);
  expectPoint(gouge->at, {44.25, 0, -5});
  EXPECT_NEAR(depthIn(space, {feed({0, 0, 0}, {0, 0, -20.5})}), 0.5, kNear);
  EXPECT_NEAR(depthIn(space, {feed({0, 0, 7}, {0, 0, 0})}), 2, kNear); // above the region
}

TEST(KeepIn, OnlyCuttingMovesThatAreFollowed) {
  const PlainSpace space = keepIn(flat(6), {kPocket});
  RecordedMove compensated = feed({0, 0, 0}, {90, 0, 0});
  compensated.isOfTool = false;
  EXPECT_EQ(
      depthIn(space, {rapid({0, 0, 0}, {90, 0, 0}), compensated, moveOf(MoveKind::Unmodelled, {0, 0, 0}, {90, 0, 0}),
                      moveOf(MoveKind::Dwell, {90, 0, 0}, {90, 0, 0})}),
      0);
  EXPECT_EQ(smallestMargin(space, SpaceClaim::KeepIn, 0, std::vector{compensated}), std::nullopt);
}

TEST(KeepIn, ArcThatBulgesOutBetweenItsEnds) {
  // From (30, -10) to (30, 10) about (30, 0), by way of (40, 0).
  const RecordedMove bulge = arc(MoveKind::ArcCounterclockwise, {30, -10, 0}, {30, 10, 0}, 30, 0);
  EXPECT_NEAR(depthIn(keepIn(flat(12), {kPocket}), {bulge}), 2, kNear);
  EXPECT_EQ(depthIn(keepIn(flat(10), {kPocket}), {bulge}), 0);
  const RecordedMove inwards = arc(MoveKind::ArcClockwise, {30, -10, 0}, {30, 10, 0}, 30, 0);
  EXPECT_EQ(depthIn(keepIn(flat(12), {kPocket}), {inwards}), 0);
}

TEST(KeepIn, HelixInACylinder) {
  const PlainShape hole = Cylinder<double>{Axis::Z, {5, 0}, 16, {-30, 2}};
  RecordedMove helix = arc(MoveKind::ArcCounterclockwise, {15, 0, 0}, {15, 0, -25}, 5, 0);
  helix.move.turns = 10;
  EXPECT_NEAR(marginIn(keepIn(flat(4), {hole}), {helix}), 2, kNear);
  EXPECT_NEAR(depthIn(keepIn(flat(6.5), {hole}), {helix}), 0.5, kNear);
  RecordedMove beside = arc(MoveKind::ArcCounterclockwise, {16, 0, 0}, {16, 0, -25}, 6, 0);
  EXPECT_NEAR(depthIn(keepIn(flat(6), {hole}), {beside}), 1, kNear);
}

TEST(KeepIn, BallInASphere) {
  // The middle of the ball may be up to 20 - 5 from the middle of the sphere.
  const PlainShape sphere = Sphere<double>{{0, 0, 0}, 20};
  EXPECT_NEAR(depthIn(keepIn(ball(5), {sphere}), {feed({0, 0, 0}, {0, 0, -20})}), 0, kNear);
  EXPECT_NEAR(depthIn(keepIn(ball(5), {sphere}), {feed({0, 0, 0}, {9, 0, -17.5})}), std::hypot(9, 12.5) - 15, kNear);
  EXPECT_NEAR(depthIn(keepIn(flat(5), {sphere}), {feed({0, 0, 0}, {0, 0, -20})}), std::hypot(5, 20) - 20, kNear);
  // Above the equator the shank is what counts: the region and all that lies above it.
  EXPECT_NEAR(depthIn(keepIn(ball(5), {sphere}), {feed({0, 0, 0}, {16, 0, 5})}), 1, kNear);
}

TEST(KeepIn, LyingCylinder) {
  const PlainShape groove = Cylinder<double>{Axis::X, {0, 0}, 20, {-40, 40}};
  EXPECT_EQ(depthIn(keepIn(ball(5), {groove}), {feed({-35, 0, -20}, {35, 0, -20})}), 0);
  EXPECT_NEAR(depthIn(keepIn(ball(5), {groove}), {feed({-36, 0, -20}, {35, 0, -20})}), 1, kNear);
  EXPECT_NEAR(depthIn(keepIn(ball(5), {groove}), {feed({0, 0, -15}, {0, 9, -17.5})}), std::hypot(9, 12.5) - 15, kNear);
  const PlainShape other = Cylinder<double>{Axis::Y, {0, 0}, 20, {}};
  EXPECT_NEAR(depthIn(keepIn(flat(5), {other}), {feed({0, -900, -20}, {0, 900, -20})}), std::hypot(5, 20) - 20, kNear);
}

TEST(KeepIn, PolygonThatIsNotConvex) {
  // An L: the ends are in it, the way between them crosses the corner that stands in.
  const PlainShape angle = Prism<double>{{{0, 0}, {40, 0}, {40, 10}, {10, 10}, {10, 40}, {0, 40}}, {-5, 5}};
  EXPECT_EQ(depthIn(keepIn(flat(4), {angle}), {feed({5, 35, 0}, {5, 5, 0}), feed({5, 5, 0}, {35, 5, 0})}), 0);
  EXPECT_NEAR(marginIn(keepIn(flat(4), {angle}), {feed({5, 35, 0}, {5, 5, 0})}), 1, kNear);
  // (20, 20) is in the middle of the way: 10 outside, and the radius.
  EXPECT_NEAR(depthIn(keepIn(flat(4), {angle}), {feed({5, 35, 0}, {35, 5, 0})}), 14, kNear);
}

TEST(KeepIn, PartsTogether) {
  const PlainShape left = box({0, 40}, {0, 10}, {-5, 5});
  const PlainShape lower = box({0, 10}, {0, 40}, {-5, 5});
  const PlainSpace space = keepIn(flat(4), {left, lower});
  EXPECT_EQ(depthIn(space, {feed({35, 5, 0}, {5, 5, 0}), feed({5, 5, 0}, {5, 35, 0})}), 0);
  // Half in one box and half in the other.
  const PlainSpace halves = keepIn(flat(4), {box({0, 20}, {0, 10}, {-5, 5}), box({20, 40}, {0, 10}, {-5, 5})});
  EXPECT_EQ(depthIn(halves, {feed({5, 5, 0}, {35, 5, 0})}), 0);
  EXPECT_NEAR(depthIn(halves, {feed({5, 5, 0}, {35, 6.5, 0})}), 0.5, kNear);
  // In the corner of the L a tool that leaves the corner line is outside.
  EXPECT_GT(depthIn(space, {feed({5, 5, 0}, {8, 8, 0})}), 0.5);
}

TEST(KeepIn, Condition) {
  // A cone that opens upwards: at the tip 10, each millimetre up 1 more.
  const PlainShape cone = Condition<double, bool>{
      [](const Point<double> &point) { return std::hypot(point[0], point[1]) <= 10 + point[2] && point[2] <= 20; }};
  EXPECT_EQ(depthIn(keepIn(flat(4), {cone}), {feed({0, 0, 10}, {0, 0, -6})}), 0);
  EXPECT_NEAR(depthIn(keepIn(flat(4), {cone}), {feed({0, 0, 10}, {0, 0, -7})}), 1, kNear);
  EXPECT_NEAR(depthIn(keepIn(ball(4), {cone}), {feed({0, 0, 10}, {0, 0, -6})}), 0, kNear);
  const PlainShape round = Condition<double, bool>{
      [](const Point<double> &point) { return std::hypot(point[0], point[1]) <= 50 && point[2] >= -5; }};
  EXPECT_NEAR(depthIn(keepIn(ball(11), {round}), {feed({0, 0, 0}, {40, 0, -5})}), 1, kNear);
  EXPECT_EQ(smallestMargin(keepIn(flat(4), {cone}), SpaceClaim::KeepIn, 0, std::vector{feed({0, 0, 10}, {0, 0, 0})}),
            std::nullopt);
}

// ---- keep out ----

const PlainShape kClamp = Cylinder<double>{Axis::Z, {30, 0}, 12, {-20, 40}};

TEST(KeepOut, PassingByTouchesAtTheSumOfTheRadii) {
  EXPECT_EQ(depthOut(keepOut(flat(5), {kClamp}), {feed({0, 17, 0}, {60, 17, 0})}), 0);
  EXPECT_NEAR(depthOut(keepOut(flat(5), {kClamp}), {feed({0, 16, 0}, {60, 16, 0})}), 1, kNear);
  EXPECT_NEAR(marginOut(keepOut(flat(5), {kClamp}), {feed({0, 20, 0}, {60, 20, 0})}), 3, kNear);
  EXPECT_NEAR(marginOut(keepOut(flat(5), {kClamp}), {feed({0, 0, 43}, {60, 0, 43})}), 3, kNear);
  EXPECT_NEAR(depthOut(keepOut(flat(5), {kClamp}), {rapid({0, 0, 43}, {60, 0, 39})}), 1, kNear);
  // Below it the shank would be in it.
  EXPECT_GT(depthOut(keepOut(flat(5), {kClamp}), {feed({0, 0, -30}, {60, 0, -30})}), 1);
}

TEST(KeepOut, CornerRadiusPassesTheEdge) {
  const PlainShape block = box({0, 100}, {-100, 100}, {-50, 0});
  // The ball's middle is 4 beside the edge and 3 above it.
  EXPECT_NEAR(marginOut(keepOut(ball(5), {block}), {feed({-4, -9, -2}, {-4, 9, -2})}), 0, kNear);
  EXPECT_NEAR(depthOut(keepOut(ball(5), {block}), {feed({-4, -9, -3}, {-4, 9, -3})}), 5 - std::hypot(4, 2), kNear);
  EXPECT_NEAR(depthOut(keepOut(flat(5), {block}), {feed({-4, -9, -2}, {-4, 9, -2})}), 1, kNear);
  EXPECT_NEAR(depthOut(keepOut({5, 2}, {block}), {feed({-4, -9, -2}, {-4, 9, -2})}), 1, kNear);
  EXPECT_NEAR(depthOut(keepOut({5, 2}, {block}), {feed({-4, -9, -1}, {-4, 9, -1})}), 2 - std::hypot(1, 1), kNear);
}

TEST(KeepOut, DogLegHitsAClampThatTheStraightLineMisses) {
  const PlainShape clamp = Cylinder<double>{Axis::Z, {90, 10}, 5, {0, 20}};
  const std::vector diagonal{rapid({0, 0, 10}, {100, 100, 10})};
  EXPECT_EQ(depthOut(keepOut(flat(3), {clamp}), {feed({0, 0, 10}, {100, 100, 10})}), 0);
  EXPECT_NEAR(depthOut(keepOut(flat(3), {clamp}), diagonal), 8, kNear);
  EXPECT_NEAR(depthOut(keepOut(flat(3), {box({88, 92}, {9, 11}, {0, 20})}), diagonal), 4, kNear);
  EXPECT_NEAR(depthOut(keepOut(flat(3), {Sphere<double>{{90, 10, 10}, 5}}), diagonal), 5, kNear);
  EXPECT_NEAR(depthOut(keepOut(flat(3), {Prism<double>{{{88, 9}, {92, 9}, {92, 11}, {88, 11}}, {0, 20}}}), diagonal), 4,
              kNear);
  EXPECT_NEAR(marginOut(keepOut(flat(3), {Prism<double>{{{104, 103}, {110, 103}, {110, 120}}, {0, 20}}}), diagonal),
              std::hypot(4, 3) - 3, kNear);
  // Each axis at any rate: Z may be down before X Y have left.
  EXPECT_NEAR(depthOut(keepOut(flat(3), {clamp}), {rapid({60, 10, 50}, {120, 10, 19})}), 1, kNear);
}

TEST(KeepOut, ArcAroundAndLyingBars) {
  const RecordedMove around = arc(MoveKind::ArcClockwise, {10, 0, 0}, {50, 0, 0}, 30, 0);
  EXPECT_NEAR(marginOut(keepOut(flat(5), {kClamp}), {around}), 3, kNear);
  const PlainShape bar = Cylinder<double>{Axis::X, {0, 0}, 10, {0, 50}};
  EXPECT_NEAR(depthOut(keepOut(ball(5), {bar}), {feed({-9, 0, 9}, {60, 0, 9})}), 1, kNear);
  EXPECT_NEAR(marginOut(keepOut(ball(5), {bar}), {feed({20, 12, 4}, {20, 40, 4})}), std::hypot(12, 9) - 15, kNear);
  EXPECT_NEAR(marginOut(keepOut(flat(5), {bar}), {feed({-8, -40, 0}, {-8, 40, 0})}), 3, kNear);
  EXPECT_NEAR(marginOut(keepOut(ball(5), {Sphere<double>{{0, 0, 0}, 10}}), {feed({12, -60, 4}, {12, 60, 4})}),
              std::hypot(12, 9) - 15, kNear);
}

TEST(KeepOut, EmptyRegionsAndConditions) {
  EXPECT_EQ(depthOut(keepOut(flat(5), {box({10, 10}, {}, {})}), {feed({0, 0, 0}, {20, 0, 0})}), 0);
  EXPECT_EQ(marginOut(keepOut(flat(5), {box({10, 10}, {}, {})}), {feed({0, 0, 0}, {20, 0, 0})}), -1);
  const PlainShape slope =
      Condition<double, bool>{[](const Point<double> &point) { return point[2] < point[0] && point[2] < 50; }};
  EXPECT_EQ(depthOut(keepOut(flat(5), {slope}), {feed({-30, 0, 0}, {-5, 0, 0})}), 0);
  EXPECT_GT(depthOut(keepOut(flat(5), {slope}), {feed({-30, 0, 0}, {-4, 0, 0})}), 0.5);
}

// ---- beside the path ----

PlainSpace rounded(PlainSpace space, double corner) {
  space.corner = corner;
  return space;
}

TEST(Corner, TheToolMayBeBesideItsPath) {
  EXPECT_NEAR(depthIn(rounded(keepIn(flat(6), {kPocket}), 0.5), {feed({0, 0, -10}, {44, 0, -10})}), 0.5, kNear);
  EXPECT_EQ(depthIn(rounded(keepIn(flat(6), {kPocket}), 0.5), {feed({0, 0, -10}, {43.5, 0, -10})}), 0);
  EXPECT_NEAR(depthIn(rounded(keepIn(flat(6), {kPocket}), 0.5), {feed({0, 0, 0}, {0, 0, -20})}), 0.5, kNear);
  EXPECT_NEAR(marginIn(rounded(keepIn(flat(6), {kPocket}), 0.5), {feed({0, 0, -10}, {40, 21, -10})}), 2.5, kNear);
  EXPECT_NEAR(depthOut(rounded(keepOut(flat(5), {kClamp}), 0.5), {feed({0, 17, 0}, {60, 17, 0})}), 0.5, kNear);
  EXPECT_NEAR(marginOut(rounded(keepOut(flat(5), {kClamp}), 0.5), {rapid({0, 0, 43}, {60, 0, 43})}), 2.5, kNear);
  const auto gouge = deepestGouge(rounded(keepIn(flat(6), {kPocket}), 0.5), SpaceClaim::KeepIn, 0,
                                  std::vector{feed({0, 0, -10}, {44.25, 0, -10})});
  ASSERT_TRUE(gouge);
  expectPoint(gouge->at, {44.25, 0, -10});
  EXPECT_EQ(gouge->beside, 0.5);
}

TEST(Corner, PastAnEdgeInTheDirectionOfTheEdge) {
  const PlainShape block = box({0, 100}, {-100, 100}, {-50, 0});
  // 3 beside the edge and 4 above it: 5 away, and a flat tool of 1 comes to 4.472.
  EXPECT_EQ(depthOut(rounded(keepOut(flat(1), {block}), 4.4), {feed({-3, -9, 4}, {-3, 9, 4})}), 0);
  EXPECT_NEAR(depthOut(rounded(keepOut(flat(1), {block}), 4.6), {feed({-3, -9, 4}, {-3, 9, 4})}),
              4.6 - std::hypot(2, 4), kNear);
}

TEST(Corner, PartsAndConditionsByTrial) {
  const PlainSpace halves = keepIn(flat(4), {box({0, 20}, {0, 10}, {-5, 5}), box({20, 40}, {0, 10}, {-5, 5})});
  EXPECT_EQ(depthIn(rounded(halves, 0.75), {feed({5, 5, 0}, {35, 5, 0})}), 0);
  EXPECT_NEAR(depthIn(rounded(halves, 1.5), {feed({5, 5, 0}, {35, 5, 0})}), 0.5, kNear);
  const PlainShape round = Condition<double, bool>{
      [](const Point<double> &point) { return std::hypot(point[0], point[1]) <= 50 && point[2] >= -5; }};
  EXPECT_EQ(depthIn(rounded(keepIn(flat(4), {round}), 0.9), {feed({0, 0, 0}, {45, 0, -4})}), 0);
  EXPECT_NEAR(depthIn(rounded(keepIn(flat(4), {round}), 1.25), {feed({0, 0, 0}, {45, 0, 0})}), 0.25, kNear);
  const PlainShape slope =
      Condition<double, bool>{[](const Point<double> &point) { return point[2] < point[0] && point[2] < 50; }};
  EXPECT_GT(depthOut(rounded(keepOut(flat(5), {slope}), 1), {feed({-30, 0, 0}, {-5, 0, 0})}), 0.5);
}

// ---- clearance and travel ----

double depthClear(const std::vector<RecordedMove> &moves) {
  const PlainSpace space{.tool = flat(5), .keepIn = {}, .keepOut = {}, .clearance = 2, .travel = {}};
  const auto gouge = deepestGouge(space, SpaceClaim::Clearance, 0, moves);
  return gouge ? gouge->depth : 0;
}

TEST(Clearance, RapidMovesStayAbove) {
  EXPECT_EQ(depthClear({rapid({0, 0, 50}, {90, 0, 2}), feed({90, 0, 2}, {90, 0, -5}), rapid({90, 0, -5}, {90, 0, 2})}),
            0);
  EXPECT_NEAR(depthClear({rapid({0, 0, 50}, {90, 0, 1.5})}), 0.5, kNear);
  EXPECT_NEAR(depthClear({feed({0, 0, 2}, {0, 0, -5}), rapid({0, 0, -5}, {9, 0, -5})}), 7, kNear);
  EXPECT_NEAR(depthClear({feed({0, 0, 2}, {0, 0, -5}), rapid({0, 0, -5}, {0, 1, 50})}), 7, kNear);
}

TEST(Clearance, BackIntoTheHole) {
  const RecordedMove peck = feed({0, 0, 2}, {0, 0, -5});
  const RecordedMove out = rapid({0, 0, -5}, {0, 0, 2});
  EXPECT_EQ(depthClear({peck, out, rapid({0, 0, 2}, {0, 0, -5})}), 0);
  EXPECT_NEAR(depthClear({peck, out, rapid({0, 0, 2}, {0, 0, -6})}), 1, kNear);
  EXPECT_NEAR(depthClear({peck, out, rapid({0, 0, 2}, {9, 0, 2}), rapid({9, 0, 2}, {9, 0, -1})}), 3, kNear);
  // Away and back again: what has been cut here is not remembered.
  EXPECT_NEAR(
      depthClear({peck, out, rapid({0, 0, 2}, {9, 0, 2}), rapid({9, 0, 2}, {0, 0, 2}), rapid({0, 0, 2}, {0, 0, -1})}),
      3, kNear);
  EXPECT_EQ(depthClear({feed({-9, 0, -1}, {0, 0, -4}), rapid({0, 0, -4}, {0, 0, 9}), rapid({0, 0, 9}, {0, 0, -4})}), 0);
}

TEST(Corner, ClearanceAndNotTravel) {
  PlainSpace space{
      .tool = flat(5), .keepIn = {}, .keepOut = {}, .clearance = 2, .travel = Box<double>{}, .corner = 0.5};
  space.travel->sides = {Interval<double>{-10, 10}, {}, {}};
  const std::vector across{rapid({-10, 0, 2.25}, {10, 0, 2.25})};
  const auto low = deepestGouge(space, SpaceClaim::Clearance, 0, across);
  ASSERT_TRUE(low);
  EXPECT_NEAR(low->depth, 0.25, kNear);
  EXPECT_FALSE(deepestGouge(space, SpaceClaim::Clearance, 0, std::vector{rapid({0, 0, 1}, {0, 0, 9})})); // straight up
  EXPECT_FALSE(deepestGouge(space, SpaceClaim::Travel, 0, across));
}

TEST(Travel, PointOfTheTool) {
  PlainSpace space{.tool = flat(5), .keepIn = {}, .keepOut = {}, .clearance = {}, .travel = Box<double>{}};
  space.travel->sides = {Interval<double>{-10, 10}, Interval<double>{-10, 10}, Interval<double>{{}, 50}};
  const auto depth = [&](const RecordedMove &move) {
    const auto gouge = deepestGouge(space, SpaceClaim::Travel, 0, std::vector{move});
    return gouge ? gouge->depth : 0;
  };
  EXPECT_EQ(depth(rapid({-10, -10, 50}, {10, 10, -900})), 0);
  EXPECT_NEAR(depth(rapid({0, 0, 50}, {0, 10.5, 0})), 0.5, kNear);
  EXPECT_NEAR(depth(arc(MoveKind::ArcClockwise, {0, -9, 0}, {0, 9, 0}, 0, 0)), 0, kNear);
  EXPECT_NEAR(depth(arc(MoveKind::ArcClockwise, {-3, -9, 0}, {-3, 9, 0}, -3, 0)), 2, kNear);
}

// ---- against the definition, point by point of the tool ----

bool contains(const Interval<double> &interval, double value) {
  return (!interval.low || *interval.low <= value) && (!interval.high || value <= *interval.high);
}
bool contains(const PlainShape &shape, const Point<double> &point) {
  if (const auto *sides = std::get_if<Box<double>>(&shape))
    return contains(sides->sides[0], point[0]) && contains(sides->sides[1], point[1]) &&
           contains(sides->sides[2], point[2]);
  if (const auto *sphere = std::get_if<Sphere<double>>(&shape))
    return std::hypot(point[0] - sphere->centre[0], point[1] - sphere->centre[1], point[2] - sphere->centre[2]) <=
           sphere->radius;
  const auto &cylinder = std::get<Cylinder<double>>(shape);
  const std::size_t along = indexOf(cylinder.axis);
  const std::size_t first = along == 0 ? 1 : 0;
  const std::size_t second = along == 2 ? 1 : 2;
  return std::hypot(point[first] - cylinder.centre[0], point[second] - cylinder.centre[1]) <= cylinder.radius &&
         contains(cylinder.along, point[along]);
}
bool containsBelow(const PlainShape &shape, Point<double> point) {
  for (; point[2] > -40; point[2] -= 0.25)
    if (contains(shape, point))
      return true;
  return false;
}

/// Points all over a tool up to Z 40.
std::vector<Point<double>> pointsOf(const Tool<double> &tool, const Point<double> &tip) {
  std::vector<Point<double>> points;
  for (double height = 0; tip[2] + height < 40; height += height < 6 ? 0.25 : 2) {
    const double below = std::max(0.0, tool.corner - height);
    const double radius =
        tool.radius - tool.corner + std::sqrt(std::max(0.0, tool.corner * tool.corner - below * below));
    for (int ring = 0; ring <= 4; ++ring)
      for (int angle = 0; angle < (ring == 0 ? 1 : 48); ++angle)
        points.push_back({tip[0] + radius * ring / 4 * std::cos(angle * std::numbers::pi / 24),
                          tip[1] + radius * ring / 4 * std::sin(angle * std::numbers::pi / 24), tip[2] + height});
  }
  return points;
}

class Definition : public testing::Test {
protected:
  double any(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  Interval<double> interval() {
    const double middle = any(-8, 8);
    Interval<double> made{middle - any(1, 12), middle + any(1, 12)};
    if (any(0, 1) < 0.2)
      made.low.reset();
    if (any(0, 1) < 0.2)
      made.high.reset();
    return made;
  }
  PlainShape shape() {
    const double which = any(0, 5);
    if (which < 1)
      return Box<double>{{interval(), interval(), interval()}};
    if (which < 2)
      return Sphere<double>{{any(-5, 5), any(-5, 5), any(-5, 5)}, any(1, 15)};
    const Axis axis = which < 3 ? Axis::X : which < 4 ? Axis::Y : Axis::Z;
    return Cylinder<double>{axis, {any(-5, 5), any(-5, 5)}, any(1, 15), interval()};
  }
  Tool<double> tool() {
    const double radius = any(0.5, 6);
    return {radius, any(0, 1) < 0.3 ? 0 : any(0, 1) < 0.5 ? radius : any(0, radius)};
  }
  std::mt19937 random_{1};
};

TEST_F(Definition, OfKeepingOut) {
  std::size_t violated = 0;
  for (int i = 0; i < 1000; ++i) {
    const PlainShape region = shape();
    const Tool<double> cutter = tool();
    const Point<double> tip{any(-15, 15), any(-15, 15), any(-15, 15)};
    const auto points = pointsOf(cutter, tip);
    const bool touches =
        std::any_of(points.begin(), points.end(), [&](const Point<double> &point) { return contains(region, point); });
    const double depth = depthOut(keepOut(cutter, {region}), {feed(tip, tip)});
    EXPECT_TRUE(!touches || depth > 0) << "run " << i;
    EXPECT_TRUE(touches || depth < 0.6) << "run " << i << ": " << depth;
    violated += depth > 0 ? 1 : 0;
  }
  EXPECT_GT(violated, 200U);
  EXPECT_LT(violated, 800U);
}

TEST_F(Definition, OfKeepingIn) {
  std::size_t violated = 0;
  for (int i = 0; i < 1000; ++i) {
    const PlainShape region = shape();
    const Tool<double> cutter{any(0.1, 3), 0};
    const Tool<double> rounded{cutter.radius, any(0, cutter.radius)};
    const Point<double> tip{any(-6, 6), any(-6, 6), any(-10, 6)};
    const auto points = pointsOf(rounded, tip);
    const bool leaves = !contains(region, tip) || std::any_of(points.begin(), points.end(), [&](const auto &point) {
      return !containsBelow(region, point);
    });
    const double depth = depthIn(keepIn(rounded, {region}), {feed(tip, tip)});
    EXPECT_TRUE(!(depth > 0.6) || leaves) << "run " << i << ": " << depth;
    // What is below is looked at in steps: what seems to leave by less may not.
    EXPECT_TRUE(!leaves || marginIn(keepIn(rounded, {region}), {feed(tip, tip)}) < 0.3) << "run " << i;
    violated += depth > 0 ? 1 : 0;
  }
  EXPECT_GT(violated, 200U);
  EXPECT_LT(violated, 900U);
}

// ---- numbers that no machine has ----

TEST(Gouge, FarAwayIsNoTrouble) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const PlainShape triangle = Prism<double>{{{0, 0}, {10, 0}, {0, 10}}, {0, 20}};
  EXPECT_EQ(depthOut(keepOut(flat(3), {triangle}), {rapid({0, 0, 0}, {infinity, 9, 0})}), 0);
  EXPECT_GT(depthOut(keepOut(flat(3), {triangle}), {rapid({0, 0, 0}, {1e6, 9, 0})}), 3);
  EXPECT_GT(depthOut(keepOut(flat(3), {kClamp}), {feed({-1e12, 0, 0}, {1e12, 0, 0})}), 3);
  RecordedMove helix = arc(MoveKind::ArcCounterclockwise, {4, 0, 0}, {4, 0, -10}, 0, 0);
  helix.move.turns = 100'000;
  const PlainShape square = Prism<double>{{{-9, -9}, {9, -9}, {9, 9}, {-9, 9}}, {-20, 0}};
  EXPECT_NEAR(marginIn(keepIn(flat(3), {square}), {helix}), 0, kNear); // at the upper end
  EXPECT_NEAR(depthIn(keepIn(flat(6), {square}), {helix}), 1, 1e-3);
}

// ---- time ----

TEST(Gouge, TwentyThousandMovesInABoxTakeNoTime) {
  std::vector<RecordedMove> moves;
  for (int i = 0; i < 10'000; ++i) {
    moves.push_back(feed({-44, 24, -10}, {44, 24, -10}));
    moves.push_back(arc(MoveKind::ArcClockwise, {44, 0, -10}, {-44, 0, -11}, 0, 0));
  }
  const auto start = std::chrono::steady_clock::now();
  EXPECT_GT(depthIn(keepIn(flat(6), {kPocket}), moves), 0);
  EXPECT_GT(depthOut(keepOut(flat(6), {kClamp}), moves), 0);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(3));
}

} // namespace
} // namespace feedhold::geometry
