#include "proof/space/space_programs.h"

#include <array>
#include <fmt/format.h>

namespace feedhold::proof_tests {

using soundness::ProgramLines;
using soundness::Random;
using soundness::Sample;

namespace {

/// Expressions over the arguments.
class Numbers {
public:
  explicit Numbers(Random &random) : random_(random) {}

  std::string pick(std::initializer_list<const char *> choices) { return random_.of<const char *>(choices); }
  std::string argument() { return pick({"#1", "#2", "#3"}); }
  /// Above 0 for most arguments.
  std::string size() {
    switch (random_.below(8)) {
    case 0: return "[" + argument() + pick({"/2]", "*2]", "*1.5]"});
    case 1: return "[" + argument() + "+" + argument() + "]";
    case 2: return "[" + argument() + "+" + pick({"1", ".5", "4"}) + "]";
    case 3: return random_.oneIn(2) ? "[" + argument() + "*" + argument() + "]" : "[" + argument() + "+#13]";
    case 4:
    case 5: return pick({"1.", "2.", "3.5", "6.", "10.", ".25"});
    default: return argument();
    }
  }
  std::string place() {
    if (random_.oneIn(4))
      return "[0-" + size() + "]";
    return random_.oneIn(6) ? "[" + size() + "-" + size() + "]" : size();
  }

protected:
  Random &random_;
};

class Writer : private Numbers {
public:
  explicit Writer(Random &random) : Numbers(random) {}

  ProgramLines run() {
    add("O1");
    contract();
    add("#13=" + pick({"0", "1.", "#1", "[#2/2]"}));
    add("#14=0");
    for (std::uint32_t i = 1 + random_.below(4); i > 0; --i)
      part();
    add(pick({"M30", "M99"}));
    if (called_)
      called();
    return std::move(lines_);
  }

private:
  void add(std::string line) { lines_.push_back(std::move(line)); }
  std::uint32_t nextLabel() { return label_ += 10; }

  void contract() {
    for (const char *variable : {"#1", "#2", "#3"})
      add(fmt::format("(@PARAM {} {})", variable,
                      pick({"1..4", "0.5..2.5", "2..6", "1..3 INT", "IN 1,2,4", "0.25..8", "-2..3", "3..3.5"})));
    if (random_.oneIn(4))
      add("(@REQUIRE " + pick({"#1 LE #2", "#2 GT #3", "[#1+#2] GE 2", "#3 NE 0", "#1*#2 LE 9"}) + ")");
    add("(@START " + pick({"X0 Y0 Z20.", "X0 Y0 Z20.", "X#1 Y-#2 Z12.", "Y3. X0 Z[#3+5]", "X0 Y0", "Z10. X1. Y0"}) +
        ")");
    add("(@MODAL G21 G40 G80 G50 G69 G50.1 G15 " + pick({"G90", "G90", "G91", ""}) + pick({" G0", " G0", " G1", ""}) +
        pick({" G17", " G17", " G17", " G18", " G19", ""}) + pick({" G98", " G98", " G99", ""}) +
        pick({"", " G49", " G54", " G94"}) + ")");
    add("(@TOOL " +
        pick({"FLAT RADIUS 2.", "FLAT RADIUS .5", "BALL RADIUS 1.5", "BULL RADIUS 2. CORNER .5", "DRILL RADIUS 1.",
              "FLAT RADIUS [ABS[#3]+.5]", "BALL RADIUS [ABS[#2]/2+.25]", "BULL RADIUS 3. CORNER 1."}) +
        ")");
    if (random_.oneIn(3))
      add("(@FIXED " + pick({"A", "A B", "B"}) + ")");
  }

  // ---- parts ----

  void part() {
    switch (random_.below(13)) {
    case 0:
    case 1: return lines();
    case 2:
    case 3: return arc();
    case 4: return drilling();
    case 5: return descent();
    case 6: return branch();
    case 7: return frame();
    case 8: return call();
    case 9: return across();
    case 10: return add(odd());
    case 11: return radius();
    default: add("G90"); return lines();
    }
  }
  void lines() {
    for (std::uint32_t i = 1 + random_.below(3); i > 0; --i)
      add(line());
  }
  std::string line() {
    std::string text = random_.oneIn(5) ? pick({"G90", "G91"}) : "";
    text += pick({"G0", "G1", "G1", ""});
    if (random_.oneIn(2))
      text += "X" + place();
    if (random_.oneIn(2))
      text += "Y" + place();
    if (random_.oneIn(3))
      text += "Z" + place();
    if (random_.oneIn(4))
      text += "F" + pick({"100", "[100*#1]", "#14"});
    if (random_.oneIn(12))
      text += pick({"A0", "A90.", "A[90*#1]", "B#2"});
    return text;
  }
  std::string odd() {
    return pick({"G91G28Z0",    "G28X0Y0",   "G90G53Z0", "G10L2P1X1.",
                 "G54",         "G55",       "G92X0",    "G43H1",
                 "G49",         "G4P100",    "G52X0Y0",  "G17",
                 "G18",         "G19",       "G41D1",    "G40",
                 "G10P1R5.",    "G20",       "#5221=#1", "M98P2",
                 "G80",         "S#1",       "G31Z-2.",  "G30Z0",
                 "G60X1.",      "G1X2.,R.5", "G92.1",    "G68X0Y0R[#1*10]",
                 "G99",         "G98",       "G91G53Z0", "G81G0X1.Z-1.R1.F50",
                 "A90.",        "G2X1.R.1",  "G43H1Z1.", "G52X5.",
                 "G40X#1",      "G67",       "G69",      "G51.1X0",
                 "G68X0Y0R90.", "G81X2.F50", "G90A0"});
  }

  /// From a known place, clockwise about I J, by a quarter, a half or all of a circle.
  void arc() {
    const std::string r = size();
    const bool isRelative = random_.oneIn(2);
    const std::string x = place(), y = place();
    if (!isRelative || random_.oneIn(2))
      add("G90" + pick({"G0", "G1"}) + "X" + x + "Y" + y);
    const auto to = [&](const std::string &from, const std::string &by) {
      return isRelative ? by : "[" + from + "+" + by + "]";
    };
    std::string text = std::string(isRelative ? "G91" : "G90") + pick({"", "G17"}) + pick({"G2", "G3"});
    switch (random_.below(4)) {
    case 0: text += "I" + pick({"", "-"}) + r; break;
    case 1: // or nearly to half of it: the control allows for that
      text += "X" + to(x, "[" + r + pick({"*2]", "*2]", "*2+.01]", "*2-.015]"})) + "I" + r;
      break;
    case 2: text += "X" + to(x, r) + "Y" + to(y, r) + pick({"I", "J"}) + r; break;
    default: text += "X" + to(x, r) + "Y" + to(y, "[0-" + r + "]") + pick({"I" + r, "J-" + r}); break;
    }
    if (random_.oneIn(3))
      text += "Z" + place();
    if (random_.oneIn(6))
      text += "F50";
    add(text);
  }
  std::string pick(std::initializer_list<std::string> choices) { return random_.of<std::string>(choices); }
  using Numbers::pick;

  void radius() {
    const std::string r = size();
    const std::string r2 = random_.oneIn(2) ? "[" + r + "*2]" : r;
    switch (random_.below(4)) {
    case 0: add("G91G17" + pick({"G2", "G3"}) + "X" + r2 + "R" + pick({"", "-"}) + r); break;
    case 1: add("G91G18" + pick({"G2", "G3"}) + "X" + r + "Z" + pick({"", "-"}) + r + "R" + r); break;
    case 2: add("G91G19" + pick({"G2", "G3"}) + "Y" + r + "Z" + pick({"", "-"}) + r + pick({"J", "K"}) + r); break;
    default: add("G91G18" + pick({"G2", "G3"}) + "X" + r2 + "I" + r); break;
    }
    if (!random_.oneIn(3))
      add("G90G17");
  }

  void drilling() {
    if (random_.oneIn(2))
      add("G90G0X" + place() + "Y" + place() + "Z" + pick({"5.", "10.", "#1", "[#2+3]"}));
    std::string text = pick({"G90", "G91", ""}) + pick({"G98", "G99", ""});
    const bool pecks = random_.oneIn(2);
    text += pecks ? pick({"G83", "G73"}) : pick({"G81", "G82", "G85", "G89", "G84"});
    if (random_.oneIn(2))
      text += "X" + place();
    text += "Z-" + size() + "R" + pick({"2.", "1.", "#1", "0"});
    if (pecks)
      text += "Q" + pick({"1.", ".5", "#1", "[#2+.5]", "3."});
    if (random_.oneIn(4))
      text += pick({"K2", "K3", "K0"});
    add(text + "F80");
    for (std::uint32_t i = random_.below(3); i > 0; --i)
      add("X" + place() + (random_.oneIn(2) ? "Y" + place() : ""));
    if (!random_.oneIn(6))
      add("G80");
  }

  /// Layer by layer, the last one thinner.
  void descent() {
    const std::string depth = size(), step = pick({"1.", "#1", ".75", "2.", "[#2/2]", "[#3+.5]"});
    add("#10=0");
    add(fmt::format("WHILE[#10{}{}]DO1", pick({"LT", "LT", "LE"}), depth));
    add("#10=#10+" + step);
    if (!random_.oneIn(4))
      add(fmt::format("IF[#10GT{}]THEN#10={}", depth, depth));
    add("G90G1Z-#10F100");
    if (random_.oneIn(2))
      add("X" + place());
    if (random_.oneIn(3))
      add("G91G2I" + size());
    if (random_.oneIn(3))
      add("G91G0Z" + size());
    if (random_.oneIn(3))
      add("G90G0Z" + pick({"2.", "5.", "[3-#10]"}));
    add("END1");
  }
  /// Row by row.
  void across() {
    add("#11=0");
    add("#12=" + size());
    add("G90G0Y" + place() + "Z" + pick({"1.", "-1.", "-#1", "[#2-4]"}));
    add("WHILE[#11LT#12]DO2");
    add("G90G1X#11" + (random_.oneIn(2) ? "Y" + place() : std::string()));
    if (random_.oneIn(3))
      add("IF[#11GT" + size() + "]GOTO" + std::to_string(label_ + 10));
    if (random_.oneIn(2))
      add("G91G1Y" + place());
    add(fmt::format("N{}#11=#11+{}", nextLabel(), pick({"1.", "[#2+.25]", "1.5", "#3"})));
    add("END2");
  }
  void branch() {
    const std::string label = std::to_string(nextLabel());
    add("IF[" + argument() + pick({"GT", "LT", "GE", "EQ", "NE"}) + pick({"2", "1.5", "#1", "#2", "[#1+#3]"}) +
        "]GOTO" + label);
    add(line());
    if (random_.oneIn(2))
      add(line());
    if (random_.oneIn(3)) {
      const std::string end = std::to_string(nextLabel());
      add("GOTO" + end);
      add("N" + label + line());
      add("N" + end);
    } else {
      add("N" + label);
    }
  }
  void frame() {
    const bool shifts = random_.oneIn(3);
    if (shifts) {
      add("G52X" + place() + (random_.oneIn(2) ? "Y" + place() : "") + (random_.oneIn(3) ? "Z" + place() : ""));
    } else {
      add(pick({"G90", "G90", "G91"}) +
          pick({"G51.1X" + place(), "G51.1X0Y" + place(), "G68X" + place() + "Y0R90.",
                "G68X0Y0R" + pick({"45.", "-30.", "180."}), "G51X0Y0Z0P2.", "G51X" + place() + "Y0P.5",
                "G51X0Y0Z0I2.J2.K1.", "G51X1.Y0I-1.J1.", "G68R90.", "G51.1Z0"}));
    }
    for (std::uint32_t i = 1 + random_.below(2); i > 0; --i)
      random_.oneIn(3) ? arc() : random_.oneIn(4) ? drilling() : lines();
    if (!random_.oneIn(4))
      add(shifts ? "G52X0Y0Z0" : "G50G50.1X0Y0Z0G69");
  }
  void call() {
    called_ = true;
    add(pick({"G65P2A#2B" + size(), "M98P2", "G65P2A[#1*2]B1.C#3", "M98P2L2", "G66P2A1.B#2C1."}));
    if (random_.oneIn(4))
      add("G67");
  }
  void called() {
    add("O2");
    for (std::uint32_t i = 1 + random_.below(2); i > 0; --i)
      random_.oneIn(3) ? arc() : lines();
    add("M99");
  }

  ProgramLines lines_;
  std::uint32_t label_ = 0;
  bool called_ = false;
};

class OneMovement {
public:
  explicit OneMovement(Random &random) : random_(random) {}

  ProgramLines run() {
    for (double &coordinate : start_)
      coordinate = quarter(80) - 10;
    const std::string start = fmt::format("(@START X{} Y{} Z{})", start_[0], start_[1], start_[2]);
    const double corner = quarter(12);
    const std::string tool = fmt::format("(@TOOL BULL RADIUS {} CORNER {})", corner + quarter(12) + 0.25, corner);
    return {"O1",
            "(@PARAM #1 1..1)",
            "(@PARAM #2 2..2)",
            "(@PARAM #3 3..3)",
            start,
            tool,
            "(@MODAL G21 G40 G80 G50 G69 G50.1 G15 G90 G54)",
            movement(),
            "M30"};
  }

private:
  double quarter(std::uint32_t most) { return static_cast<double>(random_.below(most + 1)) / 4; }
  std::string end(std::size_t axis) {
    return random_.oneIn(3) ? "" : fmt::format("{}{:.2f}", "XYZ"[axis], start_[axis] + quarter(64) - 8);
  }
  std::string movement() {
    if (random_.oneIn(3))
      return random_.of<const char *>({"G0", "G1"}) + end(0) + end(1) + end(2);
    const std::size_t plane = random_.below(3); // G17, G18, G19
    constexpr std::array<std::array<std::size_t, 3>, 3> kAxes{{{0, 1, 2}, {2, 0, 1}, {1, 2, 0}}};
    const auto [first, second, normal] = kAxes[plane];
    // Whole numbers of which many have the same sum of squares: 65 = 1 + 64 = 16 + 49.
    constexpr std::array<std::array<int, 2>, 8> kSpokes{
        {{8, 1}, {7, 4}, {4, 7}, {1, 8}, {-8, 1}, {-7, -4}, {4, -7}, {-1, -8}}};
    const auto from = kSpokes[random_.below(8)];
    const auto to = random_.oneIn(4) ? from : kSpokes[random_.below(8)];
    const double scale = random_.of<double>({0.25, 0.5, 1});
    const auto word = [&](char letter, double value) { return fmt::format("{}{:.2f}", letter, value); };
    return fmt::format("G{}G{}", 17 + plane, random_.oneIn(2) ? 2 : 3) +
           word("XYZ"[first], start_[first] + scale * (to[0] - from[0])) +
           word("XYZ"[second], start_[second] + scale * (to[1] - from[1])) + word("IJK"[first], -scale * from[0]) +
           word("IJK"[second], -scale * from[1]) + (random_.oneIn(2) ? end(normal) : "");
  }

  Random &random_;
  std::array<double, 3> start_{};
};

} // namespace

Sample oneMovement(Random &random) { return {"fanuc-30i", OneMovement(random).run()}; }

Sample millingProgram(Random &random) {
  return {random.oneIn(4) ? "fanuc-30i/lrp" : "fanuc-30i", Writer(random).run()};
}

} // namespace feedhold::proof_tests
