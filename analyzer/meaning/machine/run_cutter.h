// RunCutter: cutter compensation in the numbers of a run: the host of CutterPath.
#pragma once

#include "meaning/machine/recorded_move.h"
#include "meaning/semantics/cutter_path.h"

#include <cmath>
#include <functional>

namespace feedhold {

class RunCutter {
public:
  using Interpretation = ConcreteInterpretation;
  using Value = ConcreteValue;
  using Length = double;
  using Truth = bool;
  using Vector = PlaneVector<double>;
  using Element = CutterElement<double>;
  using Context = StepContext<ConcreteInterpretation>;

  using OtherOffset = std::function<std::optional<CutterOffset<double>>(double number)>;
  /// `otherwise`: the offset that no variable gives, of a D or of a T; absent: such a path is not followed.
  RunCutter(std::vector<RecordedMove> &moves, OtherOffset otherwise = {})
      : moves_(moves), otherwise_(std::move(otherwise)) {}

  static constexpr std::string_view kNoOffset =
      "cutter compensation by an offset that is not given (give it by --offset D1=5)";
  static constexpr std::string_view kNoNose = "tool nose radius compensation by an offset that is not given (give it "
                                              "by --offset R1=0.8 --offset T1=3)";

  // ---- truths and lengths ----
  bool holds(bool truth) const { return truth; }
  std::string_view takeUndecided() const { return {}; }
  bool knowsReadAhead(const Dialect &) const { return true; } // the usual setting
  bool isOn(Switch setting) const { return setting == Switch::On; }
  bool none(double length, double tolerance) const { return std::abs(length) <= tolerance; }
  bool positive(double length, double tolerance) const { return length > tolerance; }
  bool notPositive(double length, double tolerance) const { return length <= tolerance; }
  bool negative(double length, double tolerance) const { return length < -tolerance; }
  bool standing(Vector v, double tolerance) const { return magnitude(v) <= tolerance; }
  bool apart(Vector a, Vector b, double tolerance) const { return magnitude(a - b) > tolerance; }
  std::optional<int> signOf(double offset) const { return offset < 0 ? -1 : 1; }
  void cannotTell(std::string_view) const {}
  double number(double value) const { return value; }
  double lengthOf(const ConcreteValue &value) const { return value.number; }
  double magnitude(Vector v) const { return std::hypot(v.first, v.second); }
  Vector unit(Vector v) const { return 1 / magnitude(v) * v; }
  Vector direction(Vector v) const { return unit(v); }
  Vector crossing(Vector n, Vector m, double radius) const { return radius / (1 + dot(n, m)) * (n + m); }
  double quotient(double dividend, double divisor) const { return dividend / divisor; }
  double least(double a, double b) const { return std::min(a, b); }

  // ---- angles and crossings ----
  double sweepOf(const Element &arc, std::uint32_t turns) const;
  CornerTurn turnByAngle(const Element &before, const Element &behind, int side) const;
  std::optional<Vector> innerCrossing(const Element &before, const Element &behind, CutterSide<double> side) const;
  bool arcReversed(const Element &arc, Vector from, Vector to, double radius) const;
  /// `move` with the ends of the centre's path.
  Move<ConcreteValue> centreArc(Move<ConcreteValue> move, const Element &arc, Vector from, Vector to,
                                double radius) const;

  // ---- offsets ----
  std::string_view whyNoOffset() const { return kNoOffset; }
  std::optional<CutterOffset<double>> offsetOf(Context &context, const ConcreteValue &value) const;

  // ---- moves ----
  const Move<ConcreteValue> &moveOf(std::size_t index) const { return moves_[index].move; }
  void follow(std::size_t index, std::vector<Move<ConcreteValue>> centre, const std::array<double, 3> &tip) {
    moves_[index].centre = std::move(centre);
    moves_[index].tip = tip;
  }
  void leave(std::size_t index, std::string_view) {
    moves_[index].isOfTool = moves_[index].isOfToolButForLength = moves_[index].isOfAxes = false;
  }
  bool areInOneSpace(std::size_t a, std::size_t b) const {
    return moves_[a].zero == moves_[b].zero && moves_[a].unit == moves_[b].unit;
  }
  void shift(ConcreteValue &value, double length) const { value.number += length; }
  bool refuses(bool truth, AlarmKind, Place) const { return truth; }

private:
  std::optional<CutterOffset<double>> noseOf(Context &context, double number) const;

  std::vector<RecordedMove> &moves_;
  OtherOffset otherwise_;
};

} // namespace feedhold
