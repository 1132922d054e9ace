// CutterPath: cutter compensation as a step between the moves of a run and their users.
//
// Where the tool's centre goes in one block depends on the next one that moves in the plane.  So one block is pending,
// with the moves behind it that do not move in the plane, until the next one is known, or the control reads no further.
//
//   off -> waiting (G41 or G42 in force) -> on (from the first move in the plane: start-up) -> ending (G40 or D0)
//       -> off (behind the first move in the plane: cancel)
//
// What is not followed (another side or offset inside, a vector by I J K, G28 inside ..) leaves the path unknown up to
// the end of the first move in the plane without compensation.
#pragma once

#include "meaning/machine/cutter_block.h"
#include "meaning/machine/recorded_move.h"

#include <optional>
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

class CutterPath {
public:
  /// Fills in RecordedMove::centre and isOfTool of `moves`, to which its owner adds.
  CutterPath(const Dialect &dialect, std::vector<RecordedMove> &moves) : dialect_(dialect), moves_(moves) {}

  /// A block has been executed; its moves are those from `firstMove` on.
  void take(const CutterBlock &block, Place place, std::size_t depth, std::size_t firstMove);
  /// No block follows.
  void finish();
  bool isOff() const { return phase_ == Phase::Off; }

  const std::optional<CutterAlarm> &alarm() const { return alarm_; }
  std::vector<RunNote> takeNotes() { return std::exchange(notes_, {}); }

private:
  enum class Phase : std::uint8_t { Off, Waiting, On, Ending, Lost };
  enum class Role : std::uint8_t { StartUp, Steady };
  struct Pending {
    std::size_t move;
    Role role;
    CutterElement element;
    PlaneVector from; // offset of the centre at its start
    Place place;
    std::size_t depth;
    std::size_t idle = 0;                 // blocks behind it that do not move in the plane
    std::vector<std::size_t> behind = {}; // their moves
  };
  struct At {
    Place place;
    std::size_t depth;
    std::size_t move;
  };

  void enter(const CutterBlock &block, const At &at);
  void change(const CutterBlock &block, const At &at);
  void changeInside(const CutterBlock &block, const At &at);
  void move(std::size_t index, const CutterBlock &block, const At &at);
  void moveInPlane(std::size_t index, const CutterBlock &block, const At &at);
  void moveBeside(std::size_t index);
  void startUp(std::size_t index, const CutterBlock &block, const At &at);
  void goOn(std::size_t index, const At &at);
  void cancel(std::size_t index, const At &at);
  void idle(const CutterBlock &block);

  bool isInPlane(const Move<ConcreteValue> &move) const;
  bool refusesArc(const CutterElement &element, const At &block);
  CutterJoin startOf(const CutterElement &next) const;
  CutterJoin endOf(const CutterElement &next) const;
  void finishPending(const CutterJoin &join);
  void failReading();
  bool isReversed(const Pending &pending, PlaneVector to) const;
  Move<ConcreteValue> shifted(Move<ConcreteValue> move, PlaneVector start, PlaneVector end) const;
  Move<ConcreteValue> centreMove(const Pending &pending, PlaneVector to) const;
  void addLinks(std::size_t index, const CutterJoin &join);
  void stop(AlarmKind kind, const At &at);
  void lose(std::string_view reason, Place place);

  const Dialect &dialect_;
  std::vector<RecordedMove> &moves_;
  Phase phase_ = Phase::Off;
  CutterSide side_;
  Plane plane_ = kPlaneXY;
  PlaneVector at_; // from the programmed point to the centre, behind the last finished block
  std::optional<Pending> pending_;
  std::optional<Place> began_; // the last block with G41 or G42; absent: it was in force at the start
  std::optional<CutterAlarm> alarm_;
  std::vector<RunNote> notes_;
};

} // namespace feedhold
