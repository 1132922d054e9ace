// Compensation of the nose of a lathe tool: a contour in the plane of Z and the radius is that of a mill in the plane
// of X and Y, and so is the path of the centre between its ends.
#include "semantics/language_sample.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <random>

namespace feedhold {
namespace {

struct At {
  double first;
  double second;
};

/// A chain of lines, and of arcs that are tangent to them, for a mill and for a lathe.
class TwinContour {
public:
  explicit TwinContour(unsigned seed) : random_(seed) {
    radius = std::round(number(.2, 6) * 1000) / 1000;
    tip = static_cast<std::uint8_t>(random_() % kTipDirections);
    const char *side = random_() % 2 == 0 ? "G41" : "G42";
    heading_ = number(0, 6.28);
    mill = "O1\nG21 G17 G90 G40 G00 X0 Y0\n";
    lathe = "O1\nG21 G18 G40 G00 X0 Z0 T0101\n";
    line(fmt::format("G01 {} D1 ", side), fmt::format("G01 {} ", side), 30);
    for (int i = 0; i < 6; ++i) {
      if (random_() % 5 != 0)
        heading_ += number(-1.9, 1.9);
      if (random_() % 3 == 0)
        arc();
      else
        line("G01 ", "G01 ", number(8, 40));
    }
    line("G01 G40 ", "G01 G40 ", 50);
    mill += "M30\n";
    lathe += "M30\n";
  }

  double radius;
  std::uint8_t tip;
  std::string mill, lathe;

private:
  double number(double low, double high) { return std::uniform_real_distribution<>(low, high)(random_); }
  static double rounded(double number) { return std::round(number * 1000) / 1000; }
  void goTo(At at) {
    at_ = {rounded(at.first), rounded(at.second)};
    mill += fmt::format("X{:.3f} Y{:.3f}", at_.first, at_.second);
    lathe += fmt::format("Z{:.3f} X{:.3f}", at_.first, 2 * at_.second);
  }
  void line(const std::string &ofMill, const std::string &ofLathe, double length) {
    mill += ofMill;
    lathe += ofLathe;
    goTo({at_.first + length * std::cos(heading_), at_.second + length * std::sin(heading_)});
    mill += " F100.\n";
    lathe += " F100.\n";
  }
  void arc() {
    const int way = random_() % 2 == 0 ? 1 : -1;
    const double size = number(3, 20), sweep = number(.6, 4);
    const double toCentre = heading_ + way * std::numbers::pi / 2;
    const double first = rounded(size * std::cos(toCentre)), second = rounded(size * std::sin(toCentre));
    const At centre{at_.first + first, at_.second + second};
    const double angle = toCentre + std::numbers::pi + way * sweep;
    const std::string code = way > 0 ? "G03 " : "G02 ";
    mill += code;
    lathe += code;
    goTo({centre.first + size * std::cos(angle), centre.second + size * std::sin(angle)});
    heading_ += way * sweep;
    mill += fmt::format(" I{:.3f} J{:.3f}\n", first, second);
    lathe += fmt::format(" K{:.3f} I{:.3f}\n", first, second);
  }

  std::mt19937 random_;
  At at_{};
  double heading_;
};

RunResult compensated(const Dialect &dialect, const std::string &text,
                      std::initializer_list<std::pair<std::uint32_t, double>> offsets) {
  const LanguageSample sample(dialect, {text});
  RunOptions options;
  for (const auto &[variable, value] : offsets)
    options.variables.set(variable, ConcreteValue::of(value));
  options.fuel = 10'000;
  options.cutter = CutterCompensation::Followed;
  return run(*sample.set, sample.main(), options);
}

At ofMill(const std::array<ConcreteValue, kAxisCount> &point) { return {point[0].number, point[1].number}; }
At ofLathe(const std::array<ConcreteValue, kAxisCount> &point) { return {point[2].number, point[0].number / 2}; }

void expectNear(At a, At b) {
  EXPECT_NEAR(a.first, b.first, 1e-6);
  EXPECT_NEAR(a.second, b.second, 1e-6);
}

/// `isStart`, `isEnd`: there the centre of the nose lies beside the tip.
void expectTwins(const RecordedMove &mill, const RecordedMove &lathe, At beside, bool isStart, bool isEnd) {
  ASSERT_EQ(mill.centre.size(), lathe.centre.size());
  for (std::size_t i = 0; i < mill.centre.size(); ++i) {
    const Move<ConcreteValue> &a = mill.centre[i], &b = lathe.centre[i];
    EXPECT_EQ(a.kind, b.kind);
    EXPECT_EQ(a.turns, b.turns);
    const bool isFirst = isStart && i == 0, isLast = isEnd && i + 1 == mill.centre.size();
    expectNear(isFirst ? At{ofMill(a.start).first + beside.first, ofMill(a.start).second + beside.second}
                       : ofMill(a.start),
               ofLathe(b.start));
    expectNear(isLast ? At{ofMill(a.end).first + beside.first, ofMill(a.end).second + beside.second} : ofMill(a.end),
               ofLathe(b.end));
    if (isArc(a.kind))
      expectNear({a.firstCentre.number, a.secondCentre.number}, {b.firstCentre.number, b.secondCentre.number / 2});
  }
}

TEST(NoseCompensation, TheCentreGoesAsThatOfAMill) {
  const Dialect &milling = *findDialect(allDialects(), "fanuc-30i");
  const Dialect &turning = *findDialect(allDialects(), "fanuc-30i-lathe");
  std::size_t ended = 0;
  for (unsigned seed = 1; seed <= 1000 && !HasFailure(); ++seed) {
    const TwinContour contour(seed);
    SCOPED_TRACE(fmt::format("{}, radius {}, tip {}:\n{}", seed, contour.radius, contour.tip, contour.lathe));
    const RunResult mill = compensated(milling, contour.mill, {{13001, contour.radius}});
    const RunResult lathe =
        compensated(turning, contour.lathe, {{2901, contour.radius}, {2301, static_cast<double>(contour.tip)}});
    ASSERT_EQ(mill.end, lathe.end);
    ASSERT_EQ(mill.alarm, lathe.alarm);
    ASSERT_EQ(mill.moves.size(), lathe.moves.size());
    const bool isWhole = mill.end == RunEnd::M30;
    ended += isWhole ? 1U : 0U;
    const TipDirection tip = tipDirection(contour.tip);
    const At beside{-tip.z * contour.radius, -tip.x * contour.radius};
    for (std::size_t i = 1; i < mill.moves.size(); ++i)
      expectTwins(mill.moves[i], lathe.moves[i], beside, i == 1, isWhole && i + 1 == mill.moves.size());
  }
  EXPECT_GT(ended, 300U);
}

} // namespace
} // namespace feedhold
