// What a block says about the kind of machine: cycles of lathes, axes, and the codes with which they move.
#include "language/dialect/line_scanner.h"

#include <algorithm>
#include <string_view>

namespace feedhold {

/// By the words beside the code, which mills have for holes and patterns of holes.
bool LineScanner::isTurningCycle() const {
  const auto has = [&](std::string_view letters) {
    return std::ranges::all_of(letters, [&](char letter) { return hasLetter(letter); });
  };
  if (hasLetter('Y'))
    return false;
  if (gCodes_[74] || gCodes_[75])
    return has("XZPQ") && !hasLetter('R');
  return hasTurningCycle_ && (has("PQ") || hasLetter('U') ||
                              ((gCodes_[71] || gCodes_[72]) && hasLetter('P') && !hasLetter('I') && !hasLetter('J')));
}

void LineScanner::countLatheMarks() {
  if (hasG91_ || (hasG90_ && (codes_ > 1 || !(hasLetter('X') || hasLetter('Z') || hasLetter('U') || hasLetter('W')))))
    count(TextSignal::DistanceMode);
  if ((hasLetter('U') || hasLetter('W')) && !hasLetter('Y'))
    count(TextSignal::IncrementalAxis);
  if (gCodes_[28] && (hasLetter('U') || hasLetter('W')) && (letters_ & ~lettersOf("GMNUWT")) == 0)
    count(TextSignal::IncrementalHome);
  if (hasNumber('X') && hasNumber('Z') && !hasLetter('Y') && !hasHome_ && !hasLetter('H'))
    count(TextSignal::PlaneMove);
  if (gCodes_[32] && hasLetter('Z') && hasLetter('F') && !hasLetter('Y'))
    count(TextSignal::ThreadPass);
  if (hasLetter('Y'))
    count(TextSignal::YAxis);
}

} // namespace feedhold
