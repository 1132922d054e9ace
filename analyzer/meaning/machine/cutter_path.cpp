#include "meaning/machine/cutter_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace feedhold {

namespace {

constexpr double kStanding = 1e-9; // a shorter way is none
constexpr double kSame = 1e-7;     // offsets that rounding alone keeps apart

bool isFollowed(MoveKind kind) { return kind == MoveKind::Rapid || kind == MoveKind::Feed || isArc(kind); }

/// From one spoke to another along the way of an arc, the short way round.
double angleAlong(const CutterElement &arc, PlaneVector from, PlaneVector to) {
  return arc.way * std::atan2(cross(from, to), dot(from, to));
}
/// What is left of an arc's sweep where its centre path goes from one offset to another.
double sweepBetween(const CutterElement &arc, PlaneVector from, PlaneVector to) {
  const PlaneVector start = arc.start - arc.centre;
  const PlaneVector end = arc.end - arc.centre;
  return arc.sweep - angleAlong(arc, start, start + from) + angleAlong(arc, end, end + to);
}

} // namespace

void CutterPath::take(const CutterBlock &block, Place place, std::size_t depth, std::size_t firstMove) {
  if (alarm_ || (phase_ == Phase::Off && !block.side))
    return;
  if (block.switches)
    began_ = place;
  const At at{place, depth, firstMove};
  change(block, at);
  const std::size_t end = moves_.size();
  const bool moves = std::any_of(moves_.begin() + static_cast<std::ptrdiff_t>(firstMove), moves_.end(),
                                 [&](const RecordedMove &each) { return isInPlane(each.move); });
  for (std::size_t i = firstMove; i < end && !alarm_; ++i)
    move(i, block, at);
  if (!moves && !alarm_)
    idle(block);
}

void CutterPath::finish() {
  if (pending_ && !alarm_)
    failReading();
}

// ---- modes ----

void CutterPath::enter(const CutterBlock &block, const At &at) {
  phase_ = Phase::Waiting;
  side_ = *block.side;
  plane_ = block.plane;
  at_ = {};
  if (!began_)
    lose("cutter compensation that was in force before the start", at.place);
  else if (!block.whyNoRadius.empty())
    lose(block.whyNoRadius, at.place);
}

void CutterPath::change(const CutterBlock &block, const At &at) {
  switch (phase_) {
  case Phase::Off: return enter(block, at);
  case Phase::Waiting:
    if (!block.side)
      phase_ = Phase::Off;
    else
      enter(block, at);
    return;
  case Phase::On: return changeInside(block, at);
  case Phase::Ending:
    if (block.side)
      lose("cutter compensation that begins again before a move has ended it", at.place);
    return;
  case Phase::Lost: return;
  }
}

void CutterPath::changeInside(const CutterBlock &block, const At &at) {
  if (!block.side) {
    phase_ = Phase::Ending;
    return;
  }
  if (block.plane.normal != plane_.normal)
    return stop(AlarmKind::CutterPlane, at);
  if (!block.foreign.empty())
    return lose(block.foreign, at.place);
  if (block.switches || !(*block.side == side_) || !block.whyNoRadius.empty())
    lose("cutter compensation whose side or offset changes, or is given again, before it ends", at.place);
}

// ---- moves ----

bool CutterPath::isInPlane(const Move<ConcreteValue> &move) const {
  if (isArc(move.kind))
    return true;
  const auto way = [&](Axis axis) {
    return std::abs(move.end[indexOf(axis)].number - move.start[indexOf(axis)].number);
  };
  return move.kind != MoveKind::Dwell && std::max(way(plane_.first), way(plane_.second)) > kStanding;
}

void CutterPath::move(std::size_t index, const CutterBlock &block, const At &at) {
  RecordedMove &recorded = moves_[index];
  if (recorded.move.kind == MoveKind::Dwell || phase_ == Phase::Off)
    return;
  const bool inPlane = isInPlane(recorded.move);
  if (phase_ != Phase::Lost && !isFollowed(recorded.move.kind))
    lose("cutter compensation through a move that is not modelled", at.place);
  if (phase_ == Phase::Lost) {
    recorded.isOfTool = false;
    if (inPlane && !block.side)
      phase_ = Phase::Off;
  } else if (inPlane) {
    moveInPlane(index, block, at);
  } else {
    moveBeside(index);
  }
}

void CutterPath::moveInPlane(std::size_t index, const CutterBlock &block, const At &at) {
  switch (phase_) {
  case Phase::Waiting: return startUp(index, block, at);
  case Phase::On: return goOn(index, at);
  case Phase::Ending: return cancel(index, at);
  case Phase::Off:
  case Phase::Lost: return;
  }
}

/// The tool goes up or down where it stands, which the next block in the plane decides.
void CutterPath::moveBeside(std::size_t index) {
  if (pending_)
    pending_->behind.push_back(index);
  else if (phase_ != Phase::Waiting)
    moves_[index].centre = {shifted(moves_[index].move, at_, at_)};
}

void CutterPath::startUp(std::size_t index, const CutterBlock &block, const At &at) {
  const Move<ConcreteValue> &move = moves_[index].move;
  const bool byItself = dialect_.behaviour.cutterEntry == CutterEntry::ByItself;
  const auto loseHere = [&](std::string_view reason) {
    lose(reason, at.place);
    moves_[index].isOfTool = false;
  };
  if (!block.foreign.empty())
    return loseHere(block.foreign);
  if (isArc(move.kind) && byItself)
    return loseHere("cutter compensation that begins in an arc");
  if (isArc(move.kind))
    return stop(AlarmKind::CutterArc, at);
  const CutterElement element = elementOf(move, plane_, side_.sign);
  if (byItself && lengthOf(element.end - element.start) <= side_.radius)
    return stop(AlarmKind::CutterEntryTooShort, at);
  phase_ = Phase::On;
  pending_ = Pending{index, Role::StartUp, element, {}, at.place, at.depth};
}

/// The block before it is not made either: its end is not known.
bool CutterPath::refusesArc(const CutterElement &element, const At &block) {
  const At at{block.place, block.depth, pending_ ? pending_->move : block.move};
  if (element.endRadius < kStanding || element.startRadius < kStanding) {
    stop(AlarmKind::CutterArcCentre, at);
    return true;
  }
  // LinuxCNC refuses an inside arc of the very radius of the tool, too.
  const double least = dialect_.behaviour.cutterEntry == CutterEntry::ByItself ? kStanding : -kSame;
  if (centreRadius(element, side_) >= least)
    return false;
  stop(AlarmKind::CutterInterference, at);
  return true;
}

void CutterPath::goOn(std::size_t index, const At &at) {
  const RecordedMove &recorded = moves_[index];
  const CutterElement element = elementOf(recorded.move, plane_, side_.sign);
  if (element.isArc && refusesArc(element, at))
    return;
  const auto loseHere = [&](std::string_view reason) {
    lose(reason, at.place);
    moves_[index].isOfTool = false;
  };
  if (pending_) {
    const RecordedMove &before = moves_[pending_->move];
    if (before.zero != recorded.zero || before.unit != recorded.unit)
      return loseHere("cutter compensation through a change of the zero point or of the units");
    const CutterJoin join = pending_->role == Role::StartUp
                                ? startOf(element)
                                : joinOf(pending_->element, element, side_, dialect_.behaviour.cutterCorners);
    if (join.turn == CornerTurn::Back && join.vectors.empty())
      return loseHere("cutter compensation along a block and back");
    if (join.vectors.empty())
      return stop(AlarmKind::CutterNoCrossing, {pending_->place, pending_->depth, pending_->move});
    if (join.isArc && moves_[pending_->move].move.kind == MoveKind::Rapid)
      return loseHere("cutter compensation about an outer corner in rapid traverse");
    finishPending(join);
  } else if (element.isArc && lengthOf(at_ - side_.radius * element.startNormal) > kSame) {
    return loseHere("cutter compensation of an arc behind a corner that the control has not foreseen");
  }
  if (!alarm_)
    pending_ = Pending{index, Role::Steady, element, at_, at.place, at.depth};
}

void CutterPath::cancel(std::size_t index, const At &at) {
  const Move<ConcreteValue> &move = moves_[index].move;
  if (isArc(move.kind))
    return stop(AlarmKind::CutterArc, at);
  if (pending_ && pending_->role == Role::StartUp) {
    lose("cutter compensation without a block between its start and its end", at.place);
    moves_[index].isOfTool = false;
    phase_ = Phase::Off;
    return;
  }
  if (pending_)
    finishPending(endOf(elementOf(move, plane_, side_.sign)));
  if (alarm_)
    return;
  moves_[index].centre = {shifted(moves_[index].move, at_, {})};
  at_ = {};
  phase_ = Phase::Off;
}

void CutterPath::idle(const CutterBlock &block) {
  if (!pending_ || phase_ != Phase::On)
    return;
  ++pending_->idle;
  const std::size_t most = dialect_.behaviour.cutterBlocks;
  if (most != 0 && (block.stopsReading || block.namesPlane || pending_->idle > most - 2))
    failReading();
}

// ---- from one block to the next ----

/// Square to the next block; by type B an outer corner has the normal of the start-up block first, and so has one of
/// LinuxCNC, where the start-up block is one of the contour.
CutterJoin CutterPath::startOf(const CutterElement &next) const {
  const CutterElement &own = pending_->element;
  if (dialect_.behaviour.cutterEntry == CutterEntry::ByItself)
    return joinOf(own, next, side_, dialect_.behaviour.cutterCorners);
  CutterJoin join{.turn = turnOf(own, next, side_.sign), .vectors = {side_.radius * next.startNormal}};
  if (dialect_.switches.sup == Switch::On && join.turn == CornerTurn::Outer) {
    join.vectors = joinOf(own, next, side_, CutterCorners::Lines).vectors;
    join.vectors.insert(join.vectors.begin(), side_.radius * own.endNormal);
  }
  return join;
}

CutterJoin CutterPath::endOf(const CutterElement &next) const {
  const CutterElement &own = pending_->element;
  CutterJoin join{.turn = turnOf(own, next, side_.sign), .vectors = {side_.radius * own.endNormal}};
  if (dialect_.switches.sup == Switch::On && dialect_.behaviour.cutterEntry == CutterEntry::ToNext &&
      join.turn == CornerTurn::Outer) {
    join.vectors = joinOf(own, next, side_, CutterCorners::Lines).vectors;
    join.vectors.push_back(side_.radius * next.startNormal);
  }
  return join;
}

/// The control does not know the next block in the plane: it ends square to its own.
void CutterPath::failReading() {
  finishPending({.turn = CornerTurn::None, .vectors = {side_.radius * pending_->element.endNormal}});
}

void CutterPath::finishPending(const CutterJoin &join) {
  const Pending pending = *std::exchange(pending_, std::nullopt);
  if (pending.role == Role::Steady && isReversed(pending, join.vectors.front()))
    return stop(AlarmKind::CutterInterference, {pending.place, pending.depth, pending.move});
  moves_[pending.move].centre = {centreMove(pending, join.vectors.front())};
  // Straight pieces belong to the block before the corner, an arc about it to the one behind.
  at_ = join.isArc ? join.vectors.front() : join.vectors.back();
  for (const std::size_t index : pending.behind)
    moves_[index].centre = {shifted(moves_[index].move, at_, at_)};
  const std::size_t last = join.isArc && !pending.behind.empty() ? pending.behind.back() : pending.move;
  addLinks(last, join);
  at_ = join.vectors.back();
}

bool CutterPath::isReversed(const Pending &pending, PlaneVector to) const {
  const CutterElement &element = pending.element;
  if (!element.isArc)
    return dot(element.end + to - element.start - pending.from, element.endDirection) < -kStanding;
  return centreRadius(element, side_) > kSame && sweepBetween(element, pending.from, to) < -kStanding;
}

Move<ConcreteValue> CutterPath::shifted(Move<ConcreteValue> move, PlaneVector start, PlaneVector end) const {
  move.start[indexOf(plane_.first)].number += start.first;
  move.start[indexOf(plane_.second)].number += start.second;
  move.end[indexOf(plane_.first)].number += end.first;
  move.end[indexOf(plane_.second)].number += end.second;
  return move;
}

Move<ConcreteValue> CutterPath::centreMove(const Pending &pending, PlaneVector to) const {
  Move<ConcreteValue> move = shifted(moves_[pending.move].move, pending.from, to);
  if (!pending.element.isArc)
    return move;
  const double radius = std::max(0.0, centreRadius(pending.element, side_));
  const double sweep = sweepBetween(pending.element, pending.from, to);
  // So short an arc would be read as a full circle.
  if (radius * sweep < 10 * kSame) {
    move.kind = MoveKind::Feed;
    move.turns = 1;
  } else {
    move.turns = static_cast<std::uint32_t>(std::max(1.0, std::ceil(sweep / (2 * std::numbers::pi) - kStanding)));
  }
  return move;
}

void CutterPath::addLinks(std::size_t index, const CutterJoin &join) {
  auto &centre = moves_[index].centre;
  const Move<ConcreteValue> &programmed = moves_[index].move;
  for (std::size_t i = 1; i < join.vectors.size(); ++i) {
    Move<ConcreteValue> link = programmed;
    link.start = link.end = programmed.end;
    link = shifted(link, join.vectors[i - 1], join.vectors[i]);
    link.kind = programmed.kind == MoveKind::Rapid ? MoveKind::Rapid : MoveKind::Feed;
    link.turns = 1;
    if (join.isArc) { // on the outside the contour turns away from the tool
      link.kind = side_.sign > 0 ? MoveKind::ArcClockwise : MoveKind::ArcCounterclockwise;
      link.plane = plane_;
      link.firstCentre = programmed.end[indexOf(plane_.first)];
      link.secondCentre = programmed.end[indexOf(plane_.second)];
    }
    if (lengthOf(join.vectors[i] - join.vectors[i - 1]) > kStanding)
      centre.push_back(link);
  }
}

// ---- what cannot go on ----

void CutterPath::stop(AlarmKind kind, const At &at) {
  if (pending_ && pending_->move >= at.move)
    pending_.reset();
  finish();
  if (!alarm_ && began_)
    alarm_ = CutterAlarm{kind, at.place, at.depth, at.move, *began_};
}

void CutterPath::lose(std::string_view reason, Place place) {
  notes_.push_back({reason, place});
  if (pending_) {
    moves_[pending_->move].isOfTool = false;
    for (const std::size_t index : pending_->behind)
      moves_[index].isOfTool = false;
  }
  pending_.reset();
  phase_ = Phase::Lost;
}

} // namespace feedhold
