// Corners: what `,C` (chamfer) and `,R` (rounding) make of the corner between two lines at feed.
//
// Where the first line ends depends on the second, so that it is told with that: the line, the corner, and then what is
// left of the second line, which may have a corner itself.  Until then it waits in the state (CornerState).  Whatever
// else comes first (a block without a line, a statement, a call, the end) is not followed: manuals ask for the second
// line in the next block.
//
//   ,C c   from c before the corner, along the first line, to c behind it
//   ,R r   an arc that is tangent to both; it takes r * tan(half the turn) from each
//
// Evidence: parity.md of each dialect.
#pragma once

#include "meaning/semantics/coordinates.h"
#include "meaning/semantics/targets.h"
#include "meaning/semantics/waiting_corner.h"

#include <algorithm>

namespace feedhold {

/// Something comes that is no line behind the corner, or none for certain: where the tool goes is not known, up to the
/// corner.  In the second case a run may follow it, and stop.
enum class CornerLost : std::uint8_t { Surely, Perhaps };
template <ValueAlgebra R> void loseCorner(StepContext<R> &context, CornerLost how = CornerLost::Surely);

// ---- implementation -----------------------------------------------------------------------------------------------

namespace detail {

template <ValueAlgebra R> CornerState<typename R::Value> noCorner(StepContext<R> &context) {
  const auto vacant = context.interpretation.vacant();
  return {vacant, vacant, {context.zero(), context.zero()}};
}

template <ValueAlgebra R> class Corners {
public:
  using Value = typename R::Value;
  using Truth = typename R::Truth;
  using Point = std::array<Value, kAxisCount>;

  Corners(StepContext<R> &context, const ExecutedWords<R> &words)
      : context_(context), interpretation_(context.interpretation), state_(context.state), words_(words) {}

  /// The block is a line that a corner can begin or end with, as far as its words say: the caller knows that it is a
  /// line at feed.
  bool isLine() {
    const std::optional<Plane> plane = planeOf(context_);
    const auto isBeside = [&](Axis axis) { return axis != plane->first && axis != plane->second && namesAxis(axis); };
    return plane && std::ranges::none_of(kAllAxes, isBeside) && (namesAxis(plane->first) || namesAxis(plane->second)) &&
           !interpretation_.mayBe(state_.transformed) && !interpretation_.mayBe(otherGeometry(context_)) &&
           !isOpenTarget(context_, words_);
  }

  /// The word of the block, if it has one and no other with a comma.
  const Word *word() const {
    const Word *found = nullptr;
    for (const Word &each : context_.tree().wordsOf(context_.block))
      if (each.has(Word::kComma)) {
        if (found || (each.address() != 'C' && each.address() != 'R'))
          return nullptr;
        found = &each;
      }
    return found;
  }

  /// Where the corner is not followed, a run may still follow it.
  void mayWait() {
    state_.corner.chamfer = interpretation_.either(interpretation_.vacant(), interpretation_.anyNumber());
  }

  /// The line from `start` to the present position waits.  False: its corner is not followed.
  bool wait(const Word &word, const Point &start) {
    const std::optional<Value> size = sizeOf(word);
    if (!size || !context_.proved(interpretation_.compare(Relation::Greater, *size, context_.zero())))
      return false;
    const Plane plane = *planeOf(context_);
    auto &corner = state_.corner;
    (word.address() == 'C' ? corner.chamfer : corner.radius) = *size;
    corner.start = {start[indexOf(plane.first)], start[indexOf(plane.second)]};
    return true;
  }

  /// The block is a line from `corner` to the present position: tells what waits.  From where the line goes on.
  Point complete(const Point &corner) {
    const Plane plane = *planeOf(context_);
    const CornerState<Value> waiting = state_.corner;
    const bool isRound = context_.certain(interpretation_.isVacant(waiting.chamfer));
    const Value size = isRound ? waiting.radius : waiting.chamfer;
    const Value &other = isRound ? waiting.chamfer : waiting.radius;
    if (!context_.certain(interpretation_.isVacant(other)) || interpretation_.mayBe(interpretation_.isVacant(size))) {
      loseCorner(context_, CornerLost::Perhaps);
      return corner;
    }
    state_.corner = noCorner(context_);
    const Vector at{corner[indexOf(plane.first)], corner[indexOf(plane.second)]};
    const Vector end{state_.position[indexOf(plane.first)], state_.position[indexOf(plane.second)]};
    const Way before = wayBetween(plane, waiting.start, at);
    const Way behind = wayBetween(plane, at, end);
    const auto cut = isRound ? tangentOf(before, behind, size) : std::optional(size);
    stopWhereShorter(before, cut, AlarmKind::CornerTooLarge);
    stopWhereShorter(behind, cut, AlarmKind::LineBehindCornerTooShort);
    const Point start = with(plane, corner, waiting.start);
    if (interpretation_.stopped())
      return corner;
    if (!cut) {
      interpretation_.unmodelled("a rounding between lines that may go straight on or back", context_.place());
      tellMove(MoveKind::Unmodelled, start, corner);
      return corner;
    }
    const Vector out = along(plane, at, before, interpretation_.negate(*cut));
    const Vector in = along(plane, at, behind, *cut);
    tellMove(MoveKind::Feed, start, with(plane, corner, out));
    tellCorner(plane, corner, {out, in},
               isRound ? std::optional(roundingOf(plane, before, behind, out, size)) : std::nullopt);
    return with(plane, corner, in);
  }

private:
  using Vector = std::array<Value, 2>;
  /// Lengths of a lathe are those of the part: in X half of the diameter.
  struct Way {
    Value length;
    Vector unit;
    std::optional<std::size_t> axis; // that it is parallel to; then
    Truth isPositive;                // it leads along it
  };
  struct Rounding {
    std::optional<MoveKind> kind; // absent: to which side the path turns is not known
    Vector centre;
  };
  struct Link {
    Vector out, in;
  };

  bool namesAxis(Axis axis) const {
    if (incrementsByLetter(context_))
      for (const auto &[letter, of] : kTurningIncrements)
        if (of == axis && words_.find(letter))
          return true;
    const bool isLetterOfOther =
        incrementsByLetter(context_) && (axis == Axis::U || axis == Axis::V || axis == Axis::W);
    return !isLetterOfOther && words_.find(letterOf(axis));
  }
  std::optional<Value> sizeOf(const Word &word) {
    if (word.isNumber())
      return scaledLiteral(context_, word.address(), word.number(), word.has(Word::kPoint));
    if (word.form() != WordForm::Expression)
      return std::nullopt;
    const Value value = evaluate(context_, word.expression());
    if (interpretation_.mayBe(interpretation_.isVacant(value)))
      return std::nullopt;
    return roundedToIncrement(context_, formatOf(context_.dialect(), word.address()), interpretation_.asNumber(value));
  }

  /// What a corner takes of a line that is not known may be too much.
  void stopWhereShorter(const Way &way, const std::optional<Value> &cut, AlarmKind alarm) {
    const Truth isShorter = cut ? interpretation_.compare(Relation::Less, way.length, *cut) : context_.maybeNot();
    interpretation_.alarm(isShorter, {alarm, context_.place()});
  }
  bool isDiameter(const Plane &plane, std::size_t i) const {
    return (i == 0 ? plane.first : plane.second) == Axis::X && context_.dialect().machine == MachineKind::Turning;
  }
  /// The side to which it leads is mostly known, and terms are plain then.
  Way wayAlong(std::size_t axis, const Value &length) {
    const Truth isPositive = interpretation_.compare(Relation::Greater, length, context_.zero());
    const bool positive = context_.proved(isPositive);
    const bool negative = !positive && context_.proved(interpretation_.negation(isPositive));
    const Value one = interpretation_.number(1), minusOne = interpretation_.number(-1);
    Way way{positive   ? length
            : negative ? interpretation_.negate(length)
                       : interpretation_.function(FunctionKind::Abs, length),
            {context_.zero(), context_.zero()},
            axis,
            positive || negative ? interpretation_.truth(positive) : isPositive};
    way.unit[axis] = interpretation_.select(way.isPositive, one, minusOne);
    return way;
  }
  Way wayBetween(const Plane &plane, const Vector &from, const Vector &to) {
    Vector way;
    for (std::size_t i = 0; i < 2; ++i) {
      way[i] = interpretation_.subtract(to[i], from[i]);
      if (isDiameter(plane, i))
        way[i] = interpretation_.divide(way[i], interpretation_.number(2));
    }
    for (std::size_t i = 0; i < 2; ++i)
      if (interpretation_.constantOf(way[1 - i]) == 0.0) {
        return wayAlong(i, way[i]);
      }
    const Value squares =
        interpretation_.add(interpretation_.multiply(way[0], way[0]), interpretation_.multiply(way[1], way[1]));
    // As along an axis where one of them is 0: a root may be rounded.
    const auto withoutOther = [&](std::size_t i, const Value &otherwise) {
      const Truth isAlone = interpretation_.compare(Relation::Equal, way[1 - i], context_.zero());
      return interpretation_.select(isAlone, interpretation_.function(FunctionKind::Abs, way[i]), otherwise);
    };
    const Value root = interpretation_.function(FunctionKind::Sqrt, squares);
    Way result{withoutOther(0, withoutOther(1, root)), way, std::nullopt, interpretation_.unknownTruth()};
    const Truth hasLength = interpretation_.compare(Relation::Greater, result.length, context_.zero());
    for (Value &part : result.unit)
      part = context_.proved(hasLength) ? interpretation_.divide(part, result.length) : interpretation_.anyNumber();
    return result;
  }
  static bool isSquare(const Way &a, const Way &b) { return a.axis && b.axis && *a.axis != *b.axis; }
  Value sine(const Way &a, const Way &b) {
    return interpretation_.subtract(interpretation_.multiply(a.unit[0], b.unit[1]),
                                    interpretation_.multiply(a.unit[1], b.unit[0]));
  }
  /// From the corner to where the arc begins; absent where the path may go straight on or back.
  std::optional<Value> tangentOf(const Way &a, const Way &b, const Value &radius) {
    if (isSquare(a, b))
      return radius;
    if (a.axis && b.axis)
      return std::nullopt;
    const Value cosine = interpretation_.add(interpretation_.multiply(a.unit[0], b.unit[0]),
                                             interpretation_.multiply(a.unit[1], b.unit[1]));
    const Value above = interpretation_.add(interpretation_.number(1), cosine);
    const Value size = interpretation_.function(FunctionKind::Abs, sine(a, b));
    const Value least = interpretation_.number(kLeastTurn);
    if (!context_.proved(interpretation_.compare(Relation::Greater, above, least)) ||
        !context_.proved(interpretation_.compare(Relation::Greater, size, least)))
      return std::nullopt;
    return interpretation_.divide(interpretation_.multiply(radius, size), above);
  }
  Vector along(const Plane &plane, const Vector &from, const Way &way, const Value &length) {
    Vector to;
    for (std::size_t i = 0; i < 2; ++i)
      to[i] = interpretation_.add(from[i], asCoordinate(plane, i, interpretation_.multiply(length, way.unit[i])));
    return to;
  }
  Value asCoordinate(const Plane &plane, std::size_t i, const Value &length) {
    return isDiameter(plane, i) ? interpretation_.multiply(length, interpretation_.number(2)) : length;
  }
  Truth turnsLeft(const Way &before, const Way &behind) {
    if (!isSquare(before, behind))
      return interpretation_.compare(Relation::Greater, sine(before, behind), context_.zero());
    const Truth alike = context_.either(
        interpretation_.both(before.isPositive, behind.isPositive),
        interpretation_.both(interpretation_.negation(before.isPositive), interpretation_.negation(behind.isPositive)));
    return *before.axis == 0 ? alike : interpretation_.negation(alike);
  }
  Rounding roundingOf(const Plane &plane, const Way &before, const Way &behind, const Vector &out,
                      const Value &radius) {
    const Truth isLeft = turnsLeft(before, behind);
    const bool left = context_.proved(isLeft);
    if (!left && !context_.proved(interpretation_.negation(isLeft)))
      return {std::nullopt, out};
    const Value towards = left ? radius : interpretation_.negate(radius);
    Way normal = before;
    normal.unit = {interpretation_.negate(before.unit[1]), before.unit[0]};
    return {left ? MoveKind::ArcCounterclockwise : MoveKind::ArcClockwise, along(plane, out, normal, towards)};
  }
  void tellCorner(const Plane &plane, const Point &corner, const Link &link, const std::optional<Rounding> &rounding) {
    const Point start = with(plane, corner, link.out), end = with(plane, corner, link.in);
    if (!rounding)
      return tellMove(MoveKind::Feed, start, end);
    if (!rounding->kind)
      return tellMove(MoveKind::Unmodelled, start, end);
    if constexpr (!requires { requires R::kAsksForKindsAlone; }) {
      Move<Value> move = moveOf(*rounding->kind, start, end);
      move.plane = plane;
      move.firstCentre = rounding->centre[0];
      move.secondCentre = rounding->centre[1];
      tell(context_, std::move(move));
    }
  }
  void tellMove(MoveKind kind, const Point &start, const Point &end) {
    if constexpr (!requires { requires R::kAsksForKindsAlone; }) // which was told of the block that waited
      tell(context_, moveOf(kind, start, end));
  }
  Move<Value> moveOf(MoveKind kind, const Point &start, const Point &end) {
    Move<Value> move;
    move.kind = kind;
    move.start = start;
    move.end = end;
    move.leadsToLine = true;
    move.feed = state_.word('F');
    return move;
  }
  static Point with(const Plane &plane, Point point, const Vector &inPlane) {
    point[indexOf(plane.first)] = inPlane[0];
    point[indexOf(plane.second)] = inPlane[1];
    return point;
  }

  static constexpr double kLeastTurn = 1e-6; // a smaller turn may be one of rounding

  StepContext<R> &context_;
  R &interpretation_;
  MachineState<R> &state_;
  const ExecutedWords<R> &words_;
};

} // namespace detail

template <ValueAlgebra R> void loseCorner(StepContext<R> &context, CornerLost how) {
  R &interpretation = context.interpretation;
  if (!interpretation.mayBe(waitsForLine(context)))
    return;
  context.state.corner = detail::noCorner(context);
  if (how == CornerLost::Perhaps)
    for (const AlarmKind alarm : {AlarmKind::CornerTooLarge, AlarmKind::LineBehindCornerTooShort})
      interpretation.alarm(context.maybeNot(), {alarm, context.place()});
  if constexpr (!requires { requires R::kAsksForKindsAlone; })
    tell(context, MoveKind::Unmodelled, context.state.position);
  interpretation.unmodelled("a corner (,C ,R) without a line in the next block", context.place());
}

} // namespace feedhold
