#include "proof/space/turning_samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace feedhold::proof_tests {

using soundness::ProgramLines;
using soundness::Random;
using soundness::Sample;

namespace {

class ProgramWriter {
public:
  ProgramWriter(Random &random, bool hasDistanceModes, bool isHaas)
      : random_(random), hasDistanceModes_(hasDistanceModes), isHaas_(isHaas) {}

  ProgramLines run() {
    add("O1");
    contract();
    add("#13=" + pick({"0", "1.", "#1", "[#2/2]"}));
    for (std::uint32_t i = 1 + random_.below(4); i > 0; --i)
      part();
    add(pick({"M30", "M99"}));
    return std::move(lines_);
  }

private:
  void add(std::string line) { lines_.push_back(std::move(line)); }
  std::string pick(std::initializer_list<const char *> choices) { return random_.of<const char *>(choices); }
  std::string argument() { return pick({"#1", "#2", "#3"}); }
  std::string size() {
    switch (random_.below(6)) {
    case 0: return "[" + argument() + pick({"/2]", "*2]", "*1.5]"});
    case 1: return "[" + argument() + "+" + argument() + "]";
    case 2: return "[" + argument() + "+" + pick({"1", ".5", "4"}) + "]";
    case 3: return pick({"1.", "2.", "3.5", "6.", "10.", ".25"});
    default: return argument();
    }
  }
  std::string diameter() {
    return random_.oneIn(3) ? pick({"20.", "16.", "24.5", "8.", "0", "-1."})
                            : "[" + pick({"20", "12", "30"}) + pick({"+", "-"}) + size() + "]";
  }
  std::string along() { return random_.oneIn(4) ? pick({"0", "2.", "-5.", "-12."}) : "[0-" + size() + "]"; }
  std::string absolute() { return hasDistanceModes_ ? "G90" : ""; }
  /// `G91 X..` or `U..`
  std::string by(char axis, const std::string &distance) {
    return fmt::format("{}{}", hasDistanceModes_ ? axis : axis == 'X' ? 'U' : 'W', distance);
  }
  std::string incremental() { return hasDistanceModes_ ? "G91" : ""; }

  void contract() {
    for (const char *variable : {"#1", "#2", "#3"})
      add(fmt::format("(@PARAM {} {})", variable,
                      pick({"1..4", "0.5..2.5", "2..6", "1..3 INT", "IN 1,2,4", "0.25..8", "-2..3"})));
    add("(@START " + pick({"X40. Z5.", "X40. Z5.", "X[30+#1] Z2.", "X20.", "Z10. X44."}) + ")");
    add("(@MODAL G21 G40" + pick({" G18", " G18", " G18", ""}) + pick({" G0", " G0", " G1", ""}) +
        (hasDistanceModes_ ? pick({" G90", " G90", " G91", ""}) : "") + ")");
    add(fmt::format("(@TOOL TIP RADIUS {} DIRECTION {})", pick({"0", ".4", ".8", "1.5", "[ABS[#3]/2]"}),
                    random_.below(10)));
  }

  void part() {
    switch (random_.below(15)) {
    case 0:
    case 1:
    case 2: return moves();
    case 3: return arc();
    case 4: return radius();
    case 5: return passes();
    case 6: return branch();
    case 7: return cycle();
    case 8: return groove();
    case 9: return threadPasses();
    case 10:
    case 11: return contour();
    case 12:
    case 13: return nose();
    default: return add(odd());
    }
  }
  void moves() {
    for (std::uint32_t i = 1 + random_.below(3); i > 0; --i)
      add(line());
  }
  std::string line() {
    const bool isAbsolute = !random_.oneIn(3);
    std::string text = (isAbsolute ? absolute() : incremental()) + pick({"G0", "G1", "G1", ""});
    if (random_.oneIn(2))
      text += isAbsolute ? "X" + diameter() : by('X', pick({"", "-"}) + size());
    if (random_.oneIn(2))
      text += isAbsolute ? "Z" + along() : by('Z', pick({"", "-"}) + size());
    return text + (random_.oneIn(4) ? "F.2" : "");
  }
  /// A quarter from a place that is known: in X twice the radius.
  void arc() {
    const std::string r = size();
    add(absolute() + pick({"G0", "G1"}) + "X" + diameter() + "Z" + along());
    const bool isFirst = random_.oneIn(2);
    add(incremental() + pick({"G2", "G3"}) + by('X', pick({"[", "[0-"}) + r + "*2]") +
        by('Z', pick({"[", "[0-"}) + r + "]") + (isFirst ? pick({"I", "I-"}) : pick({"K", "K-"})) + r);
    if (hasDistanceModes_)
      add("G90");
  }
  void radius() {
    const std::string r = size();
    add(incremental() + pick({"G2", "G3"}) + by('X', pick({"[", "[0-"}) + r + pick({"*2]", "]", "/2]"})) +
        by('Z', pick({"[", "[0-"}) + r + "]") + "R" + r);
    if (hasDistanceModes_)
      add("G90");
  }
  void passes() {
    add("#10=0");
    add(fmt::format("WHILE[#10LT{}]DO1", size()));
    add("#10=#10+" + pick({"1.", "#1", ".75", "[#2/2]", "[#3+.5]"}));
    add(absolute() + "G0X[" + pick({"30", "20", "40"}) + "-#10]");
    add("G1Z" + along() + "F.2");
    if (random_.oneIn(2))
      add(incremental() + "G0" + by('X', "2."));
    add(absolute() + "G0Z" + pick({"2.", "5.", "#1"}));
    add("END1");
  }
  void branch() {
    label_ += 10;
    add(fmt::format("IF[{}{}2]GOTO{}", argument(), pick({"GT", "LT", "EQ"}), label_));
    add(line());
    add(fmt::format("N{}{}", label_, line()));
  }
  void cycle() {
    add(absolute() + "G0X" + diameter() + "Z" + along());
    add((hasDistanceModes_ ? pick({"G77", "G78", "G79"}) : pick({"G90", "G92", "G94"})) + "X" + diameter() + "Z" +
        along() + pick({"", "", "R1.", "R-.5", "R#1"}) + "F.2");
    for (std::uint32_t i = random_.below(3); i > 0; --i)
      add("X" + diameter() + (random_.oneIn(2) ? "Z" + along() : ""));
    if (!random_.oneIn(4))
      add("G0");
  }
  std::string increments() { return pick({"250", "500", "1000", "2500", "[#1*1000]", "[#2*500]"}); }
  void groove() {
    add(absolute() + "G0X" + diameter() + "Z" + along());
    const std::string code = pick({"G74", "G75"}), end = (random_.oneIn(5) ? "" : "X" + diameter()) + "Z" + along();
    if (isHaas_)
      return add(code + end + "I" + pick({"1.", "#1", "2."}) + "K" + pick({"1.", "#2", "3."}) + "F.1");
    if (!random_.oneIn(4))
      add(code + "R" + pick({".5", "1.", "#1", "0"}));
    add(code + end + "P" + increments() + "Q" + increments() + pick({"", "", "", "R.5"}) + "F.1");
  }
  void threadPasses() {
    add(absolute() + "G0X" + diameter() + "Z" + along());
    if (isHaas_)
      return add("G76X" + diameter() + "Z" + along() + pick({"", "I1.", "I#1"}) + "K" + pick({"1.", "#1", "2."}) +
                 "D.25F1.");
    if (!random_.oneIn(4))
      add("G76P010060Q50R.02");
    add("G76X" + diameter() + "Z" + along() + pick({"", "", "R-1.", "R#1"}) + "P" + increments() + "Q250F1.");
  }
  void contour() {
    const bool isTurning = random_.oneIn(2);
    const int first = label_ + 10, last = label_ + 20;
    label_ = last;
    add(absolute() + "G0X" + diameter() + "Z" + along());
    if (random_.oneIn(2))
      add(pick({"G0X50.Z2.", "G0X[40+#1]Z#2"}));
    const bool isRepeated = random_.oneIn(4);
    const std::string code = isRepeated ? "G73" : isTurning ? "G71" : "G72";
    if (!isHaas_ && isRepeated)
      add("G73U" + pick({"3.", "#1", "-2.", "0"}) + "W" + pick({"1.", "#2", "-1.", "0"}) +
          pick({"R3", "R2", "R4", ""}));
    else if (!isHaas_ && !random_.oneIn(4))
      add(code + (isTurning ? "U" : "W") + pick({"1.", "#1", "2."}) + "R" + pick({".5", "1.", "#2"}));
    if (!hasDistanceModes_ || random_.oneIn(3))
      add(fmt::format("{}P{}Q{}{}{}{}F.3", code, first, last, pick({"", "U.4", "U1.", "U-.5"}),
                      pick({"", "W.1", "W.5", "W-.25"}),
                      !isHaas_     ? ""
                      : isRepeated ? pick({"I3.K1.D3", "I#1K0D2", "I-1.K.5D4"})
                                   : "D1."));
    add(fmt::format("N{}G0{}", first, isTurning ? "X" + diameter() : "Z" + along()));
    for (std::uint32_t i = 1 + random_.below(4); i > 0; --i)
      add("G1" + (random_.oneIn(2) ? "X" + diameter() : "Z" + along()) + pick({"", "", "F.1"}));
    if (random_.oneIn(3))
      add(pick({"G2X[20+2*#1]Z-5.R#1", "G3X30.W-2.I0K-2.", "G2U4.W-2.I2.K0"}));
    add(fmt::format("N{}G1{}", last, isTurning ? "X44." : "Z2."));
    if (!random_.oneIn(3))
      add(fmt::format("G70P{}Q{}", first, last));
  }
  /// Compensation of the nose along the axes, round corners and tangent arcs; sizes may be too small for it.
  void nose() {
    if (random_.oneIn(2))
      add(pick({"G18", "T0101", "G18T0303"}));
    add(absolute() + "G0X" + diameter() + "Z" + along());
    if (random_.oneIn(2)) { // a start-up block of its own
      add(pick({"G41", "G42", "G42"}) + "G1" + (random_.oneIn(2) ? "X" + diameter() : "Z" + along()) + "F.2");
    } else {
      add(pick({"G41", "G42", "G42"}));
      add(incremental() + pick({"G0", "G1"}) + by(random_.oneIn(2) ? 'X' : 'Z', pick({"", "-"}) + size()));
    }
    for (std::uint32_t i = 1 + random_.below(5); i > 0; --i) {
      if (random_.oneIn(3))
        add(incremental() + pick({"G2", "G3"}) + by('X', pick({"[", "[0-"}) + "#1*2]") +
            by('Z', pick({"[", "[0-"}) + "#1]") + pick({"R", "R", "I", "K", "I-", "K-"}) + "#1");
      else if (random_.oneIn(8))
        add(random_.oneIn(2) ? "M8" : odd());
      else
        add(incremental() + "G1" + by(random_.oneIn(2) ? 'X' : 'Z', pick({"", "-"}) + size()));
    }
    if (hasDistanceModes_)
      add("G90");
    add(random_.oneIn(6) ? "G40" : "G40" + pick({"G0", "G1"}) + pick({"X50.", "Z5.", "X[40+#1]Z5.", "X60.Z5.T0100"}));
  }
  std::string odd() {
    return pick({"T0101",      "T0100",  "T0202M8",   "G28U0", "G28U0W0",   "G50X20.", "G50S2000", "G54",
                 "G55",        "G4P100", "C90.",      "H90.",  "V1.",       "Y1.",     "#2001=.5", "G10P1X1.",
                 "G97S500",    "G42",    "G40",       "G18",   "G17",       "G20",     "G53X0",    "G1X20.R1.",
                 "G1X20.,R1.", "M98P2",  "G71U2.R1.", "G0T#1", "G32Z-2.F1."});
  }

  Random &random_;
  bool hasDistanceModes_;
  bool isHaas_;
  ProgramLines lines_;
  int label_ = 0;
};

class ClauseWriter {
public:
  ClauseWriter(Random &random, std::string_view name, const geometry::Point<double> &way)
      : random_(random), name_(name) {
    x_ = near(way[0]);
    z_ = near(way[2]);
  }

  OpenClause run() {
    using enum OpenClause::Larger;
    switch (random_.below(9)) {
    case 0: return {fmt::format("(@TRAVEL {})", sides()), Freer};
    case 1: return {fmt::format("(@KEEPOUT {} BOX {})", name_, wall()), Tighter};
    case 2:
    case 3:
    case 4:
      x_ = random_.oneIn(2) ? "20" : x_;
      z_ = random_.oneIn(2) ? "0" : z_;
      return {fmt::format("(@KEEPIN {} {})", name_, shape()), Freer, 0.2};
    default: return {fmt::format("(@KEEPOUT {} {})", name_, shape()), Tighter, 0.2};
    }
  }

private:
  std::string pick(std::initializer_list<const char *> choices) { return random_.of<const char *>(choices); }
  std::string near(double coordinate) {
    const double beside = (static_cast<double>(random_.below(17)) / 8 - 1) * 6;
    return fmt::format("[{}]", std::clamp(std::round((coordinate + beside) * 4) / 4, -100.0, 100.0));
  }
  const std::string &size() {
    if (size_.empty())
      size_ = random_.oneIn(2) ? "[@@]" : "[@@+" + pick({"#1", "#2", "#1/2", "ABS[#1-#2]"}) + "]";
    return size_;
  }
  std::string from(const std::string &centre, const char *factor) {
    return fmt::format("[{}+{}*{}]", centre, size(), factor);
  }
  std::string sides() {
    const std::string x = fmt::format("X{}..{}", from(x_, "-1"), random_.oneIn(4) ? "" : from(x_, "1"));
    const std::string z = fmt::format("Z{}..{}", from(z_, "-1"), random_.oneIn(4) ? "" : from(z_, "1"));
    return random_.oneIn(4) ? (random_.oneIn(2) ? x : z) : x + " " + z;
  }
  std::string wall() {
    const std::string axis = pick({"X", "Z"});
    return random_.oneIn(2) ? fmt::format("{}..{}", axis, size()) : fmt::format("{}[0-{}]..", axis, size());
  }
  std::string corner(const char *x, const char *z) { return fmt::format("X{} Z{}", from(x_, x), from(z_, z)); }
  std::string shape() {
    switch (random_.below(5)) {
    case 0:
    case 1: return "BOX " + sides();
    case 2: return "POLYGON " + corner("-1", "-1") + " / " + corner("0", "1.5") + " / " + corner("1", "-1");
    case 3: // an L
      return "POLYGON " + corner("-1", "-1") + " / " + corner("-1", "2") + " / " + corner(".5", "2") + " / " +
             corner(".5", ".5") + " / " + corner("2", ".5") + " / " + corner("2", "-1");
    default: return "WHERE " + condition();
    }
  }
  std::string condition() {
    const std::string x = fmt::format("[X-{}]", x_), z = fmt::format("[Z-{}]", z_);
    if (random_.oneIn(2))
      return fmt::format("[{0}*{0}/4+{1}*{1} LE {2}*{2}] AND [{2} GE 0]", x, z, size());
    return fmt::format("[ABS{}+ABS{} LE {}]", x, z, size());
  }

  Random &random_;
  std::string_view name_;
  std::string x_, z_, size_;
};

} // namespace

Sample turningProgram(Random &random) {
  const bool hasDistanceModes = random.oneIn(4);
  const char *dialect = hasDistanceModes
                            ? "fanuc-30i-lathe/B"
                            : random.of<const char *>({"fanuc-30i-lathe", "fanuc-30i-lathe", "haas-ngc-lathe"});
  const bool isHaas = std::string_view(dialect) == "haas-ngc-lathe";
  return {dialect, ProgramWriter(random, hasDistanceModes, isHaas).run()};
}

OpenClause openTurningClause(Random &random, std::string_view name, const geometry::Point<double> &way) {
  return ClauseWriter(random, name, way).run();
}

} // namespace feedhold::proof_tests
