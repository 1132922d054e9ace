#include "meaning/semantics/moves.h"

namespace feedhold {

std::string_view nameOf(MoveKind kind) {
  switch (kind) {
  case MoveKind::Rapid: return "rapid";
  case MoveKind::Feed: return "feed";
  case MoveKind::ArcClockwise: return "arc-clockwise";
  case MoveKind::ArcCounterclockwise: return "arc-counterclockwise";
  case MoveKind::CutInBox: return "cut-in-box";
  case MoveKind::Dwell: return "dwell";
  case MoveKind::Probe: return "probe";
  case MoveKind::Unmodelled: return "unmodelled";
  }
  return "";
}

} // namespace feedhold
