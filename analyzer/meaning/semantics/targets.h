// Targets: where the axis words of a block point to, under G90 and G91, polar coordinates and the mappings in force.
#pragma once

#include "meaning/semantics/polar.h"

#include <algorithm>

namespace feedhold {

/// Incremental words of lathes without G90 and G91.
inline constexpr std::array<std::pair<char, Axis>, 4> kTurningIncrements = {
    {{'U', Axis::X}, {'V', Axis::Y}, {'W', Axis::Z}, {'H', Axis::C}}};

/// U, V, W and H are distances along X, Y, Z and C: on a lathe that has no G90 and G91 for them.
template <ValueAlgebra R> bool incrementsByLetter(const StepContext<R> &context) {
  return context.dialect().machine == MachineKind::Turning && !context.modes.groupOf(ModalKind::Distance);
}

/// The block has one of them.
template <ValueAlgebra R> bool namesIncrements(const StepContext<R> &context, const ExecutedWords<R> &words) {
  return incrementsByLetter(context) &&
         std::ranges::any_of(kTurningIncrements, [&](const auto &each) { return words.find(each.first) != nullptr; });
}

/// The end point that the axis words name; axes without a word stay where they are.
template <typename R> struct Ends {
  std::array<typename R::Value, kAxisCount> work;
  KeptWords<typename R::Value> programmed; // in the plane, before the mappings; vacant: without one
};
template <ValueAlgebra R> Ends<R> endsOf(StepContext<R> &context, const ExecutedWords<R> &words);
/// The same, in work coordinates.
template <ValueAlgebra R>
std::array<typename R::Value, kAxisCount> targetOf(StepContext<R> &context, const ExecutedWords<R> &words) {
  return endsOf(context, words).work;
}
/// The movement that the words of the block say has come to its end.
template <ValueAlgebra R> void goTo(StepContext<R> &context, const ExecutedWords<R> &words, const Ends<R> &ends);

/// Where the words lead is not followed: polar coordinates that say too little (polar.h); distances
/// from a place where the control does not take the tool to be; an absolute and an incremental word of one axis.
template <ValueAlgebra R> bool isOpenTarget(StepContext<R> &context, const ExecutedWords<R> &words);

/// From where the tool is to that end, as the words of a block under G91 say it: without the rounding of a sum. Absent:
/// they are not, or not surely, distances.
template <ValueAlgebra R>
std::optional<std::array<typename R::Value, kAxisCount>> distanceOf(StepContext<R> &context,
                                                                    const ExecutedWords<R> &words);

/// Behind a movement: an axis that an absolute word has named is where the control takes it to be.
template <ValueAlgebra R> void settlePending(StepContext<R> &context, const ExecutedWords<R> &words);

/// Reports a movement to the interpretation, from `start` to the present position; `isInterpolated`: of a rapid one.
template <ValueAlgebra R>
void tell(StepContext<R> &context, MoveKind kind, const std::array<typename R::Value, kAxisCount> &start,
          bool isInterpolated = false);
/// In a mode that is not followed no movement is told as one whose way is known.
template <ValueAlgebra R> void tell(StepContext<R> &context, Move<typename R::Value> move);

/// The word of a letter as a distance: 0 without it.
template <ValueAlgebra R>
typename R::Value distanceWord(StepContext<R> &context, const ExecutedWords<R> &words, char letter);

/// What a word adds to, or puts in place of, a coordinate.
template <ValueAlgebra R>
typename R::Value targetOn(StepContext<R> &context, const typename ExecutedWords<R>::Entry &entry,
                           const typename R::Value &from);

// ---- implementation -----------------------------------------------------------------------------------------------

template <ValueAlgebra R>
typename R::Value distanceWord(StepContext<R> &context, const ExecutedWords<R> &words, char letter) {
  const auto *entry = words.find(letter);
  if (!entry || context.certain(entry->present))
    return entry ? entry->value : context.zero();
  return context.interpretation.select(entry->present, entry->value, context.zero());
}

template <ValueAlgebra R>
typename R::Value targetOn(StepContext<R> &context, const typename ExecutedWords<R>::Entry &entry,
                           const typename R::Value &from) {
  R &interpretation = context.interpretation;
  const auto absolute = detail::isAbsolute(context);
  if (context.certain(absolute) && context.certain(entry.present))
    return entry.value;
  const auto moved = interpretation.select(absolute, entry.value, interpretation.add(from, entry.value));
  return interpretation.select(entry.present, moved, from);
}

namespace detail {

template <ValueAlgebra R>
typename R::Truth isWritten(StepContext<R> &context, const ExecutedWords<R> &words, Axis axis) {
  const auto *entry = words.find(letterOf(axis));
  return entry ? entry->present : context.interpretation.truth(false);
}

/// The words may be distances from somewhere else than where the tool is.
template <ValueAlgebra R> typename R::Truth isOpenIncrement(StepContext<R> &context, Axis axis) {
  R &interpretation = context.interpretation;
  if (!isPending(context, axis))
    return interpretation.truth(false);
  const auto pending = interpretation.negation(interpretation.isVacant(context.state.transform.pending[indexOf(axis)]));
  const auto unmapped = context.behaviour().absoluteBehindMappings ? interpretation.truth(true)
                                                                   : interpretation.negation(context.state.transformed);
  return interpretation.both(interpretation.both(pending, unmapped), interpretation.negation(isAbsolute(context)));
}
/// X and U in one block: on some controls the later one counts, others stop.
template <ValueAlgebra R>
typename R::Truth isNamedTwice(StepContext<R> &context, const ExecutedWords<R> &words,
                               const typename ExecutedWords<R>::Entry &increment, Axis axis) {
  return context.interpretation.both(increment.present, isWritten(context, words, axis));
}
template <ValueAlgebra R>
typename R::Value openedTwice(StepContext<R> &context, const ExecutedWords<R> &words,
                              const typename ExecutedWords<R>::Entry &increment, Axis axis,
                              const typename R::Value &coordinate) {
  R &interpretation = context.interpretation;
  const auto twice = isNamedTwice(context, words, increment, axis);
  if (!interpretation.mayBe(twice))
    return coordinate;
  interpretation.unmodelled("an axis with both of its words", context.place());
  return interpretation.select(twice, interpretation.anyNumber(), coordinate);
}
template <ValueAlgebra R> bool mayNameTwice(StepContext<R> &context, const ExecutedWords<R> &words) {
  return incrementsByLetter(context) && std::ranges::any_of(kTurningIncrements, [&](const auto &each) {
           const auto *entry = words.find(each.first);
           return entry && context.interpretation.mayBe(isNamedTwice(context, words, *entry, each.second));
         });
}
template <ValueAlgebra R>
typename R::Value openedUp(StepContext<R> &context, Axis axis, const typename R::Value &coordinate) {
  R &interpretation = context.interpretation;
  const auto open = isOpenIncrement(context, axis);
  if (!interpretation.mayBe(open))
    return coordinate;
  interpretation.unmodelled("an incremental move after mirroring, scaling or rotation, before any absolute move",
                            context.place());
  return interpretation.select(open, interpretation.either(coordinate, interpretation.anyNumber()), coordinate);
}

/// Whether an axis of the plane without a word, of which the other has one, is taken to the coordinate that it had
/// under the mapping before.  11600#5 says so of rotation; no manual says what holds of mirror and scaling.
template <ValueAlgebra R>
typename R::Truth takesPending(StepContext<R> &context, const ExecutedWords<R> &words, Axis axis, Axis other) {
  R &interpretation = context.interpretation;
  if (!isPending(context, axis))
    return interpretation.truth(false);
  const auto turned =
      interpretation.negation(interpretation.compare(Relation::Equal, context.state.transform.angle, context.zero()));
  const auto keeps = context.certain(turned) ? context.isOn(&Switches::ax1) : context.maybe(true);
  const auto alone =
      interpretation.both(isWritten(context, words, other), interpretation.negation(isWritten(context, words, axis)));
  const auto pending = interpretation.negation(interpretation.isVacant(context.state.transform.pending[indexOf(axis)]));
  return interpretation.both(interpretation.both(alone, isAbsolute(context)),
                             interpretation.both(pending, interpretation.negation(keeps)));
}
template <ValueAlgebra R>
void takePending(StepContext<R> &context, const ExecutedWords<R> &words,
                 std::array<typename R::Value, kAxisCount> &target, std::array<bool, kAxisCount> &taken) {
  R &interpretation = context.interpretation;
  const std::optional<Plane> plane = planeOf(context);
  if (!plane)
    return;
  for (const auto &[axis, other] : {std::pair{plane->first, plane->second}, std::pair{plane->second, plane->first}}) {
    const auto takes = takesPending(context, words, axis, other);
    if (!interpretation.mayBe(takes))
      continue;
    taken[indexOf(axis)] = true;
    auto &coordinate = target[indexOf(axis)];
    coordinate = interpretation.select(takes, interpretation.asNumber(context.state.transform.pending[indexOf(axis)]),
                                       coordinate);
  }
}

/// An axis keeps its coordinate exactly where no word of the block is mapped to it.
template <ValueAlgebra R>
void keepUnnamed(StepContext<R> &context, const ExecutedWords<R> &words,
                 std::array<typename R::Value, kAxisCount> &target, const std::array<bool, kAxisCount> &taken) {
  const std::optional<Plane> plane = planeOf(context);
  const bool turned =
      !context.certain(context.interpretation.compare(Relation::Equal, context.state.transform.angle, context.zero()));
  if (turned && !plane)
    return;
  const auto named = [&](Axis axis) { return words.find(letterOf(axis)) != nullptr; };
  for (const Axis axis : kAllAxes) {
    const bool inPlane = turned && (axis == plane->first || axis == plane->second);
    const bool mapped = inPlane ? named(plane->first) || named(plane->second) : named(axis);
    if (!mapped && !taken[indexOf(axis)])
      target[indexOf(axis)] = context.state.at(axis);
  }
}

/// The axis words as distances, of which the mappings turn and stretch what they say.
template <ValueAlgebra R>
std::array<typename R::Value, kAxisCount> mappedDistance(StepContext<R> &context, const ExecutedWords<R> &words) {
  std::array<typename R::Value, kAxisCount> distance;
  for (const Axis axis : kAllAxes)
    distance[indexOf(axis)] = distanceWord(context, words, letterOf(axis));
  return toWorkDistance(context, std::move(distance));
}

/// Under G91 the distances alone are mapped.
template <ValueAlgebra R>
std::array<typename R::Value, kAxisCount> mappedIncrement(StepContext<R> &context, const ExecutedWords<R> &words) {
  auto target = mappedDistance(context, words);
  for (const Axis axis : kAllAxes) {
    target[indexOf(axis)] = context.interpretation.add(context.state.at(axis), target[indexOf(axis)]);
    if (words.find(letterOf(axis)))
      target[indexOf(axis)] = openedUp(context, axis, target[indexOf(axis)]);
  }
  return target;
}

/// All axis words are distances, and not of polar coordinates.
template <ValueAlgebra R> bool areDistances(StepContext<R> &context) {
  return context.modes.groupOf(ModalKind::Distance) && !context.interpretation.mayBe(isAbsolute(context)) &&
         !context.interpretation.mayBe(isPolar(context));
}

/// What is kept of the axes of the plane, in place of what the position says.
template <ValueAlgebra R>
void takeKept(StepContext<R> &context, const Plane &plane, std::array<typename R::Value, kAxisCount> &programmed) {
  R &interpretation = context.interpretation;
  const auto &[first, second] = context.state.kept;
  for (const auto &[axis, kept] : {std::pair{plane.first, &first}, std::pair{plane.second, &second}}) {
    auto &coordinate = programmed[indexOf(axis)];
    coordinate = interpretation.select(interpretation.isVacant(*kept), coordinate, interpretation.asNumber(*kept));
  }
}

/// Of a position under a mapping: before it.
template <ValueAlgebra R> std::array<typename R::Value, kAxisCount> programmedPosition(StepContext<R> &context) {
  auto programmed = toProgrammed(context, context.state.position);
  const std::optional<Plane> plane = planeOf(context);
  if (plane && keepsWords(context) && !context.interpretation.mayBe(isPolar(context)))
    takeKept(context, *plane, programmed);
  return programmed;
}

/// Under G91 and a mapping: the distances are added to what is kept.
template <ValueAlgebra R> Ends<R> incrementedEnds(StepContext<R> &context, const ExecutedWords<R> &words) {
  R &interpretation = context.interpretation;
  const auto &kept = context.state.kept;
  Ends<R> ends{mappedIncrement(context, words), {interpretation.vacant(), interpretation.vacant()}};
  const std::optional<Plane> plane = planeOf(context);
  if (!plane || !keepsWords(context) || isOpenTarget(context, words))
    return ends;
  const auto added = [&](Axis axis, const typename R::Value &from) {
    const auto sum = interpretation.add(interpretation.asNumber(from), distanceWord(context, words, letterOf(axis)));
    return interpretation.select(interpretation.isVacant(from), interpretation.vacant(), sum);
  };
  ends.programmed = {added(plane->first, kept.first), added(plane->second, kept.second)};
  return ends;
}

} // namespace detail

template <ValueAlgebra R> Ends<R> endsOf(StepContext<R> &context, const ExecutedWords<R> &words) {
  R &interpretation = context.interpretation;
  const bool isMapped = interpretation.mayBe(context.state.transformed);
  if (isMapped && detail::areDistances(context))
    return detail::incrementedEnds(context, words);
  Ends<R> ends{context.state.position, {interpretation.vacant(), interpretation.vacant()}};
  auto &target = ends.work;
  if (isMapped)
    target = detail::programmedPosition(context);
  const bool byLetter = incrementsByLetter(context);
  for (const Axis axis : kAllAxes)
    if (const auto *entry = words.find(letterOf(axis)))
      if (!byLetter || (axis != Axis::U && axis != Axis::V && axis != Axis::W))
        target[indexOf(axis)] = detail::openedUp(context, axis, targetOn(context, *entry, target[indexOf(axis)]));
  std::array<bool, kAxisCount> taken{};
  detail::takePending(context, words, target, taken);
  if (byLetter)
    for (const auto &[letter, axis] : kTurningIncrements)
      if (const auto *entry = words.find(letter)) {
        auto &coordinate = target[indexOf(axis)];
        coordinate = interpretation.select(entry->present, interpretation.add(coordinate, entry->value), coordinate);
        coordinate = detail::openedTwice(context, words, *entry, axis, coordinate);
      }
  fromPolar(context, words, target);
  if (!isMapped)
    return ends;
  if (const std::optional<Plane> plane = planeOf(context))
    ends.programmed = {target[indexOf(plane->first)], target[indexOf(plane->second)]};
  target = toWork(context, std::move(target));
  if (!byLetter)
    detail::keepUnnamed(context, words, target, taken);
  return ends;
}

template <ValueAlgebra R> void goTo(StepContext<R> &context, const ExecutedWords<R> &words, const Ends<R> &ends) {
  R &interpretation = context.interpretation;
  context.state.position = ends.work;
  const std::optional<Plane> plane = planeOf(context);
  if (!plane)
    return forgetKeptWords(context);
  if (!namesPlane(words, *plane))
    return;
  if (interpretation.mayBe(detail::isPolar(context)))
    return keepPolar(context, words, *plane);
  forgetKeptWords(context);
  const auto mapped = context.state.transformed;
  if (!interpretation.mayBe(mapped) || isOpenTarget(context, words))
    return;
  const auto &[first, second] = ends.programmed;
  context.state.kept = {interpretation.select(mapped, first, interpretation.vacant()),
                        interpretation.select(mapped, second, interpretation.vacant())};
}

template <ValueAlgebra R> bool isOpenTarget(StepContext<R> &context, const ExecutedWords<R> &words) {
  return isOpenPolar(context, words) || detail::mayNameTwice(context, words) ||
         std::any_of(kAllAxes.begin(), kAllAxes.end(), [&](Axis axis) {
           const auto open = detail::isOpenIncrement(context, axis);
           return context.interpretation.mayBe(open) && context.interpretation.mayBe(context.interpretation.both(
                                                            open, detail::isWritten(context, words, axis)));
         });
}

template <ValueAlgebra R>
std::optional<std::array<typename R::Value, kAxisCount>> distanceOf(StepContext<R> &context,
                                                                    const ExecutedWords<R> &words) {
  if (!detail::areDistances(context) || isOpenTarget(context, words))
    return std::nullopt;
  return detail::mappedDistance(context, words);
}

template <ValueAlgebra R> void settlePending(StepContext<R> &context, const ExecutedWords<R> &words) {
  R &interpretation = context.interpretation;
  const std::optional<Plane> plane = planeOf(context);
  const auto absolute = detail::isAbsolute(context);
  const auto named = [&](Axis axis) { return detail::isWritten(context, words, axis); };
  const bool anyInPlane = plane && (words.find(letterOf(plane->first)) || words.find(letterOf(plane->second)));
  for (const Axis axis : kAllAxes) {
    if (!detail::isPending(context, axis))
      continue;
    const bool isInPlane = plane && (axis == plane->first || axis == plane->second);
    const auto moved =
        isInPlane && anyInPlane ? context.either(named(plane->first), named(plane->second)) : named(axis);
    if (!interpretation.mayBe(moved))
      continue;
    if (interpretation.mayBe(interpretation.negation(absolute)))
      detail::havocPending(context, axis);
    auto &pending = context.state.transform.pending[indexOf(axis)];
    pending = interpretation.select(interpretation.both(moved, absolute), interpretation.vacant(), pending);
  }
}

template <ValueAlgebra R>
void tell(StepContext<R> &context, MoveKind kind, const std::array<typename R::Value, kAxisCount> &start,
          bool isInterpolated) {
  if (!context.interpretation.wantsMoves())
    return;
  Move<typename R::Value> move;
  move.kind = kind;
  move.isInterpolated = isInterpolated;
  if constexpr (!requires { requires R::kAsksForKindsAlone; }) { // most of the work for a line of a tool path
    move.start = start;
    move.end = context.state.position;
    move.feed = context.state.word('F');
  }
  tell(context, std::move(move));
}

template <ValueAlgebra R> void tell(StepContext<R> &context, Move<typename R::Value> move) {
  if (move.kind != MoveKind::Dwell && context.interpretation.mayBe(otherGeometry(context)))
    move.kind = MoveKind::Unmodelled;
  context.interpretation.move(move);
}

} // namespace feedhold
