// Circle pocket: G12 (clockwise) and G13 of Haas mills: a round pocket about the position of the tool.
//
//   G13 I(radius) D Z F                     one circle
//   G13 I(first) K(last) Q(step) D Z F L    circles from I to K, Q apart; under G91, L times deeper
//
// The tool feeds down to Z, cuts the circles, and comes back to the centre.  The offset of D makes the radii smaller,
// as G41 or G42 would (CutterPath does it); I has to be larger than it.  Source: Haas mill operator's manual, "G12 /
// G13 circular pocket milling", which shows the way from one circle to the next in figures only.
//
// So a run goes straight from circle to circle, along the first axis, and all else takes the disc, in which every way
// from the centre and back lies: an arc of more than one turn that begins at the centre leads through all of its
// points.
#pragma once

#include "meaning/semantics/turning_strokes.h"

#include <algorithm>
#include <cmath>

namespace feedhold::detail {

template <ValueAlgebra R> class CirclePocket {
public:
  using Value = typename R::Value;
  using Point = std::array<Value, kAxisCount>;

  CirclePocket(StepContext<R> &context, const ExecutedWords<R> &words, CodeAction action)
      : context_(context), interpretation_(context.interpretation), state_(context.state), words_(words),
        kind_(action == CodeAction::CirclePocketClockwise ? MoveKind::ArcClockwise : MoveKind::ArcCounterclockwise) {}

  /// False: not followed.
  bool run() {
    const auto passes = passesOf();
    if (!passes || !readRadii())
      return false;
    for (int pass = 0; pass < *passes; ++pass) {
      feedDown();
      if (interpretation_.wantsMoves() && !cut())
        return false;
    }
    return true;
  }

private:
  static constexpr double kMostCircles = 10000;
  static constexpr double kMostPasses = 64;

  std::optional<int> passesOf() const {
    const auto *loops = words_.find('L');
    if (!loops)
      return 1;
    const auto count = interpretation_.constantOf(interpretation_.asNumber(loops->value));
    if (!count || *count < 1 || *count > kMostPasses || *count != std::floor(*count))
      return std::nullopt;
    return static_cast<int>(*count);
  }
  /// X or Y in the block move the tool to the centre first; how, the manual does not say.
  bool readRadii() {
    const TurningStrokes<R> words(context_, words_);
    const auto plane = planeOf(context_);
    if (!words.hasOnly("NGIKQDLZFSM") || !plane || plane->normal != Axis::Z ||
        interpretation_.mayBe(isPolar(context_)) || mayDrill() || !words_.find('I') ||
        (words_.find('K') != nullptr) != (words_.find('Q') != nullptr))
      return false;
    first_ = *words.length('I');
    step_ = words.length('Q');
    last_ = words.length('K').value_or(first_);
    // What a step of 0 does, the manual does not say.
    return !step_ || context_.proved(interpretation_.compare(Relation::Less, context_.zero(), *step_));
  }
  /// A canned cycle may be active: what the block then does, the manual does not say.
  bool mayDrill() {
    return !context_.certain(context_.inForce(ModalKind::Cycle, {CodeAction::CycleOff}, interpretation_.truth(true)));
  }
  void feedDown() {
    if (!words_.find('Z'))
      return;
    const Point start = state_.position;
    state_.at(Axis::Z) = targetOf(context_, words_)[indexOf(Axis::Z)];
    tell(context_, MoveKind::Feed, start);
  }

  /// An end of a move: the centre, or a point of a circle, which the offset moves.
  struct End {
    Point point;
    bool isOnCircle;
  };
  bool cut() {
    const End centre{state_.position, false};
    if (drawsStrokes(context_))
      return draw(centre);
    tellMove(kind_, centre, centre, onCircle(centre, first_), kDisc);
    if (step_)
      tellMove(kind_, centre, centre, onCircle(centre, last_), kDisc);
    return true;
  }
  bool draw(const End &centre) {
    const auto first = interpretation_.constantOf(first_), last = interpretation_.constantOf(last_);
    const auto step = step_ ? interpretation_.constantOf(*step_) : 1;
    if (!first || !last || !step || !(*step > 0) || !((*last - *first) / *step < kMostCircles))
      return false;
    const double largest = std::max(*first, *last);
    End here = centre;
    for (int circle = 0;; ++circle) {
      const double radius = std::min(*first + circle * *step, largest);
      const End there = onCircle(centre, interpretation_.number(radius));
      tellMove(MoveKind::Feed, centre, here, there);
      tellMove(kind_, centre, there, there);
      here = there;
      if (radius >= largest)
        break;
    }
    tellMove(MoveKind::Feed, centre, here, centre);
    return true;
  }

  End onCircle(const End &centre, const Value &radius) const {
    End end{centre.point, true};
    end.point[indexOf(Axis::X)] = interpretation_.add(centre.point[indexOf(Axis::X)], radius);
    return end;
  }
  static constexpr std::uint32_t kDisc = 2; // turns
  void tellMove(MoveKind kind, const End &centre, const End &start, const End &end, std::uint32_t turns = 1) {
    Move<Value> move;
    move.kind = kind;
    move.start = start.point;
    move.end = end.point;
    move.firstCentre = centre.point[indexOf(Axis::X)];
    move.secondCentre = centre.point[indexOf(Axis::Y)];
    move.turns = turns;
    move.feed = state_.word('F');
    move.offsetsStart = start.isOnCircle;
    move.offsetsEnd = end.isOnCircle;
    tell(context_, std::move(move));
  }

  StepContext<R> &context_;
  R &interpretation_;
  MachineState<R> &state_;
  const ExecutedWords<R> &words_;
  MoveKind kind_;
  Value first_{};
  Value last_{};
  std::optional<Value> step_;
};

} // namespace feedhold::detail
