// Arcs: the circle that a block with G02 or G03 describes, what stops the control, and the movement.
#pragma once

#include "meaning/semantics/arc_radii.h"
#include "meaning/semantics/coordinates.h"
#include "meaning/semantics/executed_words.h"
#include "meaning/semantics/targets.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace feedhold::detail {

template <ValueAlgebra R> class Arcs {
public:
  using Value = typename R::Value;
  using Truth = typename R::Truth;
  using Point = std::array<Value, kAxisCount>;

  /// `hasOtherWay`: the block has words with which its path is not the plain arc.
  Arcs(StepContext<R> &context, const ExecutedWords<R> &words, bool hasOtherWay)
      : context_(context), interpretation_(context.interpretation), state_(context.state), words_(words),
        hasOtherWay_(hasOtherWay) {}

  /// `arc`: whether one is in force; `follows`: and the block makes it.
  void follow(const Point &start, Truth arc, Truth follows) {
    const bool isOther = interpretation_.mayBe(otherGeometry(context_));
    const std::optional<Plane> plane = planeOf(context_);
    if (isOther || !plane) { // only the end point is known
      if (isOther) {
        alarmsOfOtherGeometry(follows);
      } else if (interpretation_.mayBe(follows)) {
        distance_ = distanceOf(context_, words_);
        alarmsInAnyPlane(start, follows);
      }
      if (context_.certain(arc))
        tell(context_, MoveKind::Unmodelled, start);
      return;
    }
    distance_ = distanceOf(context_, words_);
    closeCircle(*plane, start);
    const Circle circle = circleIn(*plane, start);
    raise(alarmsOf(circle, start), follows);
    if (interpretation_.wantsMoves() && context_.certain(arc))
      tellArc(start, circle);
  }

private:
  /// The circle that the words of the block describe in one plane.
  struct Circle {
    Plane plane;
    Value first, second; // centre
    std::array<Value, 2>
        fromStart; // the same, as distances from the start: unless the control takes them as coordinates
    Truth byRadius;
    Truth byCentre;
    Truth beside; // there is a distance to the centre on the axis that is not of the plane
    CircleMapping<R> mapping;
  };
  /// What stops the control.
  struct Alarms {
    Truth withoutCentre, tooShort, withoutLength, radius;
  };

  Circle circleIn(const Plane &plane, const Point &start) {
    const auto fromStart = centreFromStart(plane);
    const auto [first, second] = centreOf(plane, start, fromStart);
    return {plane,
            first,
            second,
            fromStart,
            present('R'),
            context_.either(present(plane.firstCentre), present(plane.secondCentre)),
            centreBeside(plane),
            circleMappingOf(context_, plane)};
  }
  /// A distance to the centre on the axis that is not of the plane: a control may refuse it, or pass over it.
  Truth centreBeside(const Plane &plane) const {
    Truth beside = interpretation_.truth(false);
    for (const char letter : {'I', 'J', 'K'})
      if (letter != plane.firstCentre && letter != plane.secondCentre)
        beside = context_.either(beside, present(letter));
    return beside;
  }
  Truth without(const Circle &circle) {
    return interpretation_.negation(context_.either(circle.byRadius, circle.byCentre));
  }
  /// R counts before them; without any there is no radius that could differ, whether the block stops or moves in a
  /// line.
  Truth hasDistances(const Circle &circle) {
    return interpretation_.both(interpretation_.negation(circle.byRadius),
                                context_.either(circle.byCentre, circle.beside));
  }
  /// A control that refuses a distance beside the plane does so whatever else is given, but for R; of others it is not
  /// known whether it is in the place of the centre.
  Truth withoutCentre(const Circle &circle) {
    const Truth refused =
        interpretation_.both(interpretation_.both(circle.beside, interpretation_.negation(circle.byRadius)),
                             context_.isOn(&Switches::besideCentreStops));
    return context_.either(interpretation_.both(without(circle), interpretation_.negation(circle.beside)), refused);
  }
  Alarms alarmsOf(const Circle &circle, const Point &start) {
    Alarms alarms = alarmsOfRadius(circle, start);
    alarms.withoutCentre = withoutCentre(circle);
    const Truth differs = radiiDiffer(circle, start);
    const Truth isCircle = interpretation_.both(interpretation_.both(circle.mapping.staysCircle, circle.byCentre),
                                                interpretation_.truth(turnsOf().has_value()));
    const Truth mayDiffer =
        context_.either(interpretation_.both(isCircle, differs),
                        interpretation_.both(interpretation_.negation(isCircle), context_.maybeNot()));
    alarms.radius = interpretation_.both(hasDistances(circle), mayDiffer);
    return alarms;
  }
  void raise(const Alarms &alarms, Truth follows) {
    const auto stop = [&](Truth when, AlarmKind kind) {
      interpretation_.alarm(interpretation_.both(follows, when), {kind, context_.place()});
    };
    stop(alarms.withoutCentre, AlarmKind::ArcWithoutCentre);
    stop(alarms.tooShort, AlarmKind::ArcTooShort);
    stop(alarms.withoutLength, AlarmKind::ArcWithoutLength);
    stop(alarms.radius, AlarmKind::ArcRadius);
  }

  /// Whether the centre is missing is told exactly.  What follows from lengths may happen or not: proofs in several
  /// planes at once are long, and starts in other planes are run.
  Alarms someAlarmsOf(const Circle &circle) {
    const Truth byRadius = interpretation_.both(circle.byRadius, context_.maybeNot());
    return {withoutCentre(circle), byRadius,
            context_.dialect().switches.pointArcStops == Switch::Off ? interpretation_.truth(false) : byRadius,
            interpretation_.both(hasDistances(circle), context_.maybeNot())};
  }
  bool isUsual(CodeAction plane) const {
    const auto group = context_.modes.groupOf(ModalKind::Plane);
    const auto code = group ? context_.modes.powerOn(*group) : std::nullopt;
    return code && context_.modes.group(*group).codes[*code]->action == plane;
  }
  /// Literals say where the arc ends and how large it is: then it is told of any plane at no cost.
  bool isFixed(const Plane &plane, const Point &start) {
    const auto [a, b] = chordOf(plane, start);
    const auto isFixedWord = [&](char letter) {
      const auto *entry = words_.find(letter);
      return !entry || interpretation_.isFixed(entry->value);
    };
    return interpretation_.isFixed(a) && interpretation_.isFixed(b) &&
           std::ranges::all_of(std::string_view("RIJK"), isFixedWord);
  }
  /// In whichever plane is in force: one of the codes of their group always is.
  void alarmsInAnyPlane(const Point &start, Truth follows) {
    struct Case {
      Truth inForce;
      Alarms alarms;
    };
    std::vector<Case> cases;
    for (const auto &[action, plane] : kPlanes)
      if (const Truth inForce = context_.inForce(ModalKind::Plane, {action}, interpretation_.truth(false));
          interpretation_.mayBe(inForce))
        cases.push_back({inForce, isUsual(action) || isFixed(plane, start) ? alarmsOf(circleIn(plane, start), start)
                                                                           : someAlarmsOf(circleIn(plane, start))});
    const Truth other = inOtherPlane(context_);
    const bool areAll = !cases.empty() && !interpretation_.mayBe(other);
    const auto inCase = [&](Truth Alarms::*alarm) {
      Truth inSome = interpretation_.truth(false);
      Truth inAll = interpretation_.truth(areAll); // said, too, since not every interpretation sees it
      for (const Case &each : cases) {
        inSome = context_.either(inSome, interpretation_.both(each.inForce, each.alarms.*alarm));
        inAll = interpretation_.both(inAll, each.alarms.*alarm);
      }
      return context_.either(inSome, inAll);
    };
    raise({inCase(&Alarms::withoutCentre), inCase(&Alarms::tooShort), inCase(&Alarms::withoutLength),
           inCase(&Alarms::radius)},
          follows);
    if (interpretation_.mayBe(other))
      alarmsOfOtherGeometry(interpretation_.both(follows, other));
  }
  /// No circle of that radius goes through both ends.  All controls stop; how much too small the radius may be is a
  /// parameter of most, and one that is accepted makes half a circle.  Controls count increments: what their numbers
  /// add to the radius or the ends of half a circle is no difference.
  Alarms alarmsOfRadius(const Circle &circle, const Point &start) {
    const Truth none = interpretation_.truth(false);
    Alarms alarms{none, none, none, none};
    const auto *entry = words_.find('R');
    if (!entry || !interpretation_.mayBe(circle.byRadius))
      return alarms;
    constexpr double kNoDifference = 1e-6; // a tenth of the least increment of any control: 0.00001 inch
    const Value word =
        interpretation_.function(FunctionKind::Abs, interpretation_.multiply(entry->value, circle.mapping.scale));
    const Value radius = interpretation_.add(word, interpretation_.number(kNoDifference));
    const auto [a, b] = chordOf(circle.plane, start);
    const Value chordSquare = interpretation_.add(interpretation_.multiply(a, a), interpretation_.multiply(b, b));
    const Value halfSquare = interpretation_.divide(chordSquare, interpretation_.number(4));
    const auto isTooShort = [&](const Value &length) {
      return interpretation_.compare(Relation::Greater, halfSquare, interpretation_.multiply(length, length));
    };
    const Truth isShort =
        interpretation_.both(isTooShort(radius), context_.either(isTooShort(interpretation_.add(radius, tolerance())),
                                                                 context_.isOn(&Switches::shortArcStops)));
    const Truth isPoint = interpretation_.both(interpretation_.compare(Relation::Equal, chordSquare, context_.zero()),
                                               context_.isOn(&Switches::pointArcStops));
    const Truth asMapped = context_.either(circle.mapping.staysCircle, context_.maybeNot());
    alarms.tooShort = interpretation_.both(circle.byRadius, interpretation_.both(asMapped, isShort));
    alarms.withoutLength = interpretation_.both(circle.byRadius, isPoint);
    return alarms;
  }
  /// From start to end, as radii are counted.
  std::pair<Value, Value> chordOf(const Plane &plane, const Point &start) {
    const auto along = [&](Axis axis) {
      return asRadius(axis, distance_ ? (*distance_)[indexOf(axis)]
                                      : interpretation_.subtract(state_.at(axis), start[indexOf(axis)]));
    };
    return {along(plane.first), along(plane.second)};
  }
  /// Through the mappings and back a coordinate comes out a rounding error away, and a full circle would be none.
  void closeCircle(const Plane &plane, const Point &start) {
    constexpr double kSame = 1e-9;
    const auto isBack = [&](Axis axis) {
      const auto before = interpretation_.constantOf(start[indexOf(axis)]);
      const auto after = interpretation_.constantOf(state_.at(axis));
      return before && after && std::abs(*before - *after) < kSame;
    };
    if (!interpretation_.mayBe(state_.transformed) || !isBack(plane.first) || !isBack(plane.second))
      return;
    state_.at(plane.first) = start[indexOf(plane.first)];
    state_.at(plane.second) = start[indexOf(plane.second)];
    if (distance_)
      (*distance_)[indexOf(plane.first)] = (*distance_)[indexOf(plane.second)] = context_.zero();
  }
  /// Where a mode that is not followed gives the words another meaning.
  void alarmsOfOtherGeometry(Truth arc) {
    const Truth byCentre = interpretation_.both(arc, interpretation_.negation(present('R')));
    const Truth anyDistance = context_.either(present('I'), context_.either(present('J'), present('K')));
    const Truth without = context_.either(interpretation_.negation(anyDistance), context_.maybeNot());
    interpretation_.alarm(interpretation_.both(byCentre, without), {AlarmKind::ArcWithoutCentre, context_.place()});
    const auto mayStop = [&](Truth when, AlarmKind kind) {
      interpretation_.alarm(interpretation_.both(when, context_.maybeNot()), {kind, context_.place()});
    };
    mayStop(byCentre, AlarmKind::ArcRadius);
    const Truth byRadius = interpretation_.both(arc, present('R'));
    mayStop(byRadius, AlarmKind::ArcTooShort);
    if (context_.dialect().switches.pointArcStops != Switch::Off)
      mayStop(byRadius, AlarmKind::ArcWithoutLength);
  }
  Truth present(char letter) const { return words_.present(interpretation_, letter); }
  /// I, J, K are distances from the start point, mapped like those of the axes.
  std::array<Value, 2> centreFromStart(const Plane &plane) {
    Point distance;
    distance.fill(context_.zero());
    distance[indexOf(plane.first)] = asCoordinate(plane.first, distanceWord(context_, words_, plane.firstCentre));
    distance[indexOf(plane.second)] = asCoordinate(plane.second, distanceWord(context_, words_, plane.secondCentre));
    const Point mapped = toWorkDistance(context_, distance);
    return {mapped[indexOf(plane.first)], mapped[indexOf(plane.second)]};
  }
  /// They are coordinates only where the control has that mode.
  Truth areCoordinates() const {
    return context_.behaviour().arcDistanceModes
               ? context_.inForce(ModalKind::ArcDistance, {CodeAction::ArcAbsolute}, interpretation_.truth(false))
               : interpretation_.truth(false);
  }
  std::pair<Value, Value> centreOf(const Plane &plane, const Point &start, const std::array<Value, 2> &fromStart) {
    const auto centreOn = [&](Axis axis, const Value &distance, char letter) {
      const Value centre = interpretation_.add(start[indexOf(axis)], distance);
      return interpretation_.select(areCoordinates(), distanceWord(context_, words_, letter), centre);
    };
    return {centreOn(plane.first, fromStart[0], plane.firstCentre),
            centreOn(plane.second, fromStart[1], plane.secondCentre)};
  }
  /// On a lathe X is a diameter, I a radius.
  Value asCoordinate(Axis axis, const Value &length) {
    return axis == Axis::X && context_.dialect().machine == MachineKind::Turning
               ? interpretation_.multiply(length, interpretation_.number(2))
               : length;
  }
  Value asRadius(Axis axis, const Value &length) {
    return axis == Axis::X && context_.dialect().machine == MachineKind::Turning
               ? interpretation_.divide(length, interpretation_.number(2))
               : length;
  }
  /// From the centre to the start and to the end.  Of distances alone where the words are, since sums with a position
  /// of which nothing is known may be rounded by any amount.
  std::pair<std::array<Value, 2>, std::array<Value, 2>> spokesOf(const Circle &circle, const Point &start) {
    const Plane &plane = circle.plane;
    const auto inPlane = [&](auto &&along) -> std::array<Value, 2> {
      return {asRadius(plane.first, along(plane.first, 0)), asRadius(plane.second, along(plane.second, 1))};
    };
    if (distance_ && !interpretation_.mayBe(areCoordinates())) {
      const auto toStart = [&](Axis, std::size_t i) {
        return interpretation_.subtract(context_.zero(), circle.fromStart[i]);
      };
      const auto toEnd = [&](Axis axis, std::size_t i) {
        return interpretation_.subtract((*distance_)[indexOf(axis)], circle.fromStart[i]);
      };
      return {inPlane(toStart), inPlane(toEnd)};
    }
    const auto from = [&](const Point &point) {
      return inPlane([&](Axis axis, std::size_t i) {
        return interpretation_.subtract(point[indexOf(axis)], i == 0 ? circle.first : circle.second);
      });
    };
    return {from(start), from(state_.position)};
  }
  Truth radiiDiffer(const Circle &circle, const Point &start) {
    const auto [toStart, toEnd] = spokesOf(circle, start);
    const RadiiApart<R> apart = radiiApart(interpretation_, toStart, toEnd);
    const Truth differ = apart.exceed(interpretation_, tolerance());
    if (const double share = context_.behaviour().arcShare; share > 0) {
      const Value most = interpretation_.multiply(tolerance(), interpretation_.number(kMostTolerances));
      const Value shareOfRadius =
          interpretation_.multiply(apart.larger(interpretation_), interpretation_.number(share));
      const Truth isLarge = interpretation_.compare(Relation::Greater, apart.difference, shareOfRadius);
      return interpretation_.both(differ, context_.either(apart.exceed(interpretation_, most), isLarge));
    }
    return interpretation_.both(differ, context_.isOn(&Switches::radiiDifferStops));
  }
  /// Of LinuxCNC (interp_arc.cc): beyond, an arc stops the interpreter however large it is.
  static constexpr double kMostTolerances = 100;
  Value tolerance() {
    const Value metric = interpretation_.number(context_.behaviour().arcTolerance);
    return interpretation_.select(isMetric(context_), metric,
                                  interpretation_.number(context_.behaviour().arcToleranceInch));
  }

  void tellArc(const Point &start, const Circle &arc) {
    const CircleMapping<R> &mapping = arc.mapping;
    const std::optional<bool> clockwise = turnsClockwise(mapping.turnsOver);
    const std::optional<std::uint32_t> turns = turnsOf();
    if (!clockwise || !turns || !context_.certain(mapping.staysCircle) ||
        interpretation_.mayBe(interpretation_.both(without(arc), arc.beside)) || hasOtherWay_) {
      if (!context_.certain(mapping.staysCircle))
        interpretation_.unmodelled("an arc whose axes are scaled by different factors", context_.place());
      else if (!clockwise)
        interpretation_.unmodelled("an arc in an unknown direction", context_.place());
      else if (!turns)
        interpretation_.unmodelled("an arc with words for a spiral or for full turns", context_.place());
      return tell(context_, MoveKind::Unmodelled, start);
    }
    Move<Value> move;
    move.kind = *clockwise ? MoveKind::ArcClockwise : MoveKind::ArcCounterclockwise;
    move.start = start;
    move.end = state_.position;
    move.plane = arc.plane;
    const auto byRadius = centreFromRadius(arc.plane, start, *clockwise, mapping.scale);
    move.firstCentre = interpretation_.select(arc.byRadius, byRadius.first, arc.first);
    move.secondCentre = interpretation_.select(arc.byRadius, byRadius.second, arc.second);
    move.turns = *turns;
    move.feed = state_.word('F');
    if (context_.certain(arc.byRadius) && sameInPlane(arc.plane, start))
      move.kind = MoveKind::Feed; // no arc at all: 0 degrees
    tell(context_, std::move(move));
  }
  /// Seen in work coordinates; absent when it can be either.
  std::optional<bool> turnsClockwise(Truth turnsOver) {
    const Truth none = interpretation_.truth(false);
    const bool clockwise = context_.certain(context_.inForce(ModalKind::Motion, {CodeAction::ArcClockwise}, none));
    const bool counter = context_.certain(context_.inForce(ModalKind::Motion, {CodeAction::ArcCounterclockwise}, none));
    const bool over = context_.certain(turnsOver);
    if (clockwise == counter || (!over && interpretation_.mayBe(turnsOver)))
      return std::nullopt;
    return clockwise != over;
  }
  /// P turns of controls that count them; absent: not known, or the block has words of a spiral or of a cone.
  std::optional<std::uint32_t> turnsOf() {
    if (!context_.behaviour().arcDistanceModes) {
      const bool isOther = words_.find('L') || words_.find('Q') || words_.find('P');
      return isOther ? std::nullopt : std::optional<std::uint32_t>(1);
    }
    const auto *entry = words_.find('P');
    if (!entry)
      return 1;
    const std::optional<double> turns = interpretation_.constantOf(entry->value);
    if (!turns || *turns >= 1e6 || !context_.certain(entry->present))
      return std::nullopt;
    return *turns >= 1 ? static_cast<std::uint32_t>(*turns) : 1;
  }
  bool sameInPlane(const Plane &plane, const Point &start) {
    const auto same = [&](Axis axis) {
      return context_.certain(interpretation_.compare(Relation::Equal, start[indexOf(axis)], state_.at(axis)));
    };
    return same(plane.first) && same(plane.second);
  }
  /// The centre lies on the perpendicular through the middle of the chord; the sign of R chooses the longer arc.
  std::pair<Value, Value> centreFromRadius(const Plane &plane, const Point &start, bool clockwise, const Value &scale) {
    const Value zero = context_.zero();
    const auto *entry = words_.find('R');
    if (!entry)
      return {zero, zero};
    const Value radius = interpretation_.multiply(entry->value, scale);
    const Value two = interpretation_.number(2);
    const auto [a, b] = chordOf(plane, start);
    const Value chordSquare = interpretation_.add(interpretation_.multiply(a, a), interpretation_.multiply(b, b));
    const Value heightSquare = interpretation_.subtract(interpretation_.multiply(radius, radius),
                                                        interpretation_.divide(chordSquare, interpretation_.number(4)));
    const Truth negative = interpretation_.compare(Relation::Less, heightSquare, zero);
    const Value height =
        interpretation_.function(FunctionKind::Sqrt, interpretation_.select(negative, zero, heightSquare));
    const Truth noChord = interpretation_.compare(Relation::Equal, chordSquare, zero);
    const Value chord = interpretation_.function(
        FunctionKind::Sqrt, interpretation_.select(noChord, interpretation_.number(1), chordSquare));
    const Truth longArc = interpretation_.compare(Relation::Less, entry->value, zero);
    const Value side = interpretation_.select(longArc, interpretation_.number(clockwise ? 1 : -1),
                                              interpretation_.number(clockwise ? -1 : 1));
    const Value ratio = interpretation_.multiply(side, interpretation_.divide(height, chord));
    const auto from = [&](Axis axis, const Value &length) {
      return interpretation_.add(start[indexOf(axis)], asCoordinate(axis, length));
    };
    return {
        from(plane.first, interpretation_.subtract(interpretation_.divide(a, two), interpretation_.multiply(ratio, b))),
        from(plane.second, interpretation_.add(interpretation_.divide(b, two), interpretation_.multiply(ratio, a)))};
  }

  StepContext<R> &context_;
  R &interpretation_;
  MachineState<R> &state_;
  const ExecutedWords<R> &words_;
  bool hasOtherWay_;
  std::optional<Point> distance_ = std::nullopt; // from the start to the end, where the words say it
};

} // namespace feedhold::detail
