#include "surface/plot/plot_sink.h"

#include <gtest/gtest.h>
#include <limits>

namespace feedhold {
namespace {

using geometry::Point;

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

std::string drawn(const std::vector<RecordedMove> &moves) {
  return drawPicture({.title = "A <B> & C", .runs = {{.name = "A", .moves = moves}}});
}
std::size_t count(std::string_view text, std::string_view wanted) {
  std::size_t found = 0;
  for (std::size_t at = text.find(wanted); at != std::string_view::npos; at = text.find(wanted, at + 1))
    ++found;
  return found;
}

TEST(GougeText, OfEachClaim) {
  using geometry::SpaceClaim;
  const geometry::PlainSpace space{
      .tool = {}, .keepIn = {{"CAVITY", {}}}, .keepOut = {{"RIB", {}}, {"CLAMP", {}}}, .clearance = {}, .travel = {}};
  const auto deep = [](double depth) { return geometry::Gouge{0, {0, 0, 0}, depth}; };
  EXPECT_EQ(gougeText(space, SpaceClaim::KeepIn, 0, deep(0.25), LengthUnit::Millimetre, "N40"),
            "0.25 mm outside CAVITY at N40");
  EXPECT_EQ(gougeText(space, SpaceClaim::KeepOut, 1, deep(12), LengthUnit::Inch, "line 7"),
            "12 in inside CLAMP at line 7");
  EXPECT_EQ(gougeText(space, SpaceClaim::Clearance, 0, deep(1.0 / 3), LengthUnit::Millimetre, "N1"),
            "0.3333 mm below the clearance height in a rapid move at N1");
  EXPECT_EQ(gougeText(space, SpaceClaim::Travel, 0, deep(1e-6), LengthUnit::Millimetre, "N1"),
            "less than 0.0001 mm outside the travel limits at N1");
  EXPECT_EQ(gougeText(space, SpaceClaim::KeepIn, 0, {0, {0, 0, 0}, 0.25, {}, 0.05}, LengthUnit::Millimetre, "N40"),
            "0.25 mm outside CAVITY at N40, up to 0.05 mm beside its path");
}

TEST(Picture, TextOfProgramsIsNoMarkup) {
  EXPECT_NE(drawn({}).find("<title>A &lt;B&gt; &amp; C</title>"), std::string::npos);
}

TEST(Picture, MovesOfOneBlockAreOnePath) {
  const RecordedMove there = moveOf(MoveKind::Feed, {0, 0, 0}, {10, 0, 0});
  const RecordedMove back = moveOf(MoveKind::Feed, {10, 0, 0}, {0, 0, -1});
  RecordedMove elsewhere = moveOf(MoveKind::Feed, {0, 0, -1}, {5, 5, -1});
  elsewhere.place.node = NodeId(1);
  // Two views, and the sign of the legend.
  EXPECT_EQ(count(drawn({there, back}), "<path class=\"path\""), 3U);
  EXPECT_EQ(count(drawn({there, back, elsewhere}), "<path class=\"path\""), 5U);
}

// One view: Z to the right, X upwards; 40 in diameter lies as high as 20 in Z is long.
TEST(Picture, OfALathe) {
  const RecordedMove along = moveOf(MoveKind::Feed, {40, 0, 0}, {40, 0, -20});
  const RecordedMove out = moveOf(MoveKind::Rapid, {40, 0, -20}, {80, 0, -20});
  const std::vector<RecordedMove> moves = {along, out};
  const std::string picture = drawPicture({.title = "T", .runs = {{.name = "T", .moves = moves}}, .isLathe = true});
  EXPECT_EQ(count(picture, "<path class=\"path\""), 2U); // and the sign of the legend
  EXPECT_NE(picture.find(">Z (mm)<"), std::string::npos);
  EXPECT_NE(picture.find(">X (mm)<"), std::string::npos);
  EXPECT_EQ(picture.find(">Y (mm)<"), std::string::npos);
  EXPECT_NE(picture.find(">80</text>"), std::string::npos);
}

TEST(Picture, OtherUnitsAndShiftedZerosAreTheSamePlace) {
  const RecordedMove metric = moveOf(MoveKind::Feed, {0, 0, 0}, {25.4, 50.8, 0});
  RecordedMove inch = moveOf(MoveKind::Feed, {0, 0, 0}, {1, 2, 0});
  inch.unit = LengthUnit::Inch;
  EXPECT_EQ(drawn({metric, inch}), drawn({metric, metric}));
  RecordedMove shifted = moveOf(MoveKind::Feed, {-10, -10, -10}, {15.4, 40.8, -10});
  shifted.zero = {10, 10, 10};
  EXPECT_EQ(drawn({shifted}), drawn({metric}));
}

TEST(Picture, DwellsAreNotDrawnAndTheUnknownIsTold) {
  EXPECT_EQ(count(drawn({moveOf(MoveKind::Dwell, {0, 0, 0}, {0, 0, 0})}), "<path class=\"path\""), 1U);
  EXPECT_EQ(count(drawn({moveOf(MoveKind::Unmodelled, {0, 0, 0}, {9, 0, 0})}), "path other"), 3U);
  RecordedMove compensated = moveOf(MoveKind::Feed, {0, 0, 0}, {9, 0, 0});
  compensated.isOfTool = false;
  EXPECT_EQ(count(drawn({compensated}), "path other"), 3U);
}

TEST(Picture, PlacesThatNoMachineHas) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const double far : {1e17, 1e300, infinity, -infinity})
    EXPECT_NE(drawn({moveOf(MoveKind::Rapid, {far, 0, 0}, {far, 1, 0}), moveOf(MoveKind::Feed, {0, 0, 0}, {9, 0, far})})
                  .find("2 moves are too far away to be drawn"),
              std::string::npos);
}

} // namespace
} // namespace feedhold
