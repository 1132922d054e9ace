// Kept words: what a block may leave out of the two axes of the plane, where it does not follow from the position
// alone.
//
// Under a mapping (G68, G51, G51.1) an axis without a word keeps the coordinate that was programmed; the position,
// turned back, is the same number but for rounding.  Under G16 the axes are a radius and an angle (polar.h).  Both are
// kept from the last movement that the words of a block have led to its end in the plane.  They are forgotten wherever
// the tool comes otherwise (G53, G28, G31, a cycle that is not followed), and where the zero point, the plane, the
// units, a mapping or G15 and G16 change.
#pragma once

#include "meaning/semantics/executed_words.h"

namespace feedhold {

/// Something may be kept.
template <ValueAlgebra R> bool keepsWords(StepContext<R> &context) {
  const auto &[first, second] = context.state.kept;
  R &interpretation = context.interpretation;
  return !context.certain(interpretation.isVacant(first)) || !context.certain(interpretation.isVacant(second));
}

/// The words of the block lead somewhere in the plane.
template <typename R> bool namesPlane(const ExecutedWords<R> &words, const Plane &plane) {
  return words.find(letterOf(plane.first)) || words.find(letterOf(plane.second));
}

/// The codes of the block may give the words another meaning.  `before`: the plane.
template <ValueAlgebra R>
void forgetKeptAtCodes(StepContext<R> &context, const ExecutedWords<R> &words, const std::optional<Plane> &before) {
  if (!keepsWords(context))
    return;
  const std::optional<Plane> now = planeOf(context);
  const bool isSamePlane = now && before && now->normal == before->normal;
  constexpr std::array kForgetting = {CodeAction::PolarOn,    CodeAction::PolarOff,    CodeAction::ScalingOn,
                                      CodeAction::ScalingOff, CodeAction::MirrorOn,    CodeAction::MirrorOff,
                                      CodeAction::RotationOn, CodeAction::RotationOff, CodeAction::Inch,
                                      CodeAction::Metric}; // 0 is 0 in both units, what is kept is not
  if (!isSamePlane || !words.computed.empty() ||
      std::ranges::any_of(kForgetting, [&](CodeAction action) { return words.has(action); }))
    forgetKeptWords(context);
}

/// The tool was at `before`, and no words have led it on in the plane.
template <ValueAlgebra R>
void forgetKeptIfMoved(StepContext<R> &context, const std::array<typename R::Value, kAxisCount> &before) {
  const std::optional<Plane> plane = planeOf(context);
  const auto stays = [&](Axis axis) {
    return context.certain(
        context.interpretation.compare(Relation::Equal, before[indexOf(axis)], context.state.at(axis)));
  };
  if (!plane || !stays(plane->first) || !stays(plane->second))
    forgetKeptWords(context);
}

namespace detail {

template <ValueAlgebra R> typename R::Truth isAbsolute(StepContext<R> &context) {
  return context.inForce(ModalKind::Distance, {CodeAction::Absolute}, context.interpretation.truth(true));
}

template <ValueAlgebra R> typename R::Truth isPolar(StepContext<R> &context) {
  return context.inForce(ModalKind::Polar, {CodeAction::PolarOn}, context.interpretation.truth(false));
}

} // namespace detail

/// The words of the block may move the axis: it has one, or belongs to a plane of which the words say more than where
/// their own axes go.
template <ValueAlgebra R> bool mayMove(StepContext<R> &context, const ExecutedWords<R> &words, Axis axis) {
  R &interpretation = context.interpretation;
  if (words.find(letterOf(axis)) || interpretation.mayBe(context.state.transformed))
    return true;
  if (!interpretation.mayBe(detail::isPolar(context)))
    return false;
  const std::optional<Plane> plane = planeOf(context);
  return !plane || ((axis == plane->first || axis == plane->second) && namesPlane(words, *plane));
}

} // namespace feedhold
