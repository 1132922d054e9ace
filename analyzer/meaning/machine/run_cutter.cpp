#include "meaning/machine/run_cutter.h"

#include <algorithm>
#include <array>
#include <numbers>

namespace feedhold {

namespace {

using Vector = PlaneVector<double>;
using Element = CutterElement<double>;
using Side = CutterSide<double>;

constexpr double kParallel = 1e-9; // sine of an angle that comes from rounding alone
constexpr double kStanding = 1e-9; // a shorter way is none
constexpr double kSame = 1e-7;     // offsets that rounding alone keeps apart
/// Where corners are arcs: a smaller turn is none, and one that misses the way back by less goes round the outside
/// (TOLERANCE_CONCAVE_CORNER in interp_convert.cc of LinuxCNC), in radians.
constexpr double kSmallTurn = 0.05;
/// Offset paths that miss one another by less are those of elements that touch, but for the rounding of their ends.
constexpr double kTouch = 1e-3;

double sizeOf(Vector v) { return std::hypot(v.first, v.second); }

/// The path of the centre beside an element, without its ends.
struct OffsetCurve {
  bool isCircle;
  Vector point; // of a line; or the centre
  Vector direction;
  double radius;
};
OffsetCurve curveAtEnd(const Element &element, Side side) {
  if (element.isArc)
    return {true, element.centre, {}, element.endRadius - side.sign * element.way * side.radius};
  return {false, element.end + side.radius * element.endNormal, element.endDirection, 0};
}
OffsetCurve curveAtStart(const Element &element, Side side) {
  if (element.isArc)
    return {true, element.centre, {}, element.startRadius - side.sign * element.way * side.radius};
  return {false, element.start + side.radius * element.startNormal, element.startDirection, 0};
}

using Crossings = std::vector<Vector>;
Crossings lineAndCircle(const OffsetCurve &line, const OffsetCurve &circle) {
  const Vector from = line.point - circle.point;
  const double along = dot(from, line.direction);
  const double aside = cross(line.direction, from);
  const double square = circle.radius * circle.radius - aside * aside;
  if (circle.radius < 0 || square < 0)
    return {};
  const double half = std::sqrt(square);
  return {line.point + (-along - half) * line.direction, line.point + (-along + half) * line.direction};
}
Crossings circles(const OffsetCurve &a, const OffsetCurve &b) {
  const Vector between = b.point - a.point;
  const double distance = sizeOf(between);
  if (a.radius < 0 || b.radius < 0 || distance < kParallel)
    return {};
  const double along = (distance * distance + a.radius * a.radius - b.radius * b.radius) / (2 * distance);
  const double square = a.radius * a.radius - along * along;
  if (square < 0)
    return {};
  const Vector direction = 1 / distance * between;
  const Vector middle = a.point + along * direction;
  const Vector aside = std::sqrt(square) * Vector{-direction.second, direction.first};
  return {middle + aside, middle - aside};
}
Crossings crossingsOf(const OffsetCurve &a, const OffsetCurve &b) {
  if (a.isCircle && b.isCircle)
    return circles(a, b);
  return a.isCircle ? lineAndCircle(b, a) : lineAndCircle(a, b);
}

/// How far a point of the offset path lies ahead of that beside a point of the element; in radians for an arc.
double wayFrom(const Element &element, Vector from, Vector point) {
  if (!element.isArc)
    return dot(point - from, element.endDirection);
  const Vector spoke = from - element.centre;
  const Vector other = point - element.centre;
  return element.way * std::atan2(cross(spoke, other), dot(spoke, other));
}

/// From one spoke to another along the way of an arc, the short way round.
double angleAlong(const Element &arc, Vector from, Vector to) {
  return arc.way * std::atan2(cross(from, to), dot(from, to));
}
/// What is left of an arc's sweep where its centre path goes from one offset to another.
double sweepBetween(const Element &arc, Vector from, Vector to) {
  const Vector start = arc.start - arc.centre;
  const Vector end = arc.end - arc.centre;
  return arc.sweep - angleAlong(arc, start, start + from) + angleAlong(arc, end, end + to);
}

/// The first of those that are listed for an offset that is given: the variables of several kinds of memories.
std::optional<double> firstGiven(StepContext<ConcreteInterpretation> &context,
                                 const std::array<std::uint32_t, 2> &firsts, std::uint32_t number) {
  const auto cellValue = [&](std::uint32_t variable) -> const ConcreteValue * {
    const std::uint32_t cell = cellOf(context.dialect(), variable);
    if (const ConcreteValue *written = context.state.variables.find(cell))
      return written;
    for (const auto &[given, value] : context.interpretation.allGiven())
      if (given == cell)
        return &value;
    return nullptr;
  };
  for (const std::uint32_t first : firsts)
    if (first != 0)
      if (const ConcreteValue *value = cellValue(first + number - 1))
        return value->vacant ? 0 : value->number;
  return std::nullopt;
}

} // namespace

double RunCutter::sweepOf(const Element &arc, std::uint32_t turns) const {
  constexpr double kFullCircle = 2 * std::numbers::pi;
  const Vector from = arc.start - arc.centre;
  const Vector to = arc.end - arc.centre;
  double angle = arc.way * std::atan2(cross(from, to), dot(from, to));
  if (magnitude(arc.end - arc.start) < 1e-7)
    angle = kFullCircle;
  else if (angle < 0)
    angle += kFullCircle;
  return angle + kFullCircle * (turns - 1.0);
}

CornerTurn RunCutter::turnByAngle(const Element &before, const Element &behind, int side) const {
  const Vector a = before.endDirection;
  const Vector b = behind.startDirection;
  const double angle = side * std::atan2(cross(a, b), dot(a, b));
  if (std::abs(angle) < kSmallTurn)
    return CornerTurn::None;
  if (std::abs(angle) > std::numbers::pi - kSmallTurn) // back along the same way, where an arc bends to the tool
    return behind.isArc && side * behind.way < 0 ? CornerTurn::Inner : CornerTurn::Outer;
  return angle > 0 ? CornerTurn::Inner : CornerTurn::Outer;
}

std::optional<Vector> RunCutter::innerCrossing(const Element &before, const Element &behind, Side side) const {
  Crossings all = crossingsOf(curveAtEnd(before, side), curveAtStart(behind, side));
  // An inner corner shortens both elements.
  const auto lengthens = [&](Vector point) {
    return wayFrom(before, before.end, point) > kTouch || wayFrom(behind, behind.start, point) < -kTouch;
  };
  if (!std::all_of(all.begin(), all.end(), lengthens))
    all.erase(std::remove_if(all.begin(), all.end(), lengthens), all.end());
  const auto fromCorner = [&](Vector point) { return magnitude(point - before.end); };
  const auto nearest =
      std::min_element(all.begin(), all.end(), [&](Vector a, Vector b) { return fromCorner(a) < fromCorner(b); });
  if (nearest != all.end())
    return *nearest - before.end;
  if (magnitude(side.radius * (before.endNormal - behind.startNormal)) < kTouch)
    return side.radius * (behind.isArc ? behind.startNormal : before.endNormal);
  return std::nullopt;
}

bool RunCutter::arcReversed(const Element &arc, Vector from, Vector to, double radius) const {
  return radius > kSame && sweepBetween(arc, from, to) < -kStanding;
}

Move<ConcreteValue> RunCutter::centreArc(Move<ConcreteValue> move, const Element &arc, Vector from, Vector to,
                                         double radius) const {
  const double sweep = sweepBetween(arc, from, to);
  // So short an arc would be read as a full circle.
  if (std::max(0.0, radius) * sweep < 10 * kSame) {
    move.kind = MoveKind::Feed;
    move.turns = 1;
  } else {
    move.turns = static_cast<std::uint32_t>(std::max(1.0, std::ceil(sweep / (2 * std::numbers::pi) - kStanding)));
  }
  return move;
}

std::optional<CutterOffset<double>> RunCutter::offsetOf(Context &context, const ConcreteValue &value) const {
  if (hasTurret(context))
    return noseOf(context, tipNumber(value.vacant ? 0 : value.number));
  if (!(value.number > 0 && value.number < 1e6))
    return std::nullopt;
  const auto number = static_cast<std::uint32_t>(value.number);
  const OffsetMemory &offsets = context.behaviour().cutterOffsets;
  const bool hasVariables = number <= offsets.count;
  const auto geometry = hasVariables ? firstGiven(context, offsets.geometry, number) : std::nullopt;
  const auto wear = hasVariables ? firstGiven(context, offsets.wear, number) : std::nullopt;
  if (geometry || wear) {
    const double sum = geometry.value_or(0) + wear.value_or(0);
    return CutterOffset<double>{isOn(context.dialect().switches.odi) ? sum / 2 : sum};
  }
  return otherwise_ ? otherwise_(value.number) : std::nullopt;
}

/// What no variable gives of it is that of the contract's tool.
std::optional<CutterOffset<double>> RunCutter::noseOf(Context &context, double number) const {
  const NoseMemory &offsets = context.behaviour().noseOffsets;
  const bool isWritten = std::ranges::any_of(context.state.variables.entries(),
                                             [](const auto &each) { return mayBeTipOffset(each.first, each.first); });
  if (offsets.radius.count == 0 && isWritten) // which of them is the radius, is not known
    return std::nullopt;
  const bool hasVariables = number >= 1 && number <= offsets.radius.count && number == std::floor(number);
  const auto given = [&](const std::array<std::uint32_t, 2> &firsts) {
    return hasVariables ? firstGiven(context, firsts, static_cast<std::uint32_t>(number)) : std::nullopt;
  };
  const auto geometry = given(offsets.radius.geometry);
  const auto wear = given(offsets.radius.wear);
  const auto tip = given(offsets.tip);
  const bool isTip = tip && *tip >= 0 && *tip < kTipDirections && *tip == std::floor(*tip);
  const auto other = otherwise_ ? otherwise_(number) : std::nullopt;
  if ((tip && !isTip) || (!other && !(tip && (geometry || wear))))
    return std::nullopt;
  CutterOffset<double> nose = other.value_or(CutterOffset<double>{});
  if (geometry || wear)
    nose.radius = geometry.value_or(0) + wear.value_or(0);
  if (tip)
    nose.tip = tipDirection(static_cast<std::uint8_t>(*tip));
  return nose;
}

} // namespace feedhold
