// Points of the plane in force since power-on (XY of a mill, ZX of a lathe) that are numbers in all runs, and how arcs
// go between them.
#pragma once

#include "rules/motion/motion_view.h"

#include <array>
#include <cmath>
#include <optional>

namespace feedhold::rules {

using PlaneVector = std::array<double, 2>;

inline PlaneVector between(const PlaneVector &from, const PlaneVector &to) {
  return {to[0] - from[0], to[1] - from[1]};
}
inline double lengthOf(const PlaneVector &vector) { return std::hypot(vector[0], vector[1]); }

/// Programmed coordinates are those of that plane: no other was chosen, nothing turns or scales them, and no macro is
/// called at each move.
inline bool isInUsualPlane(const MotionView &view, const AbstractState &state) {
  return !isHavocked(state) && !mayBeTrue(state.transformed) && state.modalCalls.empty() &&
         !mayBeTrue(state.modalCallsUnknown) && !view.choseOtherPlane(state);
}

/// X of a lathe as a radius.
inline std::optional<PlaneVector> pointOf(const MotionView &view, const AbstractState &state) {
  const auto lengthAlong = [&](Axis axis) -> std::optional<double> {
    const AbstractValue &coordinate = state.at(axis);
    const auto number = coordinate.isNumber() ? coordinate.number().constantValue() : std::nullopt;
    return number ? std::optional(view.lengthOf(axis) * *number) : std::nullopt;
  };
  const auto first = lengthAlong(view.usualPlane().first);
  const auto second = lengthAlong(view.usualPlane().second);
  return first && second ? std::optional(PlaneVector{*first, *second}) : std::nullopt;
}

/// The distance that a word of the node gives; none is 0.
inline std::optional<double> distanceIn(const MotionView &view, NodeId node, char letter) {
  const bool isPlainNumber = view.context().dialect.switches.dpi == Switch::On;
  for (const Word *word : view.wordsOf(node)) {
    if (word->address() != letter)
      continue;
    const bool isLength = word->isNumber() && (word->has(Word::kPoint) || isPlainNumber || word->number().isZero());
    return isLength ? std::optional(word->number().toDouble()) : std::nullopt;
  }
  return 0;
}

/// I, J and K count from the start point.
inline bool countsFromStart(const MotionView &view, const AbstractState &state) {
  return !view.context().dialect.behaviour.arcDistanceModes ||
         !view.wasSet(state, ModalKind::ArcDistance, {CodeAction::ArcAbsolute});
}

} // namespace feedhold::rules
