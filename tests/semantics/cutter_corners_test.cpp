// Cutter compensation at corners by `,C` and `,R`: the control makes blocks of them, so that the tool's centre goes
// where it goes when they are written out.
#include "semantics/language_sample.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace feedhold {
namespace {

constexpr std::uint8_t kTip = 3;     // of a lathe
constexpr double kRounding = 1.5e-2; // of the words, to thousandths, at a sharp corner

struct At {
  double x, y;
};
At operator+(At a, At b) { return {a.x + b.x, a.y + b.y}; }
At operator-(At a, At b) { return {a.x - b.x, a.y - b.y}; }
At operator*(double factor, At a) { return {factor * a.x, factor * a.y}; }
At heading(double angle) { return {std::cos(angle), std::sin(angle)}; }

/// A chain of lines, most of them with a corner at the end, in both ways.
class CorneredContour {
public:
  CorneredContour(unsigned seed, MachineKind machine) : random_(seed), isLathe_(machine == MachineKind::Turning) {
    radius = number(.5, 4);
    const std::string begin = (isLathe_ ? "O1\nG21 G18 G40 T0101\nG00 X0 Z0\n" : "O1\nG21 G17 G90 G40\nG00 X0 Y0\n") +
                              fmt::format("G01 G4{} {} F100.\n", 1 + random_() % 2, isLathe_ ? "" : "D1");
    short_ = written_ = begin;
    goBy(heading(angle_), 40, 0);
    for (int i = 0; i < 6; ++i)
      addLine(i < 5);
    const std::string end = isLathe_ ? "G01 G40 X400. Z400.\nM30\n" : "G01 G40 X400. Y400.\nM30\n";
    short_ += end;
    written_ += end;
  }
  double radius;
  const std::string &withCorners() const { return short_; }
  const std::string &writtenOut() const { return written_; }

private:
  double number(double low, double high) { return std::uniform_real_distribution<>(low, high)(random_); }
  std::string words(At to) const {
    return isLathe_ ? fmt::format("Z{:.9f}X{:.9f}", to.x, 2 * to.y) : fmt::format("X{:.9f}Y{:.9f}", to.x, to.y);
  }
  void goBy(At direction, double length, double cut) {
    at_ = at_ + length * direction;
    const std::string end = fmt::format("G01{}", words(at_ - cut * direction));
    written_ += end + "\n";
    short_ += fmt::format("G01{}", words(at_));
    if (cut == 0)
      short_ += "\n";
  }
  void addLine(bool mayHaveCorner) {
    const At direction = heading(angle_);
    const double turn = number(.3, 2.4) * (random_() % 2 == 0 ? 1 : -1);
    const bool isRound = random_() % 2 == 0;
    const double size = number(1, 4);
    const double cut = mayHaveCorner && random_() % 4 != 0 ? isRound ? size * std::tan(std::abs(turn) / 2) : size : 0;
    goBy(direction, number(30, 60), cut);
    angle_ += turn;
    if (cut == 0)
      return;
    short_ += fmt::format(",{}{:.9f}\n", isRound ? 'R' : 'C', size);
    const std::string end = words(at_ + cut * heading(angle_));
    if (!isRound) {
      written_ += fmt::format("G01{}\n", end);
      return;
    }
    const int way = turn > 0 ? 1 : -1;
    const At centre = size * heading(angle_ - turn + way * std::numbers::pi / 2);
    written_ += fmt::format("G0{}{}{}{:.9f}{}{:.9f}\n", way > 0 ? 3 : 2, end, isLathe_ ? 'K' : 'I', centre.x,
                            isLathe_ ? 'I' : 'J', centre.y);
  }

  std::mt19937 random_;
  bool isLathe_;
  std::string short_, written_;
  At at_{};
  double angle_ = 0;
};

/// Rounded words of a tangent make short pieces.
bool isLong(const Move<ConcreteValue> &move) {
  return std::ranges::any_of(std::array{Axis::X, Axis::Y, Axis::Z}, [&](Axis axis) {
    return std::abs(move.end[indexOf(axis)].number - move.start[indexOf(axis)].number) > 2 * kRounding;
  });
}

struct Made {
  std::optional<AlarmKind> alarm;
  std::vector<Move<ConcreteValue>> centre;
};

Made made(const Dialect &dialect, const std::string &text, double radius) {
  const LanguageSample sample(dialect, {text});
  const bool isLathe = dialect.machine == MachineKind::Turning;
  RunOptions options;
  options.variables.set(isLathe ? 2201 : 13001, ConcreteValue::of(radius));
  if (isLathe)
    options.variables.set(2301, ConcreteValue::of(kTip));
  options.fuel = 10'000;
  options.numbers = numbersOfRun(dialect);
  options.words = WordRounding::None;
  options.cutter = CutterCompensation::Followed;
  const RunResult result = run(*sample.set, sample.main(), options);
  Made found{result.end == RunEnd::Alarm ? std::optional(result.alarm) : std::nullopt, {}};
  for (const RecordedMove &move : result.moves) {
    EXPECT_TRUE(move.isOfTool);
    std::ranges::copy_if(move.centre, std::back_inserter(found.centre), isLong);
  }
  return found;
}

void expectSame(const Move<ConcreteValue> &one, const Move<ConcreteValue> &other) {
  EXPECT_EQ(one.kind, other.kind);
  for (const Axis axis : {Axis::X, Axis::Y, Axis::Z}) {
    EXPECT_NEAR(one.start[indexOf(axis)].number, other.start[indexOf(axis)].number, kRounding);
    EXPECT_NEAR(one.end[indexOf(axis)].number, other.end[indexOf(axis)].number, kRounding);
  }
  if (!isArc(one.kind))
    return;
  EXPECT_NEAR(one.firstCentre.number, other.firstCentre.number, kRounding);
  EXPECT_NEAR(one.secondCentre.number, other.secondCentre.number, kRounding);
}

void expectCornersAsWrittenOut(const Dialect &dialect) {
  std::size_t whole = 0, stopping = 0;
  for (unsigned seed = 1; seed <= 300; ++seed) {
    const CorneredContour contour(seed, dialect.machine);
    SCOPED_TRACE(
        fmt::format("{}: radius {}\n{}\n{}", seed, contour.radius, contour.withCorners(), contour.writtenOut()));
    const Made cornered = made(dialect, contour.withCorners(), contour.radius);
    const Made written = made(dialect, contour.writtenOut(), contour.radius);
    EXPECT_EQ(cornered.alarm, written.alarm);
    ASSERT_EQ(cornered.centre.size(), written.centre.size());
    for (std::size_t i = 0; i < written.centre.size(); ++i)
      expectSame(cornered.centre[i], written.centre[i]);
    if (::testing::Test::HasFailure())
      return;
    ++(written.alarm ? stopping : whole);
  }
  EXPECT_GT(whole, 50U);
  EXPECT_GT(stopping, 50U); // a rounding inside that is smaller than the tool
}

TEST(CutterCorners, OfAMillAreBlocks) {
  expectCornersAsWrittenOut(*findDialect(allDialects(), "fanuc-30i"));
  expectCornersAsWrittenOut(*findDialect(allDialects(), "mitsubishi-m700"));
}
TEST(CutterCorners, OfALatheAreBlocks) { expectCornersAsWrittenOut(*findDialect(allDialects(), "fanuc-30i-lathe")); }

} // namespace
} // namespace feedhold
