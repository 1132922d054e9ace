// What sets programs for Fadal controls apart (Fadal, CNC 88 User Manual): `E1` is a fixture offset, a modal word like
// an axis, and `L100` alone in its block begins, or calls, a subprogram.
#include "language/dialect/line_scanner.h"

namespace feedhold {

void LineScanner::countFadalMarks() {
  constexpr auto bitOf = [](char letter) { return 1U << (letter - 'A'); };
  const auto hasOnly = [this, bitOf](std::string_view letters) {
    std::uint32_t allowed = 0;
    for (const char letter : letters)
      allowed |= bitOf(letter);
    return (letters_ & ~allowed) == 0;
  };
  if (hasHash_ || hasUnknown_ || hasOWord_)
    return;
  if (hasSubprogramL_ && hasOnly("LN"))
    count(TextSignal::FadalSubprogram);
  // Elsewhere E is the lead of a thread, an output (`M68 E1`), a length of filament, or, alone, a pack of conditions of
  // wire erosion.
  std::bitset<100> others = gCodes_;
  for (const std::size_t code : {0, 8, 9, 17, 40, 49, 80, 90})
    others.reset(code);
  const bool isPosition = hasLetter('X') || hasLetter('Y') || hasLetter('Z') || hasLetter('H');
  if (hasOffsetE_ && others.none() && isPosition && hasOnly("ABDEGHMNSTXYZ"))
    count(TextSignal::FadalOffset);
}

} // namespace feedhold
