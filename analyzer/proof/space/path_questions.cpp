#include "proof/space/path_questions.h"

#include <algorithm>
#include <iterator>

namespace feedhold::prove {

using geometry::FreeSpace;
using geometry::TermPoint;
using smt::TermId;

std::vector<SpaceQuestion> PathQuestions::of(const FreeSpace &space) {
  if (!space.isConvex())
    return {questionOfAll(space)};
  std::vector<SpaceQuestion> questions;
  for (const geometry::Formula &bound : space.bounds)
    questions.push_back(questionOfBound(space, bound));
  return questions;
}

SpaceQuestion PathQuestions::questionOfBound(const FreeSpace &space, const geometry::Formula &bound) {
  SpaceQuestion question{{onHull(atCorners(bound))}};
  if (&bound == &space.bounds.front())
    std::ranges::move(ofArc(space), std::back_inserter(question.alternatives));
  if (!path_.isHull() && !isOfLevel(bound))
    question.alternatives.push_back(atAnyPoint(bound));
  return question;
}

SpaceQuestion PathQuestions::questionOfAll(const FreeSpace &space) {
  SpaceQuestion question;
  const std::vector<TermId> simple = simpleGoals(space);
  for (const TermId goal : simple)
    question.alternatives.push_back(onHull(goal));
  if (space.isOpenUpwards && path_.isVertical()) { // all of it lies above its lower end
    question.alternatives.push_back({{}, atCorners(space.all)});
    return question;
  }
  std::ranges::move(ofArc(space), std::back_inserter(question.alternatives));
  if (simple.size() > 1) // one or the other, as the case may be
    question.alternatives.push_back(onHull(store_.logicalOr(simple)));
  if (space.isOpenUpwards && !path_.isHull())
    std::ranges::move(onLevels(space), std::back_inserter(question.alternatives));
  question.alternatives.push_back(atAnyPoint(space.all));
  return question;
}

/// All corners lie in one convex part, or beyond one of the ends.
std::vector<TermId> PathQuestions::simpleGoals(const FreeSpace &space) const {
  std::vector<TermId> goals;
  for (const geometry::Formula &part : space.convexParts)
    goals.push_back(atCorners(part));
  for (const FreeSpace::Beyond &beyond : space.beyond)
    for (const TermPoint &anchor : {hull_.corners.front(), hull_.corners.back()})
      goals.push_back(atCorners([&](const TermPoint &corner) { return beyond(anchor, corner); }));
  return goals;
}

/// Where the path is an arc about an upright axis: its whole circle, or a quarter, is known to lie in the space.
std::vector<SpaceQuestion::Alternative> PathQuestions::ofArc(const FreeSpace &space) const {
  std::vector<Alternative> alternatives;
  const geometry::TermMove &move = path_.move();
  if (space.around && path_.isUprightArc())
    alternatives.push_back({{}, (*space.around)(path_.atCentre(move.start), {move.start, move.end})});
  if (space.behindQuarter)
    for (const geometry::QuarterArc &arc : path_.quarters())
      if (const auto keepsOut = space.behindQuarter(arc))
        alternatives.push_back({{}, store_.logicalAnd(arc.isOne, *keepsOut)});
  return alternatives;
}

/// No lower than an end: it is enough that this level is free there.
std::vector<SpaceQuestion::Alternative> PathQuestions::onLevels(const FreeSpace &space) {
  std::vector<Alternative> alternatives;
  for (const TermId level : std::set{path_.move().start[2], path_.move().end[2]}) {
    const geometry::PointOnPath any = path_.anyPoint();
    const TermId isAbove = store_.lessOrEqual(level, any.point[2]);
    alternatives.push_back(
        {any.conditions, store_.logicalAnd(isAbove, space.all({any.point[0], any.point[1], level}))});
  }
  return alternatives;
}

SpaceQuestion::Alternative PathQuestions::atAnyPoint(const geometry::Formula &formula) {
  const geometry::PointOnPath any = path_.anyPoint();
  return {any.conditions, formula(any.point)};
}

/// It speaks of the axis of the helix alone.
bool PathQuestions::isOfLevel(const geometry::Formula &bound) const {
  return std::ranges::all_of(hull_.corners,
                             [&](const TermPoint &corner) { return bound(corner) == bound(path_.atCentre(corner)); });
}

} // namespace feedhold::prove
