// Thread passes: G76 of lathes (G78 in G code system C).
//
//   G76 P(mra) Q(least depth) R(d) ; G76 X(U)_ Z(W)_ R(i) P(k) Q(first depth) F_    FANUC, two blocks
//   G76 X(U)_ Z(W)_ I(i) K(k) D(first depth) A(angle) F_                            one block: Haas, older FANUC
//
// X Z is the end of the thread at its root, k its height and i its taper, in radius; P k and Q count least increments.
// Each pass goes along X at rapid, cuts along Z, and comes back to the start along X and Z at rapid.  Pass n is first
// depth * sqrt(n) below the crest (X + 2 k), and at least the least depth below the pass before; the last but one
// leaves d, the last none.  Source: FANUC lathe operator's manual, "multiple threading cycle"; Haas lathe operator's
// manual, G76.
//
// A run draws each pass from the Z of the start, the finishing pass once, no chamfer, and takes what only parameters
// say (5140, 5141; Settings 86 and 99) to be 0.  All else takes the box that holds every pass: from the start, or from
// the crest where that is further away, to X Z.  The angle of the infeed shifts the beginning of a pass along Z by no
// more than k tan(a / 2), whatever the manual's drawing means by its direction: for angles up to 120 degrees that is
// less than 2 k, by which the box begins before the start.  A chamfer leads back towards the X of the start.
#pragma once

#include "meaning/semantics/turning_strokes.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace feedhold::detail {

template <ValueAlgebra R> class ThreadPasses {
public:
  using Value = typename R::Value;

  ThreadPasses(StepContext<R> &context, const ExecutedWords<R> &words)
      : context_(context), interpretation_(context.interpretation), state_(context.state), words_(words),
        strokes_(context, words) {}

  /// False: not followed.
  bool run() {
    if (!strokes_.namesAxes())
      return learnDepths();
    if (!readWords())
      return false;
    const auto target = targetOf(context_, words_);
    const Value &x = target[indexOf(Axis::X)], &z = target[indexOf(Axis::Z)];
    return drawsStrokes(context_) ? draw(x, z) : cutInBox(x, z);
  }

private:
  bool learnDepths() {
    endCycle(context_);
    if (!context_.dialect().hasFanucParameters || !strokes_.hasOnly("NGPQR"))
      return false;
    strokes_.learn(CodeAction::ThreadPasses, strokes_.lengthInIncrements('Q'), strokes_.length('R'));
    return true;
  }
  bool readWords() {
    const bool isOneBlock = words_.find('K') != nullptr;
    if (!strokes_.hasOnly(isOneBlock ? "NGXZIKDAPQFESTM" : "NGXZRPQFESTM") ||
        (!isOneBlock && !context_.dialect().hasFanucParameters))
      return false;
    height_ = isOneBlock ? strokes_.length('K') : strokes_.lengthInIncrements('P');
    first_ = strokes_.lengthInIncrements(isOneBlock ? 'D' : 'Q');
    taper_ = strokes_.twice(strokes_.length(isOneBlock ? 'I' : 'R').value_or(context_.zero()));
    return height_ && first_;
  }

  bool cutInBox(const Value &x, const Value &z) {
    const Value rootAtStart = interpretation_.add(x, taper_);
    const Value twiceHeight = strokes_.twice(strokes_.notNegative(*height_));
    const auto isInner = interpretation_.compare(Relation::Less, state_.at(Axis::X), x);
    const auto crestOf = [&](const Value &root) {
      return interpretation_.select(isInner, interpretation_.subtract(root, twiceHeight),
                                    interpretation_.add(root, twiceHeight));
    };
    const auto further = [&](const Value &a, const Value &b) {
      return interpretation_.select(interpretation_.compare(Relation::Less, a, b),
                                    interpretation_.select(isInner, a, b), interpretation_.select(isInner, b, a));
    };
    const bool isTapered = !strokes_.isZero(taper_);
    Value far = further(state_.at(Axis::X), crestOf(x));
    if (isTapered)
      far = further(far, crestOf(rootAtStart));
    for (const Relation below : {Relation::Less, Relation::LessOrEqual}) {
      const auto from = strokes_.at(far, strokes_.awayFrom(z, state_.at(Axis::Z), twiceHeight, below));
      strokes_.cutInBox(from, strokes_.at(x, z));
      if (isTapered)
        strokes_.cutInBox(from, strokes_.at(rootAtStart, z));
    }
    return true;
  }

  bool draw(const Value &x, const Value &z) {
    constexpr double kMostPasses = 9999;
    const auto end = strokes_.constant(x), start = strokes_.constant(state_.at(Axis::X));
    const auto height = strokes_.constant(height_), first = strokes_.constant(first_);
    if (!end || !start || !height || !first || !(*height > 0) || !(*first > 0))
      return false;
    const double least = std::max(0.0, strokes_.constant(strokes_.learned(state_.cycle.initial)).value_or(0));
    const double left = std::clamp(strokes_.constant(strokes_.learned(state_.cycle.dwell)).value_or(0), 0.0, *height);
    const double outwards = *start < *end ? -2 : 2;
    std::vector<double> depths;
    for (double depth = 0, n = 1; depth < *height - left && n < kMostPasses; ++n) {
      depth = std::min(std::max(*first * std::sqrt(n), depth + least), *height - left);
      depths.push_back(depth);
    }
    if (depths.size() + 1 >= kMostPasses)
      return false;
    if (left > 0)
      depths.push_back(*height);
    for (const double depth : depths)
      pass(interpretation_.number(*end + outwards * (*height - depth)), z);
    return true;
  }
  void pass(const Value &x, const Value &z) {
    const Value fromX = state_.at(Axis::X), fromZ = state_.at(Axis::Z);
    strokes_.go(MoveKind::Rapid, Axis::X, interpretation_.add(x, taper_));
    strokes_.go(MoveKind::Feed, x, z);
    strokes_.go(MoveKind::Rapid, Axis::X, fromX);
    strokes_.go(MoveKind::Rapid, Axis::Z, fromZ);
  }

  StepContext<R> &context_;
  R &interpretation_;
  MachineState<R> &state_;
  const ExecutedWords<R> &words_;
  TurningStrokes<R> strokes_;
  std::optional<Value> height_{};
  std::optional<Value> first_{};
  Value taper_{}; // in diameter: where the root begins, from where it ends
};

} // namespace feedhold::detail
