// Polar coordinates (G16): the first axis of the plane is a radius about the zero point of the program, the second an
// angle.
//
// What a block does not say stays as it is.  FANUC (operator's manual, polar coordinate command, bolt hole circle):
// behind `G81 X100. Y30.` the block `Y150.` drills at a radius of 100, and `G91 Y120.` adds to the angle and keeps
// radius and zero point.  Mitsubishi (M700V, M70V programming manual, 6.12) takes what is not written from the present
// position: its distance from the zero point, its angle; so does Siemens in its ISO dialect (802D, G15/G16).  Behind a
// movement in polar coordinates both say the same, and nothing else is followed (kept_words.h).  At a radius of 0 or
// below the two differ: the angle of the position is not the one that was written.
//
// A radius under G91 is a distance from where the tool is.  From which direction its angle counts then, manuals show in
// figures that differ (FANUC: from that of the present position; NCT: from the angle before): that is not followed.
#pragma once

#include "meaning/semantics/kept_words.h"

namespace feedhold {

/// Where the words of a block lead in polar coordinates; axes that they do not name stay.
template <ValueAlgebra R>
void fromPolar(StepContext<R> &context, const ExecutedWords<R> &words,
               std::array<typename R::Value, kAxisCount> &target);

/// Where they lead is not followed.
template <ValueAlgebra R> bool isOpenPolar(StepContext<R> &context, const ExecutedWords<R> &words);

/// Behind a movement to that point: what the next block may leave out.
template <ValueAlgebra R> void keepPolar(StepContext<R> &context, const ExecutedWords<R> &words, const Plane &plane);

// ---- implementation -----------------------------------------------------------------------------------------------

namespace detail {

/// A block under G16, in a plane that is known.
template <ValueAlgebra R> class PolarBlock {
public:
  using Value = typename R::Value;
  using Truth = typename R::Truth;

  PolarBlock(StepContext<R> &context, const ExecutedWords<R> &words, const Plane &plane)
      : context_(context), interpretation_(context.interpretation), kept_(context.state.kept), words_(words),
        radius_(words.find(letterOf(plane.first))), angle_(words.find(letterOf(plane.second))) {}

  bool isNamed() const { return radius_ || angle_; }
  Truth isWritten() { return context_.either(saysRadius(), saysAngle()); }
  /// What the words say, or what they leave as it is.
  Value radius() {
    const Value kept = interpretation_.asNumber(kept_.first);
    return radius_ ? interpretation_.select(saysRadius(), radius_->value, kept) : kept;
  }
  Value angle() {
    const Value kept = interpretation_.asNumber(kept_.second);
    if (!angle_)
      return kept;
    const Value said =
        interpretation_.select(isAbsolute(context_), angle_->value, interpretation_.add(kept, angle_->value));
    return interpretation_.select(saysAngle(), said, kept);
  }
  bool isOpen() {
    const Truth none = interpretation_.negation(isWritten());
    if (!isNamed() || context_.certain(none))
      return false;
    const Truth isTold = interpretation_.both(isPolar(context_), interpretation_.both(isRadiusTold(), isAngleTold()));
    return !context_.proved(context_.either(none, isTold));
  }

private:
  Truth saysRadius() { return radius_ ? radius_->present : interpretation_.truth(false); }
  Truth saysAngle() { return angle_ ? angle_->present : interpretation_.truth(false); }
  Truth isRadiusTold() {
    return interpretation_.both(context_.either(isAbsolute(context_), interpretation_.negation(saysRadius())),
                                context_.either(saysRadius(), isKept(kept_.first)));
  }
  Truth isAngleTold() {
    const Truth isNew = interpretation_.both(saysAngle(), isAbsolute(context_));
    const Truth isAbove = context_.either(interpretation_.negation(saysRadius()),
                                          interpretation_.compare(Relation::Greater, radius(), context_.zero()));
    const Truth isOld = interpretation_.both(isKept(kept_.first), interpretation_.both(isKept(kept_.second), isAbove));
    return context_.either(isNew, isOld);
  }
  Truth isKept(const Value &value) {
    return interpretation_.both(isKeptHere(), interpretation_.negation(interpretation_.isVacant(value)));
  }
  /// The present position is that of the words: no mapping lies between them, and no code of the block takes the words
  /// for a point on its way, of which no manual says whether it is polar.
  Truth isKeptHere() {
    for (const CodeAction action :
         {CodeAction::ReferenceReturn, CodeAction::SecondReference, CodeAction::ReferenceCheck, CodeAction::Skip})
      if (words_.has(action))
        return interpretation_.truth(false);
    return interpretation_.negation(context_.state.transformed);
  }

  StepContext<R> &context_;
  R &interpretation_;
  const KeptWords<Value> &kept_;
  const ExecutedWords<R> &words_;
  const typename ExecutedWords<R>::Entry *radius_;
  const typename ExecutedWords<R>::Entry *angle_;
};

} // namespace detail

template <ValueAlgebra R> bool isOpenPolar(StepContext<R> &context, const ExecutedWords<R> &words) {
  if (!context.interpretation.mayBe(detail::isPolar(context)))
    return false;
  const std::optional<Plane> plane = planeOf(context);
  return !plane || detail::PolarBlock<R>(context, words, *plane).isOpen();
}

template <ValueAlgebra R>
void fromPolar(StepContext<R> &context, const ExecutedWords<R> &words,
               std::array<typename R::Value, kAxisCount> &target) {
  R &interpretation = context.interpretation;
  if (!interpretation.mayBe(detail::isPolar(context)))
    return;
  const std::optional<Plane> plane = planeOf(context);
  if (!plane) {
    target.fill(interpretation.anyNumber());
    return;
  }
  detail::PolarBlock<R> block(context, words, *plane);
  if (!block.isNamed())
    return;
  auto &first = target[indexOf(plane->first)];
  auto &second = target[indexOf(plane->second)];
  if (block.isOpen()) {
    if constexpr (requires { interpretation.losePosition(); })
      interpretation.losePosition();
    for (const Axis axis : {plane->first, plane->second}) // a run takes it to stay
      target[indexOf(axis)] = interpretation.either(context.state.at(axis), interpretation.anyNumber());
    return interpretation.unmodelled("polar coordinates of which the radius or the angle is not known",
                                     context.place());
  }
  const auto radius = block.radius();
  const auto angle = block.angle();
  const auto written = block.isWritten();
  const auto cosine = interpretation.function(FunctionKind::Cos, angle);
  const auto sine = interpretation.function(FunctionKind::Sin, angle);
  first = interpretation.select(written, interpretation.multiply(radius, cosine), first);
  second = interpretation.select(written, interpretation.multiply(radius, sine), second);
}

template <ValueAlgebra R> void keepPolar(StepContext<R> &context, const ExecutedWords<R> &words, const Plane &plane) {
  R &interpretation = context.interpretation;
  detail::PolarBlock<R> block(context, words, plane);
  if (block.isOpen())
    return forgetKeptWords(context);
  const auto written = block.isWritten();
  const auto radius = block.radius();
  const auto angle = block.angle();
  const auto isAbove = interpretation.compare(Relation::Greater, radius, context.zero());
  const auto above = context.proved(isAbove) ? radius : interpretation.select(isAbove, radius, interpretation.vacant());
  auto &[first, second] = context.state.kept;
  first = interpretation.select(written, above, first);
  second = interpretation.select(written, angle, second);
}

} // namespace feedhold
