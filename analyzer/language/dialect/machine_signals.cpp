// Motion controllers, routers, robots, drilling machines and training controls: marks that no NC program has elsewhere.
#include "language/dialect/line_scanner.h"

#include <algorithm>
#include <string>

namespace feedhold {

/// `OPEN PLC 5`, `OPEN PROG 10`: the buffer of a motion controller that takes the lines behind it.
bool LineScanner::isBufferHead() const {
  static constexpr std::string_view kBuffers[] = {"OPEN PLC", "OPEN PROG", "OPEN ROT"};
  return std::ranges::any_of(kBuffers, [&](std::string_view begin) { return beginsUpper(rest(), begin); });
}

/// `T01C0.800`: a tool and its diameter in the head of a drill file; `INCH,TZ`, `METRIC`: the units of the file.
bool LineScanner::isDrillHead() const {
  const std::string_view line = trimmed(rest());
  if (equalsUpper(line, "INCH") || equalsUpper(line, "METRIC") || beginsUpper(line, "INCH,") ||
      beginsUpper(line, "METRIC,"))
    return true;
  const std::size_t end = line.size() > 1 && toUpper(line[0]) == 'T' ? line.find_first_not_of("0123456789", 1) : 0;
  return end > 1 && end < line.size() - 1 && toUpper(line[end]) == 'C' &&
         line.find_first_not_of("0123456789.", end + 1) == std::string_view::npos && line.find('.') != line.npos;
}

/// `///FRAME BASE`, `//INST`, `MOVL C001 V=11.0`: the head and the moves of a robot job.
bool LineScanner::isRobotLine() const {
  static constexpr std::string_view kMoves[] = {"MOVJ C", "MOVL C", "MOVC C"};
  const std::string_view line = rest();
  const bool isHead = beginsUpper(line, "///") && line.size() > 4 && isLetter(line[3]) && isLetter(line[4]);
  return isHead || equalsUpper(trimmed(line), "//INST") || equalsUpper(trimmed(line), "/JOB") ||
         std::ranges::any_of(kMoves, [&](std::string_view move) {
           return beginsUpper(line, move) && line.size() > move.size() && isDigit(line[move.size()]);
         });
}

/// `H DX=600 DY=400 DZ=18`, `XG0 X=10 Y=20`: the head and the lines of Xilog.
bool LineScanner::isXilogLine() const {
  static constexpr std::string_view kBegins[] = {"H DX=", "XG0 X=", "XL2P X=", "XB X="};
  return std::ranges::any_of(kBegins, [&](std::string_view begin) { return beginsUpper(rest(), begin); });
}

/// What is known by how its line begins; true: the line is done.
bool LineScanner::scanMachineHead() {
  struct Mark {
    bool is;
    TextSignal signal;
  };
  const Mark kMarks[] = {
      {isBufferHead(), TextSignal::BufferHead}, {beginsUpper(rest(), "DVAR $"), TextSignal::AerotechStatement},
      {isDrillHead(), TextSignal::DrillHead},   {isRobotLine(), TextSignal::RobotJob},
      {isXilogLine(), TextSignal::XilogLine},   {beginsUpper(rest(), "{$"), TextSignal::EditorTemplate}};
  const auto mark = std::ranges::find(kMarks, true, &Mark::is);
  if (mark == std::end(kMarks))
    return false;
  count(mark->signal);
  hasWord_ = true;
  stop();
  return true;
}

/// `P1 G1 Z0 X40`, `P2 X100`: the labels to which P and Q of a cycle before them point.  One alone may be a slip.
void LineScanner::scanLabelP() {
  std::size_t end = at_ + 1;
  while (end < line_.size() && isDigit(line_[end]))
    ++end;
  if (toUpper(peek()) != 'P' || end == at_ + 1 || end >= line_.size() || !isBlank(line_[end]))
    return;
  const std::string_view label = line_.substr(at_ + 1, end - at_ - 1);
  auto &[first, last] = scan_.contour;
  if (first != 0 && label == std::to_string(first))
    first = 0; // found
  else if (first == 0 && last != 0 && label == std::to_string(last))
    count(TextSignal::LabelP);
}

/// `G71 P1 Q2`
void LineScanner::noteContour() {
  if (hasTurningCycle_ && hasNumber('P') && hasNumber('Q'))
    scan_.contour = {contourFirst_, contourLast_};
}

} // namespace feedhold
