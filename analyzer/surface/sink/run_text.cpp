// A run for people: the tool path, a movement a line, then the variables, what is not modelled, and how it ended.
#include "base/support/text.h"
#include "surface/sink/run_shown.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace feedhold {

namespace {

constexpr int kDecimalsOfLength = 6;
constexpr int kDecimalsOfValue = 9;

/// `12.5`, `-0.001`, `0`: no zeros behind the last decimal.
std::string number(double value, int decimals) {
  if (!(std::fabs(value) < 1e15))
    return fmt::format("{}", value);
  std::string text = fmt::format("{:.{}f}", value, decimals);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.')
    text.pop_back();
  return text == "-0" ? "0" : text;
}
std::string length(double value) { return number(value, kDecimalsOfLength); }

class RunText {
public:
  explicit RunText(const RunReport &report) : report_(report), result_(report.result), axes_(axesOf(report)) {}

  std::string write() {
    path();
    if (!text_.empty())
      text_ += '\n';
    if (showsNumbers(report_))
      text_ += fmt::format("numbers: {}\n\n", nameOf(report_.numbers));
    const std::size_t before = text_.size();
    for (const auto &[name, value] : variablesOf(report_))
      text_ += fmt::format("{} = {}\n", name, value.vacant ? "vacant" : number(value.number, kDecimalsOfValue));
    if (text_.size() != before)
      text_ += '\n';
    for (const std::string &program : result_.skipped)
      text_ += fmt::format("{} is in none of the files: the run takes it to return and to change nothing\n", program);
    if (result_.offsetIsAssumed)
      text_ += "no variable gives the offset of D: it is taken to be the radius of @TOOL\n";
    for (const RunNote &note : result_.notes)
      text_ += fmt::format("not modelled: {}, {}\n", note.reason, where(note.place));
    return std::move(text_) + ending();
  }

private:
  // ---- the path ----

  void path() {
    std::size_t next = 0;
    for (const TracedBlock &block : report_.trace) {
      for (; next < std::min(block.movesBefore, result_.moves.size()); ++next)
        move(result_.moves[next]);
      text_ += fmt::format("{} {}{}\n", gutter(block.place), std::string(2 * block.depth, ' '), lineText(block.place));
    }
    for (; next < result_.moves.size(); ++next)
      move(result_.moves[next]);
  }
  void move(const RecordedMove &recorded) {
    step(recorded.place, recorded.move, "");
    for (const Move<ConcreteValue> &move : recorded.centre)
      step(recorded.place, move, "  centre ");
  }
  /// A move, or one that the centre of the tool makes in its place.
  void step(Place place, const Move<ConcreteValue> &move, std::string_view role) {
    text_ += fmt::format("{} {}{:<8}", gutter(place), role, kindOf(move.kind));
    if (move.kind == MoveKind::Dwell) {
      text_ += fmt::format(" {}\n", length(move.feed.number));
      return;
    }
    for (const Axis axis : axes_)
      text_ += fmt::format(" {}{}", letterOf(axis), length(move.end[indexOf(axis)].number));
    if (isArc(move.kind))
      text_ += centreOf(move);
    if (move.kind != MoveKind::Rapid && !move.feed.vacant && role.empty())
      text_ += fmt::format(" F{}", length(move.feed.number));
    text_ += '\n';
  }
  static std::string centreOf(const Move<ConcreteValue> &move) {
    std::string text = fmt::format(" about {}{} {}{}", letterOf(move.plane.first), length(move.firstCentre.number),
                                   letterOf(move.plane.second), length(move.secondCentre.number));
    if (move.turns > 1)
      text += fmt::format(" turns {}", move.turns);
    return text;
  }
  static std::string_view kindOf(MoveKind kind) {
    switch (kind) {
    case MoveKind::Rapid: return "rapid";
    case MoveKind::Feed:
    case MoveKind::CutInBox: return "feed";
    case MoveKind::ArcClockwise: return "arc cw";
    case MoveKind::ArcCounterclockwise: return "arc ccw";
    case MoveKind::Dwell: return "dwell";
    case MoveKind::Probe: return "probe";
    case MoveKind::Unmodelled: return "unknown";
    }
    FEEDHOLD_UNREACHABLE("the switch names every kind");
  }

  // ---- places ----

  bool hasSeveralFiles() const { return report_.programs.size() > 1; }
  std::string_view fileName(Place place) const { return report_.shown[place.file.index()]; }
  std::string gutter(Place place) const {
    return hasSeveralFiles() ? fmt::format("{}:{}", fileName(place), lineAt(report_, place))
                             : fmt::format("{:>4}", lineAt(report_, place));
  }
  std::string where(Place place) const {
    const std::string line = fmt::format("line {}", lineAt(report_, place));
    return hasSeveralFiles() ? fmt::format("{} of {}", line, fileName(place)) : line;
  }
  std::string lineText(Place place) const {
    const SourceFile &source = *report_.programs.file(place.file).source;
    const std::string text = source.utf8(source.lineSpan(lineAt(report_, place)));
    return std::string(trimmed(text));
  }

  // ---- the end ----

  std::string ending() const {
    const std::string place = where(result_.place);
    switch (result_.end) {
    case RunEnd::M02:
    case RunEnd::M30:
    case RunEnd::Returned: return fmt::format("ends with {}, {}\n", nameOf(result_.end), place);
    case RunEnd::EndOfFile: return fmt::format("ends at the end of the file, {}\n", place);
    case RunEnd::Alarm: return fmt::format("alarm {}, {}\n", controlAlarm(), place) + placeAndCalls();
    case RunEnd::UserAlarm: return fmt::format("alarm {}, {}\n", ownAlarm(), place) + placeAndCalls();
    case RunEnd::Fuel:
      return fmt::format("still running after {} instructions and {} movements, {}\n", result_.steps,
                         result_.moves.size(), place) +
             placeAndCalls();
    case RunEnd::Repeats:
      return fmt::format("runs for ever: {} is reached again with nothing changed\n", place) + placeAndCalls();
    case RunEnd::Unmodelled: return fmt::format("stops at a block that is not modelled, {}\n", place) + placeAndCalls();
    }
    FEEDHOLD_UNREACHABLE("the switch names every end");
  }
  std::string controlAlarm() const {
    const Dialect &dialect = *report_.programs.file(result_.place.file).dialect;
    const auto known = alarmNumber(dialect, result_.alarm);
    const std::string_view meaning = meaningOf(result_.alarm);
    return known ? fmt::format("{} ({})", *known, meaning) : std::string(meaning);
  }
  std::string ownAlarm() const {
    const std::string value = number(result_.alarmNumber, kDecimalsOfValue);
    return result_.alarmText.empty() ? "#3000=" + value : fmt::format("#3000={} ({})", value, result_.alarmText);
  }
  std::string placeAndCalls() const {
    std::string text = fmt::format("  {}: {}\n", programAndLine(result_.place), lineText(result_.place));
    for (std::size_t i = result_.calls.size(); i-- > 0;) {
      const Place call = result_.calls[i].place;
      text += fmt::format("  called from {}: {}\n", programAndLine(call), lineText(call));
    }
    return text;
  }
  std::string programAndLine(Place place) const {
    const ProgramFile &file = report_.programs.file(place.file);
    const std::string name = programAt(report_, place.file, file.model->programOf(blockAt(report_, place)));
    return fmt::format("{} line {}", name, lineAt(report_, place));
  }

  const RunReport &report_;
  const RunResult &result_;
  std::vector<Axis> axes_;
  std::string text_;
};

} // namespace

std::string writeRunText(const RunReport &report) { return RunText(report).write(); }

} // namespace feedhold
