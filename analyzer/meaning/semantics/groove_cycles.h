// Groove cycles: G74 and G75 of lathes (G76 and G77 in G code system C).
//
//   G75 R(e) ; G75 X(U)_ Z(W)_ P(i) Q(k) R(d) F_      FANUC, two blocks; i in radius, i and k in least increments
//   G75 X(U)_ Z(W)_ I(i) K(k) D(d) F_                 one block: Haas, and the older FANUC form
//
// G75 feeds i along X, goes back e at rapid, and so on down to X; back at rapid to the X of the start, k along Z
// towards Z at rapid, and again, the last time at Z; then back to the start.  G74 the same with both axes exchanged:
// without X it drills on the axis.  Source: FANUC lathe operator's manual, "multiple repetitive cycle", G74 and G75;
// Haas lathe operator's manual, G74 and G75.
//
// All strokes lie in the box between the start and X Z, but for the way back e: where it is longer than the first peck,
// it leads past the start by the difference.  A control keeps it from the last first block of any program: without one
// above it the cycle is not followed but by a run, which leaves it out.  Of one block a setting says it (Setting 22 of
// Haas): a run leaves it out, and no other interpretation takes it to be longer than a peck.  Not followed: the relief
// d at the bottom, which moves the tool aside within the part.
#pragma once

#include "meaning/semantics/turning_strokes.h"

#include <cmath>

namespace feedhold::detail {

template <ValueAlgebra R> class GrooveCycle {
public:
  using Value = typename R::Value;

  GrooveCycle(StepContext<R> &context, const ExecutedWords<R> &words, CodeAction action)
      : context_(context), interpretation_(context.interpretation), state_(context.state), words_(words),
        strokes_(context, words), action_(action), along_(action == CodeAction::FaceGroove ? Axis::Z : Axis::X),
        across_(action == CodeAction::FaceGroove ? Axis::X : Axis::Z) {}

  /// False: not followed.
  bool run() {
    if (!strokes_.namesAxes())
      return learnRetract();
    if (!readWords())
      return false;
    const auto target = targetOf(context_, words_);
    if (!drawsStrokes(context_))
      return cutInBox(target);
    return draw(target[indexOf(along_)], target[indexOf(across_)]);
  }

private:
  bool learnRetract() {
    endCycle(context_);
    const auto *back = words_.find('R');
    if (!context_.dialect().hasFanucParameters || !strokes_.hasOnly("NGR") || !back || strokes_.isNegative(back->value))
      return false;
    strokes_.learn(action_, back->value, std::nullopt);
    return true;
  }
  bool readWords() {
    const bool isOneBlock = words_.find('I') || words_.find('K');
    if (!strokes_.hasOnly(isOneBlock ? "NGXZIKDFSTM" : "NGXZPQRFSTM") ||
        (!isOneBlock && !context_.dialect().hasFanucParameters))
      return false;
    const auto relief = isOneBlock ? strokes_.lengthInIncrements('D') : strokes_.length('R');
    if (words_.find(isOneBlock ? 'D' : 'R') && (!relief || !strokes_.isZero(*relief)))
      return false;
    isOneBlock_ = isOneBlock;
    auto alongX = isOneBlock ? strokes_.length('I') : strokes_.lengthInIncrements('P');
    if (alongX)
      alongX = strokes_.twice(*alongX);
    const auto alongZ = isOneBlock ? strokes_.length('K') : strokes_.lengthInIncrements('Q');
    peck_ = along_ == Axis::X ? alongX : alongZ;
    step_ = along_ == Axis::X ? alongZ : alongX;
    return true;
  }
  /// In X as a diameter.
  std::optional<Value> retract() const {
    const auto given = strokes_.learned(state_.cycle.initial);
    return given && along_ == Axis::X ? std::optional(strokes_.twice(*given)) : given;
  }

  bool cutInBox(const std::array<Value, kAxisCount> &target) {
    auto from = state_.position;
    const auto back = retract();
    if (peck_ && !back && (!isOneBlock_ || context_.dialect().hasFanucParameters))
      return false; // what an earlier block or program has said
    if (peck_ && back) {
      const Value past = strokes_.notNegative(interpretation_.subtract(*back, *peck_));
      from[indexOf(along_)] = strokes_.awayFrom(target[indexOf(along_)], from[indexOf(along_)], past);
    }
    strokes_.cutInBox(from, target);
    return true;
  }

  bool draw(const Value &bottom, const Value &last) {
    constexpr double kMostStrokes = 9999;
    const auto top = strokes_.constant(state_.at(along_)), first = strokes_.constant(state_.at(across_));
    const auto end = strokes_.constant(bottom), side = strokes_.constant(last);
    if (!top || !first || !end || !side)
      return false;
    const double depth = strokes_.constant(peck_).value_or(0), step = strokes_.constant(step_).value_or(0);
    const double width = std::fabs(*side - *first);
    if (depth < 0 || step < 0 || (width > 0 && step == 0))
      return false;
    const double pecks = depth > 0 ? std::fabs(*end - *top) / depth : 1, grooves = width > 0 ? width / step : 1;
    if (!((pecks + 1) * (grooves + 1) < kMostStrokes))
      return false;
    const double back = strokes_.constant(retract()).value_or(0);
    plunge(*top, *end, depth, back);
    for (double at = *first; std::fabs(*side - at) > kSame;) {
      at = towards(at, *side, step);
      strokes_.go(MoveKind::Rapid, across_, interpretation_.number(at));
      plunge(*top, *end, depth, back);
    }
    if (width > kSame)
      strokes_.go(MoveKind::Rapid, across_, interpretation_.number(*first));
    return true;
  }
  void plunge(double top, double end, double depth, double back) {
    const double away = end < top ? back : -back;
    for (double at = top; depth > 0 && back != 0;) {
      at = towards(at, end, depth);
      if (std::fabs(end - at) <= kSame)
        break;
      strokes_.go(MoveKind::Feed, along_, interpretation_.number(at));
      strokes_.go(MoveKind::Rapid, along_, interpretation_.number(at + away));
    }
    strokes_.go(MoveKind::Feed, along_, interpretation_.number(end));
    strokes_.go(MoveKind::Rapid, along_, interpretation_.number(top));
  }
  static double towards(double at, double end, double distance) {
    return std::fabs(end - at) <= distance + kSame ? end : at + (end < at ? -distance : distance);
  }

  static constexpr double kSame = 1e-9;
  StepContext<R> &context_;
  R &interpretation_;
  MachineState<R> &state_;
  const ExecutedWords<R> &words_;
  TurningStrokes<R> strokes_;
  CodeAction action_;
  Axis along_;  // pecks
  Axis across_; // from groove to groove
  std::optional<Value> peck_{};
  std::optional<Value> step_{};
  bool isOneBlock_ = false;
};

} // namespace feedhold::detail
