// The marks of the G code systems of FANUC lathes.  Each code here has another meaning, or none, in another system
// (list of G codes in the operator's manuals of the T series).
#include "language/dialect/g_code_system.h"

#include "base/support/check.h"
#include "language/dialect/line_scanner.h"

namespace feedhold {

bool LineScanner::hasAnyCode(std::size_t first, std::size_t last) const {
  for (std::size_t code = first; code <= last; ++code)
    if (gCodes_[code])
      return true;
  return false;
}

/// Of one block.  Marks that some program of another system may have, too, are left out: `G90 X50. Z2.` is a cycle in A
/// and a movement in B, `G98` a feed mode in A and a return level beside a drilling cycle in B.
void LineScanner::countGCodeSystem() {
  const bool hasIncrement = hasLetter('U') || hasLetter('W');
  const bool hasBoth = (hasLetter('X') || hasLetter('U')) && (hasLetter('Z') || hasLetter('W'));
  const bool hasAxes = hasLetter('X') || hasLetter('Z') || hasIncrement;
  const bool isOneCycle = codes_ == 1 && hasBoth && hasLetter('F') && !hasLetter('Q');
  if (gCodes_[95] || (gCodes_[94] && !hasAxes))
    note(TextSignal::FeedModeCode);

  const bool isFeedMode = hasAnyCode(98, 99) && !hasAnyCode(80, 89) && (hasLetter('F') || hasAnyCode(0, 3));
  const bool isCycleOfA = isOneCycle && (gCodes_[90] || gCodes_[92] || gCodes_[94]);
  const bool movesByLetter = hasIncrement && !hasAnyCode(70, 79) && !gCodes_[4] && !gCodes_[10];
  if (isFeedMode || isCycleOfA || movesByLetter)
    note(TextSignal::SystemACode);

  if (hasAnyCode(77, 79) && hasLetter('X') && hasLetter('Z') && !hasLetter('Y') && !hasLetter('Q'))
    note(TextSignal::SystemBCycle);

  const bool isUnit = hasAnyCode(70, 71) && !hasAxes && !hasLetter('P') && !hasLetter('R') && !hasLetter('D');
  if (isUnit || (isOneCycle && (gCodes_[20] || gCodes_[21] || gCodes_[24])))
    note(TextSignal::SystemCCode);
}

std::optional<GCodeSystem> gCodeSystemOf(const TextScan &scan) {
  const auto has = [&](TextSignal signal) { return scan.count(signal) != 0; };
  const bool hasModes = has(TextSignal::DistanceMode) && has(TextSignal::FeedModeCode);
  const bool hasMode = has(TextSignal::DistanceMode) || has(TextSignal::FeedModeCode);
  const bool isA = has(TextSignal::SystemACode);
  const bool isB = has(TextSignal::SystemBCycle);
  const bool isC = has(TextSignal::SystemCCode);
  if (isA)
    return hasMode || isB || isC ? std::nullopt : std::optional(GCodeSystem::A);
  if (isC)
    return hasMode && !isB ? std::optional(GCodeSystem::C) : std::nullopt;
  return hasModes || (isB && hasMode) ? std::optional(GCodeSystem::B) : std::nullopt;
}

std::string_view marksOf(GCodeSystem system) {
  switch (system) {
  case GCodeSystem::A: return "feed modes, cycles or increments of G code system A";
  case GCodeSystem::B: return "distance modes, feed modes or cycles of G code system B";
  case GCodeSystem::C: return "units, modes or cycles of G code system C";
  }
  FEEDHOLD_UNREACHABLE("the switch names every system");
}

} // namespace feedhold
