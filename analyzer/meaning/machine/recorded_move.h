// RecordedMove: one movement of a run, and where the tool's centre went while it was made.
#pragma once

#include "meaning/machine/concrete_interpretation.h"

#include <vector>

namespace feedhold {

/// What the numbers of a move are counted in; the time of a dwell is not.
enum class LengthUnit : std::uint8_t { Millimetre, Inch };

/// What tool length does to the coordinates of a move: G43 adds it, G44 subtracts it.
enum class LengthInForce : std::uint8_t { None, Added, Subtracted };

struct RecordedMove {
  Move<ConcreteValue> move; // as programmed
  LengthUnit unit;
  Place place;
  Place own; // the same, or the block of the started program that called it
  /// X, Y, Z: how far the zero point of its coordinates lies from that of the start.
  std::array<double, 3> zero = {};
  /// X, Y, Z: where that zero point lies in machine coordinates, tool length included; in the units of the move.
  std::array<double, 3> machineZero = {};
  /// Its coordinates, or those of `centre`, are those of the tool (tool_point.h): cutter compensation is off or
  /// followed, its length and the units are those of the start, and no axis that regions do not describe has moved
  /// since, or moves here, but for those of `@FIXED`.
  bool isOfTool = true;
  bool isOfToolButForLength = true; // the same, whatever has become of the length
  LengthInForce length = LengthInForce::Added;
  bool isOfAxes = true; // cutter compensation is off or followed, and the units are those of the start
  /// The moves that the centre of the tool makes instead, beside the programmed one: cutter compensation is in force or
  /// ends.  Empty: it makes the programmed one.
  std::vector<Move<ConcreteValue>> centre = {};
  /// X, Y, Z: from there to the point that is programmed without compensation; on a lathe, the tip beside the nose.
  std::array<double, 3> tip = {};
};

/// The same as moves of the tool's centre: those of `centre`, or the programmed one.
std::vector<RecordedMove> movesOfCentre(const RecordedMove &recorded);
/// The same as moves of the point that is programmed without compensation.
std::vector<RecordedMove> movesOfTip(const RecordedMove &recorded);

/// Something that a run did not follow.
struct RunNote {
  std::string_view reason;
  Place place;
};

} // namespace feedhold
