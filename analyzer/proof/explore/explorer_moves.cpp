// Movements of a path: what they are, and how deep the tool has been where it stands.
#include "proof/explore/explorer.h"
#include "proof/symbolic/path_memory.h"

#include <algorithm>

namespace feedhold::prove {

using smt::TermId;

/// The stops of the step have been taken: a control does not begin a block that it refuses.
void Explorer::takeMoves(Path &path) {
  const bool withColumn = options_.moves == KeepMoves::WithColumn;
  const bool isMissing = withColumn && !path.state.variables.find(kFreeColumn); // havocked with all else
  const SymbolicValue *beside = path.state.variables.find(kBesidePath);
  if (path.cutter && !beside)
    loseCutter(path, "cutter compensation through a block that may do anything");
  if (interpretation_.moves().empty() && !isMissing) {
    takeCutter(path, {}, beside ? beside->number : store_.number(smt::Number(1)));
    waitBesidePath(path);
    return;
  }
  auto context = contextOf(path);
  ToolPoint<SymbolicInterpretation> point = toolPointOf(context, entry_, options_.fixed);
  const auto level = [&](const SymbolicValue &z) {
    return interpretation_.add(z, point.zero[indexOf(Axis::Z)]).number;
  };
  const std::vector<Move<SymbolicValue>> moves = interpretation_.moves();
  const TermId besidePath = beside ? beside->number : store_.number(smt::Number(1));
  leavePath(path, moves, point);
  const SymbolicValue &z = moves.empty() ? path.state.at(Axis::Z) : moves.front().start[indexOf(Axis::Z)];
  TermId column = withColumn && !isMissing ? path.state.variables.find(kFreeColumn)->number : level(z);
  std::vector<MoveInstance> instances;
  const bool isKept = purpose_ == Purpose::Record || options_.cutterOffset;
  for (const Move<SymbolicValue> &move : moves) {
    if (isKept)
      instances.push_back(
          {path.at, ownPlace(path), path.conditions, move, radiusOf(path, move), point, path.state.word('S'), column});
    if (withColumn)
      column = columnBehind(path, move, column, level(move.end[indexOf(Axis::Z)]));
  }
  if (withColumn)
    path.state.variables.set(kFreeColumn, {store_.no(), column});
  if (!takeCutter(path, instances, besidePath) && purpose_ == Purpose::Record)
    std::move(instances.begin(), instances.end(), std::back_inserter(result_.moves));
}

/// A line that waits for the next one (corners.h) is told with that, in which the compensation may have ended.
void Explorer::waitBesidePath(Path &path) {
  auto context = contextOf(path);
  if (!interpretation_.mayBe(waitsForLine(context)))
    return;
  const SymbolicValue *known = path.state.variables.find(kBesidePath);
  const TermId one = store_.number(smt::Number(1));
  const TermId without = toolPointOf(context, entry_).compensationOff.term;
  path.state.variables.set(kBesidePath, {store_.no(), store_.ite(without, known ? known->number : one, one)});
}

/// Whether cutter compensation puts the tool beside the path, or has done so before: a movement without it comes back
/// to the path at its end, if it is one in the plane (FANUC operator's manual: the offset is cancelled by the first
/// movement in the plane; one of length 0 is none).  The line before a corner belongs to a block before that.
void Explorer::leavePath(Path &path, const std::vector<Move<SymbolicValue>> &moves,
                         ToolPoint<SymbolicInterpretation> &point) {
  const TermId one = store_.number(smt::Number(1));
  const TermId zero = store_.number(smt::Number(0));
  const SymbolicValue *known = path.state.variables.find(kBesidePath);
  const TermId before = known ? known->number : one; // havocked with all else
  const TermId without = point.compensationOff.term;
  point.withoutCompensation.term = store_.logicalAnd(point.withoutCompensation.term, store_.equal(before, zero));
  auto context = contextOf(path);
  const std::optional<Plane> plane = planeOf(context);
  TermId comesBack = store_.no();
  for (const Move<SymbolicValue> &move : moves)
    for (const Axis axis : plane ? std::vector{plane->first, plane->second} : std::vector<Axis>{})
      if (move.kind != MoveKind::Unmodelled && !move.offsetsStart && !move.offsetsEnd && !move.leadsToLine)
        comesBack = store_.logicalOr(comesBack, store_.logicalNot(store_.equal(move.start[indexOf(axis)].number,
                                                                               move.end[indexOf(axis)].number)));
  if (!moves.empty())
    path.state.variables.set(kBesidePath, {store_.no(), store_.ite(without, store_.ite(comesBack, zero, before), one)});
}

/// Where it is known whether the arc is the shorter or the longer one.
std::optional<geometry::ArcRadius> Explorer::radiusOf(const Path &path, const Move<SymbolicValue> &move) {
  const bool isArc = move.kind == MoveKind::ArcClockwise || move.kind == MoveKind::ArcCounterclockwise;
  const auto *entry = isArc && path.state.transformed.term == store_.no() ? words_.find('R') : nullptr;
  if (!entry || !path.says(store_, entry->present.term))
    return std::nullopt;
  // A length like the coordinates; a run does not round it, and is off by less than what it is judged by (a millionth).
  const auto multiple = interpretation_.increments().of(entry->value.number);
  const bool isNear = multiple && multiple->error <= smt::Number(1) / smt::Number(1'000'000);
  const TermId radius = isNear ? interpretation_.asCounted(entry->value.number)
                               : interpretation_.increments().typedInput(entry->value.number);
  const TermId zero = store_.number(smt::Number(0));
  if (entails_(interpretation_.facts(), path.conditions, store_.less(zero, radius)))
    return geometry::ArcRadius{radius, geometry::ArcLength::Short};
  if (entails_(interpretation_.facts(), path.conditions, store_.less(radius, zero)))
    return geometry::ArcRadius{store_.negate(radius), geometry::ArcLength::Long};
  return std::nullopt;
}

/// The tool stands at `end`, and has cut down to where it was before if no axis but Z has moved.
TermId Explorer::columnBehind(const Path &path, const Move<SymbolicValue> &move, TermId column, TermId end) {
  const auto isSame = [](const SymbolicValue &a, const SymbolicValue &b) { return a.number == b.number; };
  const auto holds = [&](TermId condition) { return entails_(interpretation_.facts(), path.conditions, condition); };
  const bool isStraight = move.kind == MoveKind::Rapid || move.kind == MoveKind::Feed || move.kind == MoveKind::Probe;
  if (!isStraight ||
      std::ranges::any_of(kAllAxes, [&](Axis axis) { return axis != Axis::Z && mayMove(move, axis, isSame); }))
    return end;
  if (move.kind == MoveKind::Rapid) // what only a rapid move has gone through was no free space
    return column;
  if (column == end || holds(store_.lessOrEqual(column, end)))
    return column;
  return holds(store_.lessOrEqual(end, column)) ? end : store_.ite(store_.less(end, column), end, column);
}

} // namespace feedhold::prove
