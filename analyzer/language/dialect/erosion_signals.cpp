// Wire erosion: tables of conditions, and codes for pumps and wire.
#include "language/dialect/line_scanner.h"

namespace feedhold {

/// Tables of wire erosion: `C001 = 0003 0015 ..`, `E001=10 17 ..`, `H001 = +000.150`; other controls assign to no
/// address.
bool LineScanner::scanErosion(char letter, const Number &number) {
  if (letter != 'E' && ((letter != 'C' && letter != 'H') || number.digits != 3))
    return false;
  constexpr std::size_t kFewest = 3;
  constexpr std::size_t kWholeRow = 6; // no other language writes so many numbers behind one address
  ++at_;
  skipBlanks();
  const std::size_t numbers = letter == 'E' ? conditionNumbers() : 0;
  if (letter == 'E' ? numbers < kFewest : !isDigit(peek()) && peek() != '+' && peek() != '-')
    return false;
  count(numbers >= kWholeRow ? TextSignal::ErosionRow : TextSignal::ErosionCondition);
  stop();
  return true;
}

/// The numbers with blanks between them: a row of a table of conditions.
std::size_t LineScanner::conditionNumbers() const {
  std::size_t numbers = 0;
  std::size_t i = at_;
  while (i < line_.size() && isDigit(line_[i])) {
    ++numbers;
    while (i < line_.size() && (isDigit(line_[i]) || line_[i] == '.'))
      ++i;
    while (i < line_.size() && isBlank(line_[i]))
      ++i;
  }
  return numbers;
}

/// `T84T86` in one block: pumps and wire of Sodick; other controls take one tool a block.
void LineScanner::scanErosionTool(const Number &number) {
  if (number.digits == 2 && number.whole >= 80)
    ++erosionTools_;
}

} // namespace feedhold
