// CutterPath: cutter compensation as a step between the moves of a run, or of a path of a proof, and their users.
//
// Where the tool's centre goes in one block depends on the next one that moves in the plane.  So one block is pending,
// with the moves behind it that do not move in the plane, until the next one is known, or the control reads no further.
//
//   off -> waiting (G41 or G42 in force) -> on (from the first move in the plane: start-up) -> ending (G40 or D0)
//       -> off (behind the first move in the plane: cancel)
//
// The line before a corner (,C ,R), the corner and the line behind it are three blocks, which the control has read when
// it makes the first.  They are told together, with the second line.
//
// What is not followed (another side or offset inside, a vector by I J K, G28 inside ..) leaves the path unknown up to
// the end of the first move in the plane without compensation.
//
// The host (cutter_geometry.h) numbers the moves in order, and also has
//
//   moveOf(number)               the programmed move
//   follow(number, moves, tip)   what the tool's centre makes of it; how far its tip is from there, along X, Y and Z
//   leave(number, why)           that is not known
//   areInOneSpace(number, number), shift(value, length)  the same zero point and units; a coordinate
//   knowsReadAhead(dialect)      how many blocks the control reads ahead; else corners beyond that are not followed
//   isOn(switch)                 a setting of the machine
//   standing(vector, tolerance)  of no length
//   refuses(truth, alarm, began) whether the control stops.  A host that cannot tell keeps that it may, and says no
//   takeUndecided()              why a truth that was asked for is not known, since the last call; empty: all are
#pragma once

#include "meaning/semantics/cutter_block.h"

#include <optional>
#include <utility>
#include <vector>

namespace feedhold {

/// The control stops before a block, for its compensation.
struct CutterAlarm {
  AlarmKind kind;
  Place place;
  std::size_t depth; // calls that were open there
  std::size_t move;  // the first that is not made
  Place began;       // the block with G41 or G42
};

/// Something that was not followed.
struct CutterNote {
  std::string_view reason;
  Place place;
};

/// Of a block that has been executed: where, and how many calls are open.
struct CutterPlace {
  Place place;
  std::size_t depth;
};

template <typename Host> class CutterPath {
public:
  using N = typename Host::Length;
  using Truth = typename Host::Truth;
  using MoveOf = Move<typename Host::Value>;
  using Vector = PlaneVector<N>;
  using Element = CutterElement<N>;
  using Join = CutterJoin<N>;
  using Block = CutterBlock<N>;

  explicit CutterPath(const Dialect &dialect) : dialect_(&dialect) {}

  /// A block has been executed; its moves are those from `first` up to `end`.
  void take(Host &host, const Block &block, CutterPlace where, std::size_t first, std::size_t end);
  /// A block has been passed that calls a program, or returns from one.
  void passCall();
  /// No block follows.
  void finish(Host &host);
  /// Something came between that is not followed.
  void lose(Host &host, std::string_view reason, Place place);

  bool isOff() const { return phase_ == Phase::Off; }
  /// Neither followed up to here nor off.
  bool isLost() const { return phase_ == Phase::Lost; }
  bool hasPending() const { return pending_.has_value(); }
  /// What the tool's centre makes of the move will be known later.
  bool awaits(std::size_t move) const {
    return pending_ && (pending_->move == move ||
                        std::find(pending_->behind.begin(), pending_->behind.end(), move) != pending_->behind.end());
  }
  /// The block with G41 or G42; absent: it was in force at the start.
  const std::optional<Place> &began() const { return began_; }

  const std::optional<CutterAlarm> &alarm() const { return alarm_; }
  std::vector<CutterNote> takeNotes() { return std::exchange(notes_, {}); }

private:
  enum class Phase : std::uint8_t { Off, Waiting, On, Ending, Lost };
  enum class Role : std::uint8_t { StartUp, Steady };
  struct Pending {
    std::size_t move;
    Role role;
    Element element;
    Vector from; // offset of the centre at its start
    Place place;
    std::size_t depth;
    std::size_t idle = 0, calls = 0;      // blocks behind it that do not move in the plane; calls and returns
    bool mayBeLast = false;               // to the control, which perhaps reads no further
    std::vector<std::size_t> behind = {}; // their moves
  };
  struct At {
    Place place;
    std::size_t depth;
    std::size_t move;
  };
  static constexpr std::string_view kNoLine =
      "cutter compensation at a corner (,C ,R) without a line in the next block";
  static constexpr double kStanding = 1e-9; // a shorter way is none
  static constexpr double kSame = 1e-7;     // offsets that rounding alone keeps apart

  void takePocket(Host &host, const Block &block, const At &at, std::size_t end);
  void enter(Host &host, const Block &block, const At &at);
  void change(Host &host, const Block &block, const At &at);
  void takeCorner(Host &host, const Block &block, bool isBehind, const At &at);
  void changeInside(Host &host, const Block &block, const At &at);
  void move(Host &host, std::size_t index, const Block &block, const At &at);
  void moveInPlane(Host &host, std::size_t index, const Block &block, const At &at);
  void moveBeside(Host &host, std::size_t index);
  void startUp(Host &host, std::size_t index, const Block &block, const At &at);
  void goOn(Host &host, std::size_t index, const At &at);
  void cancel(Host &host, std::size_t index, const At &at);
  void idle(Host &host, const Block &block);
  bool isBeyondReading(std::size_t idle) const {
    const std::size_t most = dialect_->behaviour.cutterBlocks;
    return most != 0 && idle > most - 2;
  }
  /// It is not known whether controls count calls and returns.
  void mayBeBeyondReading() {
    pending_->mayBeLast = pending_->mayBeLast || isBeyondReading(pending_->idle + pending_->calls);
  }

  bool isInPlane(Host &host, const MoveOf &move) const;
  bool refusesArc(Host &host, const Element &element, const At &block);
  Join startOf(Host &host, const Element &next) const;
  Join endOf(Host &host, std::size_t index) const;
  bool turnsOut(Host &host, const Element &before, const Element &behind) const;
  Element ofContour(Host &host, std::size_t index) const;
  std::string_view whyNotJoined(Host &host, std::size_t index, const Join &join) const;
  void finishPending(Host &host, const Join &join);
  Vector endWithoutNext(Host &host) const { return side_.radius * ofContour(host, pending_->move).endNormal; }
  void failReading(Host &host);
  Truth isReversed(Host &host, const Pending &pending, Vector to) const;
  MoveOf shifted(Host &host, MoveOf move, Vector start, Vector end) const;
  MoveOf centreMove(Host &host, const Pending &pending, Vector to) const;
  std::vector<MoveOf> linksOf(Host &host, std::size_t index, const Join &join) const;
  Vector ofTip() const { return Vector{} - side_.tip; } // offset of the centre where there is no compensation
  void follow(Host &host, std::size_t index, std::vector<MoveOf> centre) const;
  void leaveWithTip(Host &host, const At &at);
  bool stopsWhere(Host &host, Truth when, AlarmKind kind, const At &at);
  void stop(Host &host, AlarmKind kind, const At &at);
  void loseHere(Host &host, std::string_view reason, std::size_t index, const At &at);

  const Dialect *dialect_;
  Phase phase_ = Phase::Off;
  CutterSide<N> side_;
  CutterPlane plane_;
  Vector at_; // from the programmed point to the centre, behind the last finished block
  std::optional<Pending> pending_;
  bool waits_ = false;         // the last block has a line that waits for the next one (corners.h)
  std::optional<Place> began_; // the last block with G41 or G42; absent: it was in force at the start
  std::optional<CutterAlarm> alarm_;
  std::string_view lostBy_; // Phase::Lost: the reason
  std::vector<CutterNote> notes_;
};

// ---- implementation -----------------------------------------------------------------------------------------------

template <typename Host>
void CutterPath<Host>::take(Host &host, const Block &block, CutterPlace where, std::size_t first, std::size_t end) {
  if (alarm_)
    return;
  if (!block.pocket.empty())
    return takePocket(host, block, {where.place, where.depth, first}, end);
  if (phase_ == Phase::Off && !block.side)
    return;
  if (block.switches)
    began_ = where.place;
  const At at{where.place, where.depth, first};
  const bool isOpen = !host.takeUndecided().empty();
  change(host, block, at);
  if (isOpen && phase_ != Phase::Off && phase_ != Phase::Lost)
    lose(host, "cutter compensation whose number, offset or side is not known for certain", at.place);
  bool moves = false, isBehindCorner = false;
  for (std::size_t i = first; i < end; ++i) {
    moves = isInPlane(host, host.moveOf(i)) || moves;
    isBehindCorner = isBehindCorner || host.moveOf(i).leadsToLine;
  }
  takeCorner(host, block, isBehindCorner, at);
  for (std::size_t i = first; i < end && !alarm_; ++i) {
    move(host, i, block, at);
    if (isBehindCorner && awaits(i) && pending_->move != i) // it takes all of its line
      pending_->mayBeLast = true;
  }
  if (alarm_ || block.leadsToCorner)
    return;
  if (!moves)
    idle(host, block);
  else if (pending_ && block.stopsReading && dialect_->behaviour.cutterBlocks != 0)
    pending_->mayBeLast = true;
}

// ---- modes ----

template <typename Host> void CutterPath<Host>::enter(Host &host, const Block &block, const At &at) {
  phase_ = Phase::Waiting;
  side_ = *block.side;
  plane_ = block.plane;
  at_ = {};
  if (!began_)
    lose(host, "cutter compensation that was in force before the start", at.place);
  else if (!block.whyNoRadius.empty())
    lose(host, block.whyNoRadius, at.place);
}

template <typename Host> void CutterPath<Host>::change(Host &host, const Block &block, const At &at) {
  switch (phase_) {
  case Phase::Off: return enter(host, block, at);
  case Phase::Waiting:
    if (!block.side)
      phase_ = Phase::Off;
    else
      enter(host, block, at);
    return;
  case Phase::On: return changeInside(host, block, at);
  case Phase::Ending:
    if (!block.side && block.changesTip)
      leaveWithTip(host, at);
    else if (block.side)
      lose(host, "cutter compensation that begins again before a move has ended it", at.place);
    return;
  case Phase::Lost: return;
  }
}

template <typename Host> void CutterPath<Host>::changeInside(Host &host, const Block &block, const At &at) {
  if (block.cancelsByVector)
    return lose(host, "cutter compensation that is cancelled with a vector by I, J, K", at.place);
  if (!block.side && block.changesTip)
    return leaveWithTip(host, at);
  if (!block.side) {
    phase_ = Phase::Ending;
    return;
  }
  if (block.plane.axes.normal != plane_.axes.normal)
    return stop(host, AlarmKind::CutterPlane, at);
  if (!block.foreign.empty())
    return lose(host, block.foreign, at.place);
  if (block.switches || !(*block.side == side_) || !block.whyNoRadius.empty())
    lose(host, "cutter compensation whose side or offset changes, or is given again, before it ends", at.place);
}

/// On a lathe, `G40 X100. Z50. T0100`: the pending block ends square to itself by type A, whichever way the next one
/// leads.  Where the next one begins is known to the tip of the other offset alone.
template <typename Host> void CutterPath<Host>::leaveWithTip(Host &host, const At &at) {
  if (pending_ && pending_->role == Role::Steady && !host.isOn(dialect_->switches.sup) && host.takeUndecided().empty())
    failReading(host);
  if (!alarm_)
    lose(host, "tool nose radius compensation through another tool or tool offset", at.place);
}

// ---- moves ----

template <typename Host> bool CutterPath<Host>::isInPlane(Host &host, const MoveOf &move) const {
  if (isArc(move.kind))
    return true;
  const auto stands = [&](Axis axis) {
    return host.holds(
        host.none(host.lengthOf(move.end[indexOf(axis)]) - host.lengthOf(move.start[indexOf(axis)]), kStanding));
  };
  return move.kind != MoveKind::Dwell && !(stands(plane_.axes.first) && stands(plane_.axes.second));
}

template <typename Host> void CutterPath<Host>::move(Host &host, std::size_t index, const Block &block, const At &at) {
  const MoveOf &programmed = host.moveOf(index);
  if (programmed.kind == MoveKind::Dwell || phase_ == Phase::Off)
    return;
  const bool inPlane = isInPlane(host, programmed);
  const MoveKind kind = programmed.kind;
  if (phase_ != Phase::Lost && kind != MoveKind::Rapid && kind != MoveKind::Feed && !isArc(kind))
    lose(host, "cutter compensation through a move that is not modelled", at.place);
  if (const bool isOpen = !host.takeUndecided().empty(); isOpen && phase_ == Phase::Lost)
    return host.leave(index, lostBy_);
  else if (isOpen)
    lose(host, "cutter compensation through a block that may move in the plane or not", at.place);
  if (phase_ == Phase::Lost) {
    host.leave(index, lostBy_);
    if (inPlane && !block.side && !programmed.leadsToLine)
      phase_ = Phase::Off;
  } else if (inPlane) {
    moveInPlane(host, index, block, at);
  } else {
    moveBeside(host, index);
  }
}

template <typename Host>
void CutterPath<Host>::moveInPlane(Host &host, std::size_t index, const Block &block, const At &at) {
  switch (phase_) {
  case Phase::Waiting: return startUp(host, index, block, at);
  case Phase::On: return goOn(host, index, at);
  case Phase::Ending: return cancel(host, index, at);
  case Phase::Off:
  case Phase::Lost: return;
  }
}

/// The tool goes up or down where it stands, which the next block in the plane decides.
template <typename Host> void CutterPath<Host>::moveBeside(Host &host, std::size_t index) {
  if (pending_)
    pending_->behind.push_back(index);
  else if (phase_ != Phase::Waiting)
    follow(host, index, {shifted(host, host.moveOf(index), at_, at_)});
}

template <typename Host>
void CutterPath<Host>::startUp(Host &host, std::size_t index, const Block &block, const At &at) {
  const MoveOf &programmed = host.moveOf(index);
  const bool byItself = dialect_->behaviour.cutterEntry == CutterEntry::ByItself;
  if (!block.foreign.empty())
    return loseHere(host, block.foreign, index, at);
  if (isArc(programmed.kind) && byItself)
    return loseHere(host, "cutter compensation that begins in an arc", index, at);
  if (isArc(programmed.kind))
    return stop(host, AlarmKind::CutterArc, at);
  const Element element =
      elementOf(host, programmed, plane_, side_.sign, byItself ? CutterRole::Contour : CutterRole::WayThere);
  if (const std::string_view open = host.takeUndecided(); !open.empty())
    return loseHere(host, open, index, at);
  if (byItself && stopsWhere(host, host.notPositive(host.magnitude(element.end - element.start) - side_.radius, 0),
                             AlarmKind::CutterEntryTooShort, at))
    return;
  phase_ = Phase::On;
  pending_ = Pending{index, Role::StartUp, element, ofTip(), at.place, at.depth};
}

/// The block before it is not made either: its end is not known.
template <typename Host> bool CutterPath<Host>::refusesArc(Host &host, const Element &element, const At &block) {
  const At at{block.place, block.depth, pending_ ? pending_->move : block.move};
  for (const N &radius : {element.endRadius, element.startRadius})
    if (stopsWhere(host, host.notPositive(radius, kStanding), AlarmKind::CutterArcCentre, at))
      return true;
  // LinuxCNC refuses an inside arc of the very radius of the tool, too.
  const bool byItself = dialect_->behaviour.cutterEntry == CutterEntry::ByItself;
  const N left = centreRadius(host, element, side_);
  return stopsWhere(host, byItself ? host.notPositive(left, kStanding) : host.negative(left, kSame),
                    AlarmKind::CutterInterference, at);
}

/// Of the pending block and the one that is being taken; empty: they are.
template <typename Host>
std::string_view CutterPath<Host>::whyNotJoined(Host &host, std::size_t index, const Join &join) const {
  if (!host.areInOneSpace(pending_->move, index))
    return "cutter compensation through a change of the zero point or of the units";
  if (join.turn == CornerTurn::Back && join.vectors.empty())
    return "cutter compensation along a block and back";
  if (join.isArc && host.moveOf(pending_->move).kind == MoveKind::Rapid)
    return "cutter compensation about an outer corner in rapid traverse";
  if (pending_->mayBeLast &&
      (join.vectors.size() != 1 || host.holds(host.apart(join.vectors.front(), endWithoutNext(host), kSame))))
    return "cutter compensation at a corner that the control may not have foreseen";
  return {};
}

template <typename Host> void CutterPath<Host>::goOn(Host &host, std::size_t index, const At &at) {
  const Element element = ofContour(host, index);
  if (const std::string_view open = host.takeUndecided(); !open.empty())
    return loseHere(host, open, index, at);
  if (element.isArc && refusesArc(host, element, at))
    return;
  if (pending_) {
    const Join join = pending_->role == Role::StartUp
                          ? startOf(host, element)
                          : joinOf(host, pending_->element, element, side_, dialect_->behaviour.cutterCorners);
    if (const std::string_view open = host.takeUndecided(); !open.empty())
      return loseHere(host, open, index, at);
    if (const std::string_view reason = whyNotJoined(host, index, join); !reason.empty())
      return loseHere(host, reason, index, at);
    if (join.vectors.empty())
      return stop(host, AlarmKind::CutterNoCrossing, {pending_->place, pending_->depth, pending_->move});
    finishPending(host, join);
    if (phase_ == Phase::Lost)
      return host.leave(index, lostBy_);
  } else if ((element.isArc || !host.knowsReadAhead(*dialect_)) &&
             host.holds(host.apart(at_, side_.radius * element.startNormal, kSame))) {
    return loseHere(host,
                    element.isArc ? "cutter compensation of an arc behind a corner that the control has not foreseen"
                                  : "cutter compensation at a corner that the control may not have foreseen",
                    index, at);
  }
  if (const std::string_view open = host.takeUndecided(); !open.empty())
    return loseHere(host, open, index, at);
  if (!alarm_)
    pending_ = Pending{index, Role::Steady, element, at_, at.place, at.depth};
}

template <typename Host> void CutterPath<Host>::cancel(Host &host, std::size_t index, const At &at) {
  if (isArc(host.moveOf(index).kind))
    return stop(host, AlarmKind::CutterArc, at);
  if (pending_ && pending_->role == Role::StartUp) {
    loseHere(host, "cutter compensation without a block between its start and its end", index, at);
    phase_ = Phase::Off;
    return;
  }
  if (pending_) {
    const Join join = endOf(host, index);
    std::string_view reason = host.takeUndecided();
    if (reason.empty())
      reason = whyNotJoined(host, index, join);
    if (!reason.empty()) {
      loseHere(host, reason, index, at);
      phase_ = Phase::Off;
      return;
    }
    finishPending(host, join);
  } else if (!host.knowsReadAhead(*dialect_)) // the last block may have ended otherwise
    lose(host, "cutter compensation that ends at a corner that the control may not have foreseen", at.place);
  if (alarm_)
    return;
  if (phase_ == Phase::Lost) {
    host.leave(index, lostBy_);
    phase_ = Phase::Off;
    return;
  }
  follow(host, index, {shifted(host, host.moveOf(index), at_, ofTip())});
  at_ = {};
  phase_ = Phase::Off;
}

template <typename Host> void CutterPath<Host>::idle(Host &host, const Block &block) {
  if (!pending_ || phase_ != Phase::On)
    return;
  ++pending_->idle;
  const bool isSeen = !(block.stopsReading || block.namesPlane || isBeyondReading(pending_->idle));
  if (isSeen || dialect_->behaviour.cutterBlocks == 0)
    mayBeBeyondReading();
  else if (block.stopsReading || host.knowsReadAhead(*dialect_))
    failReading(host);
  else
    pending_->mayBeLast = true;
}

template <typename Host> void CutterPath<Host>::passCall() {
  if (!pending_ || phase_ != Phase::On)
    return;
  ++pending_->calls;
  mayBeBeyondReading();
}

// ---- from one block to the next ----

/// Square to the next block; by type B an outer corner has the normal of the start-up block first, and so has one of
/// LinuxCNC, where the start-up block is one of the contour.
template <typename Host> auto CutterPath<Host>::startOf(Host &host, const Element &next) const -> Join {
  const Element &own = pending_->element;
  if (dialect_->behaviour.cutterEntry == CutterEntry::ByItself)
    return joinOf(host, own, next, side_, dialect_->behaviour.cutterCorners);
  Join join{.vectors = {side_.radius * next.startNormal}};
  if (turnsOut(host, own, next) && host.isOn(dialect_->switches.sup)) {
    const Element contour = ofContour(host, pending_->move);
    join.turn = turnOf(host, contour, next, side_.sign);
    if (join.turn == CornerTurn::Outer) {
      join.vectors = joinOf(host, contour, next, side_, CutterCorners::Lines).vectors;
      join.vectors.insert(join.vectors.begin(), side_.radius * contour.endNormal);
    }
  }
  return join;
}

/// `index`: the move that ends the compensation.
template <typename Host> auto CutterPath<Host>::endOf(Host &host, std::size_t index) const -> Join {
  const Element &own = pending_->element;
  const Element next = elementOf(host, host.moveOf(index), plane_, side_.sign, CutterRole::WayThere);
  Join join{.vectors = {side_.radius * own.endNormal}};
  if (dialect_->behaviour.cutterEntry == CutterEntry::ToNext && turnsOut(host, own, next) &&
      host.isOn(dialect_->switches.sup)) {
    const Element contour = ofContour(host, index);
    join.turn = turnOf(host, own, contour, side_.sign);
    if (join.turn == CornerTurn::Outer) {
      join.vectors = joinOf(host, own, contour, side_, CutterCorners::Lines).vectors;
      join.vectors.push_back(side_.radius * contour.startNormal);
    }
  }
  return join;
}

template <typename Host>
bool CutterPath<Host>::turnsOut(Host &host, const Element &before, const Element &behind) const {
  const N sine = cross(before.endDirection, behind.startDirection);
  if (!side_.isOfEitherSign)
    return host.holds(host.negative(withSign(side_.sign, sine), detail::kNoTurn));
  const bool mayTurn = !host.holds(host.none(sine, detail::kNoTurn));
  if (mayTurn && dialect_->switches.sup == Switch::On)
    host.cannotTell("cutter compensation of type B that begins or ends at a corner, by an offset that may be above or "
                    "below 0");
  return mayTurn;
}

template <typename Host> auto CutterPath<Host>::ofContour(Host &host, std::size_t index) const -> Element {
  return elementOf(host, host.moveOf(index), plane_, side_.sign);
}

/// The control does not know the next block in the plane: it ends square to its own.
template <typename Host> void CutterPath<Host>::failReading(Host &host) {
  finishPending(host, {.vectors = {endWithoutNext(host)}});
}

template <typename Host> void CutterPath<Host>::finishPending(Host &host, const Join &join) {
  const bool isSteady = pending_->role == Role::Steady;
  const Truth reversed = isSteady ? isReversed(host, *pending_, join.vectors.front()) : Truth{};
  if (const std::string_view open = host.takeUndecided(); !open.empty())
    return lose(host, open, pending_->place);
  const Pending pending = *std::exchange(pending_, std::nullopt);
  if (isSteady &&
      stopsWhere(host, reversed, AlarmKind::CutterInterference, {pending.place, pending.depth, pending.move}))
    return;
  std::vector<MoveOf> links = linksOf(host, pending.move, join);
  std::vector<MoveOf> centre{centreMove(host, pending, join.vectors.front())};
  // Straight pieces belong to the block before the corner, an arc about it to the one behind.
  at_ = join.isArc ? join.vectors.front() : join.vectors.back();
  const bool linksFollow = join.isArc && !pending.behind.empty();
  if (!linksFollow)
    centre.insert(centre.end(), links.begin(), links.end());
  follow(host, pending.move, std::move(centre));
  for (const std::size_t index : pending.behind) {
    std::vector<MoveOf> beside{shifted(host, host.moveOf(index), at_, at_)};
    if (linksFollow && index == pending.behind.back()) {
      links = linksOf(host, index, join);
      beside.insert(beside.end(), links.begin(), links.end());
    }
    follow(host, index, std::move(beside));
  }
  at_ = join.vectors.back();
}

template <typename Host>
auto CutterPath<Host>::isReversed(Host &host, const Pending &pending, Vector to) const -> Truth {
  const Element &element = pending.element;
  if (!element.isArc)
    return host.negative(dot(element.end + to - element.start - pending.from, element.endDirection), kStanding);
  return host.arcReversed(element, pending.from, to, centreRadius(host, element, side_));
}

template <typename Host>
auto CutterPath<Host>::shifted(Host &host, MoveOf move, Vector start, Vector end) const -> MoveOf {
  host.shift(move.start[indexOf(plane_.axes.first)], start.first);
  host.shift(move.start[indexOf(plane_.axes.second)], secondCoordinate(host, start.second, plane_));
  host.shift(move.end[indexOf(plane_.axes.first)], end.first);
  host.shift(move.end[indexOf(plane_.axes.second)], secondCoordinate(host, end.second, plane_));
  return move;
}

template <typename Host>
void CutterPath<Host>::follow(Host &host, std::size_t index, std::vector<MoveOf> centre) const {
  std::array<N, 3> tip{};
  tip[indexOf(plane_.axes.first)] = side_.tip.first;
  tip[indexOf(plane_.axes.second)] = secondCoordinate(host, side_.tip.second, plane_);
  host.follow(index, std::move(centre), tip);
}

template <typename Host>
auto CutterPath<Host>::centreMove(Host &host, const Pending &pending, Vector to) const -> MoveOf {
  MoveOf move = shifted(host, host.moveOf(pending.move), pending.from, to);
  return pending.element.isArc ? host.centreArc(std::move(move), pending.element, pending.from, to,
                                                centreRadius(host, pending.element, side_))
                               : move;
}

template <typename Host>
auto CutterPath<Host>::linksOf(Host &host, std::size_t index, const Join &join) const -> std::vector<MoveOf> {
  std::vector<MoveOf> links;
  const MoveOf &programmed = host.moveOf(index);
  for (std::size_t i = 1; i < join.vectors.size(); ++i) {
    MoveOf link = programmed;
    link.start = link.end = programmed.end;
    link = shifted(host, link, join.vectors[i - 1], join.vectors[i]);
    link.kind = programmed.kind == MoveKind::Rapid ? MoveKind::Rapid : MoveKind::Feed;
    link.turns = 1;
    if (join.isArc) { // on the outside the contour turns away from the tool
      link.kind = side_.sign > 0 ? MoveKind::ArcClockwise : MoveKind::ArcCounterclockwise;
      link.plane = plane_.axes;
      link.firstCentre = programmed.end[indexOf(plane_.axes.first)];
      link.secondCentre = programmed.end[indexOf(plane_.axes.second)];
    }
    if (!host.holds(host.standing(join.vectors[i] - join.vectors[i - 1], kStanding)))
      links.push_back(link);
  }
  host.takeUndecided(); // a link of no length says no more
  return links;
}

} // namespace feedhold

#include "meaning/semantics/cutter_pocket.h"
#include "meaning/semantics/cutter_stop.h"
