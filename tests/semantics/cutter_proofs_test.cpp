// Cutter compensation as proofs follow it and as a run does: the same moves of the tool's centre, or of the tip of a
// lathe tool, on random contours along the axes, or along slopes, whose size is an argument.
#include "proof/explore/exploration.h"
#include "proof/replay/exact_run.h"
#include "proof/smt/ground_truth.h"
#include "semantics/language_sample.h"

#include <fmt/format.h>

#include <random>

namespace feedhold {
namespace {

using prove::MovePath;
using smt::TermId;

constexpr double kRadius = 1.5;
constexpr std::uint8_t kTip = 3; // of a lathe

/// Lines and tangent quarters of circles, with square corners: lengths are multiples of the argument A.
class SquareContour {
public:
  SquareContour(unsigned seed, MachineKind machine) : random_(seed), isLathe_(machine == MachineKind::Turning) {
    text = isLathe_ ? "O1\nG21 G18 G40 T0101\nG00 X0 Z0\n" : "O1\nG21 G17 G90 G40 G49 G80 G94\nG00 X0 Y0 Z5.\n";
    text += fmt::format("G01 G4{} {} {} F100.\n", 1 + random_() % 2, isLathe_ ? "" : "D1", line());
    bool isBehindArc = false;
    for (int i = 0; i < 8; ++i) {
      const bool turns = random_() % 3 != 0;
      if (turns && (!isBehindArc || random_() % 8 == 0)) // beside an arc inner corners are not computed
        turn(random_() % 2 == 0 ? 1 : -1);
      isBehindArc = !turns;
      text += isBehindArc ? arc() : fmt::format("G01 {}\n", line());
      if (random_() % 6 == 0)
        text += isLathe_ ? "M08\n" : "G01 Z-1. F100.\n";
      if (random_() % 3 == 0)
        corner();
    }
    text += fmt::format("G01 G40 {}[200.*#1]\nM30\n", isLathe_ ? 'Z' : 'X');
  }
  std::string text;

private:
  void turn(int way) { std::tie(first_, second_) = std::pair(-way * second_, way * first_); }
  int length() { return 1 + static_cast<int>(random_() % 9); }
  /// Of a lathe Z and the radius, which is half of X.
  std::string point() const {
    return isLathe_ ? fmt::format("Z[{}.*#1]X[{}.*#1]", x_, 2 * y_) : fmt::format("X[{}.*#1]Y[{}.*#1]", x_, y_);
  }
  std::string centre(int first, int second) const {
    return fmt::format("{}[{}.*#1]{}[{}.*#1]", isLathe_ ? 'K' : 'I', first, isLathe_ ? 'I' : 'J', second);
  }
  std::string line(int longer = 0) {
    const int by = longer + length();
    x_ += by * first_;
    y_ += by * second_;
    return point();
  }
  /// Two lines, and what stands between them.
  void corner() {
    const std::string before = line(1);
    turn(random_() % 2 == 0 ? 1 : -1);
    text += fmt::format("G01 {},{}[{}*#1]\n", before, random_() % 2 == 0 ? 'R' : 'C', random_() % 3 == 0 ? ".5" : "2.");
    text += fmt::format("G01 {}\n", line(1));
  }
  std::string arc() {
    const int way = random_() % 2 == 0 ? 1 : -1;
    const int size = length();
    const int i = -way * second_ * size, j = way * first_ * size;
    x_ += size * first_ + i;
    y_ += size * second_ + j;
    turn(way);
    const std::string where = random_() % 2 == 0 ? centre(i, j) : fmt::format("R[{}.*#1]", size);
    return fmt::format("G0{} {}{}\n", way > 0 ? 3 : 2, point(), where);
  }

  std::mt19937 random_;
  bool isLathe_;
  int x_ = 0, y_ = 0;
  int first_ = 1, second_ = 0;
};

/// Lines along slopes of small numbers, some of them with a length that is a root: lengths are multiples of the
/// argument A.
class SlantedContour {
public:
  SlantedContour(unsigned seed, MachineKind machine) : random_(seed), isLathe_(machine == MachineKind::Turning) {
    text = isLathe_ ? "O1\nG21 G18 G40 T0101\nG00 X0 Z0\n" : "O1\nG21 G17 G90 G40 G49 G80 G94\nG00 X0 Y0 Z5.\n";
    text += fmt::format("G01 G4{} {} {} F100.\n", 1 + random_() % 2, isLathe_ ? "" : "D1", line());
    for (int i = 0; i < 6; ++i)
      text += fmt::format("G01 {}\n", line());
    text += fmt::format("G01 G40 {}[200.*#1]\nM30\n", isLathe_ ? 'Z' : 'X');
  }
  std::string text;

private:
  std::string line() {
    constexpr std::array<std::pair<int, int>, 6> kSlopes = {{{1, 0}, {1, 1}, {1, 2}, {3, 4}, {2, -5}, {7, -1}}};
    const auto [first, second] = kSlopes[random_() % kSlopes.size()];
    const int by = (4 + static_cast<int>(random_() % 9)) * (random_() % 2 == 0 ? 1 : -1);
    const bool isTurned = random_() % 2 == 0;
    x_ += by * (isTurned ? second : first);
    y_ += by * (isTurned ? first : second);
    return isLathe_ ? fmt::format("Z[{}.*#1]X[{}.*#1]", x_, 2 * y_) : fmt::format("X[{}.*#1]Y[{}.*#1]", x_, y_);
  }

  std::mt19937 random_;
  bool isLathe_;
  int x_ = 0, y_ = 0;
};

/// Those that the samples move: Y of a lathe may stand anywhere.
std::array<std::size_t, 3> axesOf(const Dialect &dialect) {
  return dialect.machine == MachineKind::Turning ? std::array<std::size_t, 3>{0, 2, 2}
                                                 : std::array<std::size_t, 3>{0, 1, 2};
}

/// The moves of the tool's centre, and whether the control stops, at one value of the argument.
struct Followed {
  std::vector<std::array<double, 6>> ends;
  bool stops = false;
  bool isWhole = true; // nothing was left out
};

enum class Offset { Known, OfEitherSign };

class Proof {
public:
  Proof(const LanguageSample &sample, const Dialect &dialect, Offset offset)
      : interpretation_(store_, dialect), axes_(axesOf(dialect)) {
    radius_ = offset == Offset::Known ? number(kRadius) : interpretation_.fresh("offset", smt::Sort::Real);
    prove::SymbolicState entry = prove::symbolicEntry(interpretation_);
    size_ = entry.locals[1].number;
    const ModalTable modes(dialect);
    for (const std::uint16_t tenths : {150, 210}) // no polar coordinates, millimetres
      if (const Code *code = findGCode(dialect, tenths))
        entry.codes[code->group] = interpretation_.code(*modes.indexOf(*code));
    prove::ExploreOptions options;
    options.assumptions = {store_.logicalNot(entry.locals[1].vacant), store_.lessOrEqual(number(1), size_),
                           store_.lessOrEqual(size_, number(3)), store_.lessOrEqual(number(-kRadius), radius_),
                           store_.lessOrEqual(radius_, number(kRadius))};
    options.moves = prove::KeepMoves::Yes;
    options.cutterOffset = [this](const prove::SymbolicValue &, const auto &) {
      return std::optional(prove::PathOffset{.radius = radius_, .tip = tipDirection(kTip)});
    };
    found_ = explore(interpretation_, *sample.set, sample.main(), entry, options);
  }

  Followed at(double size, double radius) {
    smt::Substitution given{{size_, number(size)}};
    if (!store_.isNumber(radius_))
      given.emplace(radius_, number(radius));
    const auto fails = [&](TermId condition) {
      return smt::GroundTruth(store_).of(smt::substitute(store_, condition, given)) == false;
    };
    const auto isOfRun = [&](const std::vector<TermId> &conditions) { return std::ranges::none_of(conditions, fails); };
    const auto numberOf = [&](TermId term) { return valueOf(smt::substitute(store_, term, given)); };
    Followed followed;
    for (const prove::MoveInstance &each : found_.moves)
      if (each.path == MovePath::Centre && isOfRun(each.conditions))
        followed.ends.push_back({numberOf(each.move.start[axes_[0]].number), numberOf(each.move.start[axes_[1]].number),
                                 numberOf(each.move.start[axes_[2]].number), numberOf(each.move.end[axes_[0]].number),
                                 numberOf(each.move.end[axes_[1]].number), numberOf(each.move.end[axes_[2]].number)});
    for (const prove::CutterClaim &claim : found_.cutterClaims) {
      if (!isOfRun(claim.conditions))
        continue;
      followed.isWhole = followed.isWhole && claim.why.empty();
      followed.stops = followed.stops || fails(claim.goal);
    }
    return followed;
  }

private:
  TermId number(double value) { return store_.number(smt::Number::fromDouble(value)); }
  /// Of a number, or of one that is made of roots, which is enclosed by halves.
  double valueOf(TermId term) {
    if (store_.isNumber(term))
      return store_[term].number.toDouble();
    double low = -1e5, high = 1e5;
    while (high - low > 1e-8) {
      const double middle = low + (high - low) / 2;
      const auto isBelow = smt::GroundTruth(store_).of(store_.less(term, number(middle)));
      if (!isBelow)
        return middle; // too near to tell
      (*isBelow ? high : low) = middle;
    }
    return low;
  }

  smt::TermStore store_;
  prove::SymbolicInterpretation interpretation_;
  std::array<std::size_t, 3> axes_;
  TermId size_{0}, radius_{0};
  prove::Exploration found_;
};

Followed ofRun(const LanguageSample &sample, const Dialect &dialect, double size, double radius) {
  RunOptions options;
  options.variables.set(1, ConcreteValue::of(size));
  const bool isLathe = dialect.machine == MachineKind::Turning;
  options.variables.set(isLathe ? 2201 : 13001, ConcreteValue::of(radius));
  if (isLathe)
    options.variables.set(2301, ConcreteValue::of(kTip));
  options.fuel = 10'000;
  options.numbers = numbersOfRun(dialect);
  options.words = WordRounding::None;
  options.cutter = CutterCompensation::Followed;
  const RunResult result = run(*sample.set, sample.main(), options);
  const std::array<std::size_t, 3> axes = axesOf(dialect);
  Followed followed;
  followed.stops = result.end == RunEnd::Alarm;
  for (const RecordedMove &recorded : result.moves) {
    followed.isWhole = followed.isWhole && recorded.isOfTool;
    if (recorded.centre.empty())
      continue;
    for (const RecordedMove &made : movesOfTip(recorded)) {
      const Move<ConcreteValue> &each = made.move;
      followed.ends.push_back({each.start[axes[0]].number, each.start[axes[1]].number, each.start[axes[2]].number,
                               each.end[axes[0]].number, each.end[axes[1]].number, each.end[axes[2]].number});
    }
  }
  return followed;
}

void expectSame(const Followed &proof, const Followed &run) {
  EXPECT_EQ(proof.stops, run.stops);
  if (run.stops) // a run ends there; a path goes on where the alarm does not come
    return;
  EXPECT_TRUE(run.isWhole);
  ASSERT_EQ(proof.ends.size(), run.ends.size());
  for (std::size_t i = 0; i < run.ends.size(); ++i)
    for (std::size_t k = 0; k < 6; ++k)
      EXPECT_NEAR(proof.ends[i][k], run.ends[i][k], 1e-6) << "move " << i;
}

template <typename Contour>
void expectSameContours(const Dialect &dialect, std::size_t fewestStops, Offset offset = Offset::Known,
                        std::size_t fewestWhole = 150) {
  std::size_t whole = 0, stopping = 0;
  for (unsigned seed = 1; seed <= 300; ++seed) {
    const Contour contour(seed, dialect.machine);
    SCOPED_TRACE(fmt::format("{}:\n{}", seed, contour.text));
    const LanguageSample sample(dialect, {contour.text});
    Proof proof(sample, dialect, offset);
    for (const auto &[size, part] : {std::pair(1.0, -1.0), std::pair(1.75, 0.0), std::pair(3.0, 0.7)}) {
      const double radius = offset == Offset::Known ? kRadius : part * kRadius;
      const Followed followed = proof.at(size, radius);
      if (!followed.isWhole)
        continue;
      const Followed made = ofRun(sample, dialect, size, radius);
      expectSame(followed, made);
      whole += made.stops ? 0U : 1U;
      stopping += made.stops ? 1U : 0U;
    }
    if (::testing::Test::HasFailure())
      return;
  }
  EXPECT_GE(whole, fewestWhole); // the others have corners between arcs that are not computed
  EXPECT_GE(stopping, fewestStops);
  printf("whole %zu stopping %zu\n", whole, stopping);
}

const Dialect &milling() { return *findDialect(allDialects(), "fanuc-30i"); }
/// Begins, and goes about corners, as LinuxCNC does.
Dialect millingByItself() {
  Dialect dialect = milling();
  dialect.behaviour.cutterEntry = CutterEntry::ByItself;
  dialect.behaviour.cutterCorners = CutterCorners::Arcs;
  dialect.behaviour.cutterBlocks = 0;
  return dialect;
}
Dialect millingOfTypeA() {
  Dialect dialect = milling();
  dialect.switches.sup = Switch::Off;
  return dialect;
}
const Dialect &turning() { return *findDialect(allDialects(), "fanuc-30i-lathe"); }

TEST(CutterProofs, TheCentreGoesWhereARunGoes) { expectSameContours<SquareContour>(milling(), 50); }
TEST(CutterProofs, TheTipOfALatheToolGoesWhereARunGoes) { expectSameContours<SquareContour>(turning(), 50); }
TEST(CutterProofs, TheCentreGoesWhereARunGoesAlongSlopes) { expectSameContours<SlantedContour>(milling(), 20); }
TEST(CutterProofs, TheCentreGoesWhereARunGoesAboutCornersByArcs) {
  expectSameContours<SquareContour>(millingByItself(), 50);
  expectSameContours<SlantedContour>(millingByItself(), 20);
}
TEST(CutterProofs, TheCentreGoesWhereARunGoesByAnOffsetOfEitherSign) {
  expectSameContours<SquareContour>(millingOfTypeA(), 0, Offset::OfEitherSign, 20);
  expectSameContours<SlantedContour>(millingOfTypeA(), 0, Offset::OfEitherSign, 1);
}
TEST(CutterProofs, TheTipGoesWhereARunGoesAlongSlopes) { expectSameContours<SlantedContour>(turning(), 20); }

} // namespace
} // namespace feedhold
