// Cutter compensation: centre paths that are known from manuals, from LinuxCNC's interpreter or by hand; and what holds
// of every centre path, on random contours.
#include "semantics/language_sample.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <random>

namespace feedhold {
namespace {

struct At {
  double x;
  double y;
};

RunResult compensated(const LanguageSample &sample, const Dialect &dialect, const GivenVariables &given) {
  RunOptions options;
  options.variables = given;
  options.fuel = 10'000;
  options.numbers = numbersOfRun(dialect);
  options.cutter = CutterCompensation::Followed;
  return run(*sample.set, sample.main(), options);
}

At startOf(const Move<ConcreteValue> &move) { return {move.start[0].number, move.start[1].number}; }
At endOf(const Move<ConcreteValue> &move) { return {move.end[0].number, move.end[1].number}; }

struct Vector {
  std::string_view name;
  std::string_view dialect;
  const char *text;
  std::vector<std::pair<std::uint32_t, double>> offsets;
  std::vector<At> centre; // ends of the moves that the centre makes, from the start-up block on
  std::optional<AlarmKind> alarm = std::nullopt;
};

constexpr const char *kProfile = "O1\nG20 G17 G90 G40\nG00 X0 Y1.25\nG01 G41 D1 X-.5 F20.\nG03 X0 Y.75 R.5\n"
                                 "G01 X1.94\nG02 X2. Y.69 R.06\nG01 Y-.69\nG02 X1.94 Y-.75 R.06\nG01 X-1.94\n"
                                 "G02 X-2. Y-.69 R.06\nG01 Y.69\nG02 X-1.94 Y.75 R.06\nG01 X0\n"
                                 "G03 X.5 Y1.25 R.5\nG01 G40 X0\nM30\n";
constexpr const char *kProfileOfLinuxCnc =
    "g20 g17 g90 g40\ng0 x0 y1.25\ng41.1 d.375\ng1 x-.5 f20\ng3 x0 y.75 r.5\ng1 x1.94\ng2 x2 y.69 r.06\ng1 y-.69\n"
    "g2 x1.94 y-.75 r.06\ng1 x-1.94\ng2 x-2 y-.69 r.06\ng1 y.69\ng2 x-1.94 y.75 r.06\ng1 x0\ng3 x.5 y1.25 r.5\n"
    "g40\ng1 x0\nm2\n";
constexpr const char *kCorners = "O1\nG21 G17 G90 G40\nG00 X0 Y-20.\nG01 G41 D1 Y0 F200.\nY40.\nX40.\nX0 Y10.\nX-40.\n"
                                 "G40 Y-20.\nM30\n";
constexpr const char *kChamfers =
    "O1\nG21 G17 G90\nG00 X24. Y45.\nG01 G41 D1 Y20. F100.\nX25.\nX30. Y15.\nY-15.\nX25. Y-20.\nX-25.\nX-30. Y-15.\n"
    "Y15.\nX-25. Y20.\nX24.\nG40 Y45.\nM30\n";
constexpr const char *kArcBehindStart = "O1\nG21 G17 G90\nG00 X0 Y0\nG01 G41 D1 X90. Y60. F100.\nG03 X100. Y70. R10.\n"
                                        "G01 Y80.\nG40 X80.\nM30\n";
constexpr const char *kOneBlockBetween =
    "O1\nG21 G17 G90\nG00 X0 Y0\nG01 G41 D1 X10. F100.\nX60.\nM08\nY40.\nG40 X80.\n"
    "M30\n";
constexpr const char *kFourBlocksBetween = "O1\nG21 G17 G90\nG00 X0 Y0\nG01 G41 D1 X10. F100.\nX60.\nM08\nS500\nM03\n"
                                           "Z-2.\nY40.\nG40 X80.\nM30\n";
constexpr const char *kSmallTurn = "O1\nG21 G17 G90\nG00 X0 Y0\nG01 G41 D1 X20. F100.\nX60.\n"
                                   "X99.982 Y1.1998\nG40 Y40.\nM30\n";

/// Radius .1875 inch and the profile are of the training manual of Haas; the others are of docs/run.md.
const std::vector<Vector> kVectors = {
    {"ProfileWithLeadIn",
     "fanuc-30i",
     kProfile,
     {{13001, .1875}},
     {{-.3125, 1.25},
      {0, .9375},
      {1.94, .9375},
      {2.1875, .69},
      {2.1875, -.69},
      {1.94, -.9375},
      {-1.94, -.9375},
      {-2.1875, -.69},
      {-2.1875, .69},
      {-1.94, .9375},
      {0, .9375},
      {.3125, 1.25},
      {0, 1.25}}},
    {"ProfileWithLeadInOfLinuxCnc", // the start-up block is trimmed as a wall would be
     "linuxcnc",
     kProfileOfLinuxCnc,
     {},
     {{-.25, 1.0625},
      {0, .9375},
      {1.94, .9375},
      {2.1875, .69},
      {2.1875, -.69},
      {1.94, -.9375},
      {-1.94, -.9375},
      {-2.1875, -.69},
      {-2.1875, .69},
      {-1.94, .9375},
      {0, .9375},
      {.3125, 1.25},
      {0, 1.25}}},
    {"OuterCorners",
     "fanuc-30i",
     kCorners,
     {{13001, 5}},
     {{-5, 0}, {-5, 45}, {45, 45}, {47, 39}, {5 / 3.0, 5}, {-40, 5}, {-40, -20}}},
    {"OuterCornersOfLinuxCnc", // arcs about the corners
     "linuxcnc",
     "g21 g17 g90 g40 g0 x0 y-20\ng41.1 d10\ng1 y0 f200\ny40\nx40\nx0 y10\nx-40\ng40\ng1 y-20\nm2\n",
     {},
     {{-5, 0}, {-5, 40}, {0, 45}, {40, 45}, {43, 36}, {3, 6}, {0, 5}, {-40, 5}, {-40, -20}}},
    {"Chamfers",
     "fanuc-30i",
     kChamfers,
     {{13001, 8}},
     {{24, 28},
      {28.3137, 28},
      {38, 18.3137},
      {38, -18.3137},
      {28.3137, -28},
      {-28.3137, -28},
      {-38, -18.3137},
      {-38, 18.3137},
      {-28.3137, 28},
      {24, 28},
      {24, 45}}},
    {"ChamfersOfLinuxCnc", // the start-up block is trimmed to beyond the end of the next one
     "linuxcnc",
     "g21 g17 g90 g0 x24 y45\ng41.1 d16\ng1 y20 f100\nx25\nx30 y15\ny-15\ng40\ng1 x60\nm2\n",
     {},
     {{32, 28}},
     AlarmKind::CutterInterference},
    {"Bore",
     "fanuc-30i",
     "O1\nG21 G17 G90\nG00 X0 Y0\nG01 G41 D2 Y20. F100.\nG03 J-20.\nG01 G40 Y0\nM30\n",
     {{13002, 5}},
     {{0, 15}, {0, 15}, {0, 0}}},
    {"BoreOfLinuxCnc",
     "linuxcnc",
     "g21 g17 g90 g0 x0 y0\ng41.1 d10\ng1 y20 f100\ng3 x0 y20 j-20\ng40\ng1 y0\nm2\n",
     {},
     {{-5, 14.1421}, {0, 15}, {0, 0}}},
    {"NoRoomBetweenInnerCorners",
     "fanuc-30i",
     "O1\nG21 G17 G90\nG00 X0 Y0\nG01 G41 D1 X10. F100.\nX60.\nY4.\nX0\nG40 Y30.\nM30\n",
     {{13001, 5}},
     {{10, 5}, {55, 5}},
     AlarmKind::CutterInterference},
    {"NoRoomBetweenInnerCornersOfLinuxCnc",
     "linuxcnc",
     "g21 g17 g90 g0 x0 y0\ng41.1 d10\ng1 x10 f100\nx60\ny4\nx0\ng40\ng1 y30\nm2\n",
     {},
     {{10, 5}, {55, 5}},
     AlarmKind::CutterInterference},
    {"StartOfTypeA", "fanuc-30i", kArcBehindStart, {{13001, 6}}, {{90, 66}, {94, 70}, {94, 80}, {80, 80}}},
    {"OneBlockBetween", "fanuc-30i", kOneBlockBetween, {{13001, 5}}, {{10, 5}, {55, 5}, {55, 40}, {80, 40}}},
    {"FourBlocksBetween", // the corner is not foreseen: a gouge
     "fanuc-30i",
     kFourBlocksBetween,
     {{13001, 5}},
     {{10, 5}, {60, 5}, {60, 5}, {55, 40}, {80, 40}}},
    {"FourBlocksBetweenOnLinuxCnc",
     "linuxcnc",
     "g21 g17 g90 g0 x0 y0\ng41.1 d10\ng1 x10 f100\nx60\nm8\ns500\nm3\nz-2\ny40\ng40\ng1 x80\nm2\n",
     {},
     {{10, 5}, {55, 5}, {55, 5}, {55, 40}, {80, 40}}},
    {"SmallTurn", "fanuc-30i", kSmallTurn, {{13001, 10}}, {{20, 10}, {59.85, 10}, {99.682, 11.1953}, {99.982, 40}}},
    {"SmallTurnOnLinuxCnc", // counts as none: the next block begins 9.9955 from its line
     "linuxcnc",
     "g21 g17 g90 g0 x0 y0\ng41.1 d20\ng1 x20 f100\nx60\nx99.982 y1.1998\ng40\ng1 y40\nm2\n",
     {},
     {{20, 10}, {60, 10}, {99.682, 11.1953}, {99.982, 40}}},
    {"NegativeOffsetSwapsTheSides",
     "fanuc-30i",
     "O1\nG21 G17 G90\nG00 X0 Y0\nG01 G41 D1 X10. F100.\nX60.\nY40.\nG40 X80.\nM30\n",
     {{13001, 5}, {12001, -5.5}},
     {{10, -.5}, {60.5, -.5}, {60.5, 40}, {80, 40}}},
};

class CutterVectors : public ::testing::TestWithParam<Vector> {};

TEST_P(CutterVectors, TheCentreGoesThere) {
  const auto &[name, dialectName, text, offsets, expected, alarm] = GetParam();
  Dialect dialect = *findDialect(allDialects(), dialectName);
  dialect.switches.incrementSystem = IncrementSystem::C; // the vectors have four digits
  const LanguageSample sample(dialect, {text});
  GivenVariables given;
  for (const auto &[variable, value] : offsets)
    given.set(variable, ConcreteValue::of(value));
  const RunResult result = compensated(sample, dialect, given);
  std::vector<At> centre;
  for (const RecordedMove &recorded : result.moves)
    for (const Move<ConcreteValue> &move : recorded.centre)
      centre.push_back(endOf(move));
  ASSERT_EQ(centre.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(centre[i].x, expected[i].x, 2e-4) << i;
    EXPECT_NEAR(centre[i].y, expected[i].y, 2e-4) << i;
  }
  EXPECT_EQ(result.end == RunEnd::Alarm, alarm.has_value());
  if (alarm) {
    EXPECT_EQ(result.alarm, *alarm);
  }
}

INSTANTIATE_TEST_SUITE_P(All, CutterVectors, ::testing::ValuesIn(kVectors),
                         [](const auto &instance) { return std::string(instance.param.name); });

TEST(CutterStart, OfTypeB) {
  Dialect dialect = *findDialect(allDialects(), "fanuc-30i");
  dialect.switches.sup = Switch::On;
  const LanguageSample sample(dialect, {kArcBehindStart});
  GivenVariables given;
  given.set(13001, ConcreteValue::of(6));
  const RunResult result = compensated(sample, dialect, given);
  ASSERT_GE(result.moves.size(), 2U);
  const auto &centre = result.moves[1].centre;
  ASSERT_EQ(centre.size(), 3U);
  constexpr std::array<At, 3> kExpected = {At{86.6718, 64.9923}, {88.1833, 66}, {90, 66}};
  for (std::size_t i = 0; i < kExpected.size(); ++i) {
    EXPECT_NEAR(endOf(centre[i]).x, kExpected[i].x, 1e-4);
    EXPECT_NEAR(endOf(centre[i]).y, kExpected[i].y, 1e-4);
  }
}

/// A chain of lines and tangent arcs with corners of up to 109 degrees.
class RandomContour {
public:
  explicit RandomContour(unsigned seed) : random_(seed) {
    radius = number(.5, 14);
    side = random_() % 2 == 0 ? 1 : -1;
    heading_ = number(0, 6.28);
    text = "O1\nG21 G17 G90 G00 X0 Y0\nG01 G4" + std::string(side > 0 ? "1" : "2") + " D1 " + nextLine(30) + " F100.\n";
    for (int i = 0; i < 6; ++i) {
      if (random_() % 5 != 0)
        heading_ += number(-1.9, 1.9);
      text += random_() % 3 == 0 ? nextArc() : "G01 " + nextLine(number(15, 60)) + "\n";
    }
    text += "G01 G40 X200. Y200.\nM30\n";
  }

  double radius;
  int side;
  std::string text;

private:
  double number(double low, double high) { return std::uniform_real_distribution<>(low, high)(random_); }
  std::string nextLine(double length) {
    at_ = {at_.x + length * std::cos(heading_), at_.y + length * std::sin(heading_)};
    return fmt::format("X{:.6f} Y{:.6f}", at_.x, at_.y);
  }
  std::string nextArc() {
    const int way = random_() % 2 == 0 ? 1 : -1;
    const double size = number(8, 30), sweep = number(.6, 4);
    const double toCentre = heading_ + way * std::numbers::pi / 2;
    const At centre{at_.x + size * std::cos(toCentre), at_.y + size * std::sin(toCentre)};
    const double i = centre.x - at_.x, j = centre.y - at_.y;
    const double angle = toCentre + std::numbers::pi + way * sweep;
    at_ = {centre.x + size * std::cos(angle), centre.y + size * std::sin(angle)};
    heading_ += way * sweep;
    return fmt::format("G0{} X{:.6f} Y{:.6f} I{:.6f} J{:.6f}\n", way > 0 ? 3 : 2, at_.x, at_.y, i, j);
  }

  std::mt19937 random_;
  At at_{};
  double heading_;
};

constexpr double kRounding = 4e-3; // of the words, to thousandths, at a sharp corner

/// Its distance from the line or the circle of the block is the offset, and it does not go beyond an end by more.
void expectBeside(const RecordedMove &recorded, const RandomContour &contour) {
  const Move<ConcreteValue> &programmed = recorded.move, &own = recorded.centre.front();
  const At p = startOf(programmed), q = endOf(programmed), a = startOf(own), b = endOf(own);
  if (programmed.kind == MoveKind::Feed) {
    const double length = std::hypot(q.x - p.x, q.y - p.y);
    const At d{(q.x - p.x) / length, (q.y - p.y) / length};
    for (const At &c : {a, b})
      EXPECT_NEAR(contour.side * (d.x * (c.y - p.y) - d.y * (c.x - p.x)), contour.radius, kRounding);
    const double from = d.x * (a.x - p.x) + d.y * (a.y - p.y), to = d.x * (b.x - p.x) + d.y * (b.y - p.y);
    EXPECT_GE(from, -contour.radius - kRounding);
    EXPECT_LE(to, length + contour.radius + kRounding);
    EXPECT_LE(from, to + kRounding);
    return;
  }
  const At centre{programmed.firstCentre.number, programmed.secondCentre.number};
  const int way = programmed.kind == MoveKind::ArcCounterclockwise ? 1 : -1;
  const double size = std::hypot(p.x - centre.x, p.y - centre.y);
  for (const At &c : {a, b})
    EXPECT_NEAR(std::hypot(c.x - centre.x, c.y - centre.y), size - contour.side * way * contour.radius, kRounding);
}

TEST(CutterContours, TheCentreKeepsItsDistance) {
  const Dialect &dialect = *findDialect(allDialects(), "fanuc-30i");
  std::size_t ended = 0;
  for (unsigned seed = 1; seed <= 1000; ++seed) {
    const RandomContour contour(seed);
    SCOPED_TRACE(fmt::format("{}:\n{}", seed, contour.text));
    const LanguageSample sample(dialect, {contour.text});
    GivenVariables given;
    given.set(13001, ConcreteValue::of(contour.radius));
    const RunResult result = compensated(sample, dialect, given);
    ended += result.end == RunEnd::M30 ? 1U : 0U;
    At stands{};
    for (std::size_t i = 1; i < result.moves.size(); ++i) {
      const RecordedMove &recorded = result.moves[i];
      ASSERT_TRUE(recorded.isOfTool);
      ASSERT_FALSE(recorded.centre.empty());
      for (const Move<ConcreteValue> &move : recorded.centre) { // without a gap
        EXPECT_NEAR(startOf(move).x, stands.x, 1e-6);
        EXPECT_NEAR(startOf(move).y, stands.y, 1e-6);
        stands = endOf(move);
      }
      if (i > 1 && (i + 1 < result.moves.size() || result.end != RunEnd::M30)) // neither start-up nor cancel
        expectBeside(recorded, contour);
    }
    if (HasFailure())
      return;
  }
  EXPECT_GT(ended, 300U);
}

} // namespace
} // namespace feedhold
