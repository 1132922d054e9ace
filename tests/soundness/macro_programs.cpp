#include "soundness/macro_programs.h"

#include "soundness/ngc_programs.h"

#include <fmt/format.h>

namespace feedhold::soundness {

namespace {

class Writer {
public:
  explicit Writer(Random &random) : random_(random) {}

  ProgramLines run() {
    lines_.push_back("O1");
    body(6 + random_.below(14));
    lines_.push_back(random_.oneIn(4) ? "M99" : "M30");
    for (int program = 2; program <= 4; ++program) {
      lines_.push_back(fmt::format("O{}", program));
      inside_ = program;
      body(2 + random_.below(6));
      lines_.push_back(random_.oneIn(8) ? "M99P" + (random_.oneIn(4) ? variable() : label()) : "M99");
    }
    return std::move(lines_);
  }

private:
  void add(std::string line) {
    std::string head;
    if (random_.oneIn(12))
      head = random_.oneIn(4) ? "/2" : "/";
    if (random_.oneIn(5))
      head += "N" + label();
    lines_.push_back(head + std::move(line));
  }
  void body(std::uint32_t blocks) {
    for (std::uint32_t i = 0; i < blocks; ++i)
      block();
  }
  void block() {
    switch (random_.below(22)) {
    case 0:
    case 1:
    case 2:
    case 3:
    case 4: return add(assignment());
    case 5: return add("IF" + condition() + "GOTO" + label());
    case 6: return add("IF" + condition() + "THEN" + assignment());
    case 7: return loop();
    case 8: return countedLoop();
    case 9: return add(random_.oneIn(3) ? "GOTO" + variable() : "GOTO" + label());
    case 10:
    case 11: return add(call());
    case 12: return add(modes());
    case 13: return add(shifts());
    case 14: return add(arcOrCycle());
    case 15: return add(system());
    case 16: return saveAndRestore();
    case 17: return counterUp();
    case 18: return dispatch();
    case 19: return add(random_.oneIn(3) ? oddBlock() : severalAssignments());
    default: return add(motion());
    }
  }

  // ---- expressions ----

  std::string label() { return random_.of<const char *>({"10", "20", "30", "40"}); }
  std::string number() {
    return random_.of<const char *>({"0",   "1",   "2",  "3",    "-1",  "-2.5", ".5",  "1.5",      "0.1", ".001", "10",
                                     "17.", "90.", "45", "100.", "0.3", "7",    "30.", "99999999", "-.1", "20"});
  }
  std::string variable() {
    if (random_.oneIn(25))
      return "#[" + (random_.oneIn(2) ? variable() : random_.oneIn(3) ? nearCell() : expression(1)) + "]";
    if (random_.oneIn(25))
      return random_.of<const char *>({"#5001", "#5002", "#5003", "#4001", "#4003", "#4006", "#4109", "#1000", "#5041",
                                       "#5021", "#5221", "#5061", "#2001", "#0", "#3001", "#5201", "#4014"});
    return random_.of<const char *>(
        {"#1", "#2", "#3", "#4", "#5", "#6", "#7", "#1", "#2", "#3", "#100", "#101", "#500", "#33"});
  }
  /// The number of a variable that stands beside one with a meaning of its own.
  std::string nearCell() {
    return random_.of<const char *>({"5000", "5040", "5220", "5200", "4000", "100", "1", "3000", "2000", "99"}) +
           std::string("+") + random_.of<const char *>({"#1", "#2", "#100", "FIX[#3]", "ABS[#4]", "#10"});
  }
  std::string expression(int depth) {
    if (depth == 0 || random_.oneIn(4))
      return random_.oneIn(2) ? number() : variable();
    switch (random_.below(7)) {
    case 0: return "[" + expression(depth - 1) + "]";
    case 1: return "-" + variable();
    case 2: return function(depth - 1);
    case 3: return "[" + expression(depth - 1) + random_.of<const char *>({" MOD ", "/"}) + expression(depth - 1) + "]";
    default:
      return "[" + expression(depth - 1) +
             random_.of<const char *>({"+", "-", "+", "-", "*", "/", " AND ", " OR ", " XOR "}) +
             expression(depth - 1) + "]";
    }
  }
  std::string function(int depth) {
    if (random_.oneIn(8))
      return "ATAN[" + expression(depth) + "]/[" + expression(depth) + "]";
    if (random_.oneIn(12))
      return "POW[" + expression(depth) + "," + number() + "]";
    return random_.of<const char *>({"SIN", "COS", "TAN", "ASIN", "ACOS", "ATAN", "SQRT", "ABS", "LN", "EXP", "FIX",
                                     "FUP", "ROUND", "FIX", "FUP", "ROUND", "ABS", "BIN", "BCD"}) +
           std::string("[") + expression(depth) + "]";
  }
  std::string relation() {
    if (random_.oneIn(4))
      return variable() + random_.of<const char *>({" EQ #0", " NE #0", " GT #0", " LE #0"});
    return (random_.oneIn(3) ? expression(1) : variable()) + " " +
           random_.of<const char *>({"EQ", "NE", "GT", "GE", "LT", "LE"}) + " " + expression(1);
  }
  std::string condition() {
    if (random_.oneIn(5))
      return "[[" + relation() + "] " + random_.of<const char *>({"AND", "OR", "XOR"}) + " [" + relation() + "]]";
    return random_.oneIn(12) ? "[" + variable() + "]" : "[" + relation() + "]";
  }
  std::string assignment() {
    if (random_.oneIn(6))
      return variable() + "=#0";
    if (random_.oneIn(4))
      return variable() + "=" + variable();
    return variable() + "=" + expression(2);
  }

  // ---- control flow ----

  /// A block that does nothing; jumps arrive there, from outside of the loop, too.
  void loneNumber() {
    if (random_.oneIn(4))
      lines_.push_back("N" + label());
  }

  void loop() {
    if (loops_ == 3)
      return add(assignment());
    ++loops_;
    const int number = random_.oneIn(10) ? 1 : loops_;
    add((random_.oneIn(8) ? std::string() : "WHILE" + condition()) + fmt::format("DO{}", number));
    loneNumber();
    body(1 + random_.below(4));
    loneNumber();
    lines_.push_back(fmt::format("END{}", number));
    --loops_;
  }
  /// A loop that comes to its end, as most do.
  void countedLoop() {
    if (loops_ == 3)
      return add(motion());
    ++loops_;
    const std::string counter = random_.of<const char *>({"#10", "#11", "#12", "#110"});
    const std::string step = random_.of<const char *>({"1", ".5", "2", "0.1", "#7"});
    const std::string other = random_.of<const char *>({"#1", "#2", "#3", "#101"});
    lines_.push_back(counter + "=" + random_.of<const char *>({"0", "1", "#1", "-3"}));
    lines_.push_back(
        fmt::format("WHILE[{} LT {}]DO{}", counter, random_.of<const char *>({"5", "3.5", "#2", "10"}), loops_));
    if (random_.oneIn(2))
      lines_.push_back(other + "=" + other + random_.of<const char *>({"+", "-"}) + step);
    body(random_.below(3));
    lines_.push_back(counter + "=" + counter + "+" + step);
    loneNumber();
    lines_.push_back(fmt::format("END{}", loops_));
    --loops_;
  }
  void counterUp() {
    const std::string name = label();
    const std::string counter = variable();
    lines_.push_back("N" + name + counter + "=" + counter + "+" + number());
    block();
    lines_.push_back("IF[" + counter + " LT " + number() + "]GOTO" + name);
  }
  /// A number is chosen from a few, and decides later where to go.
  void dispatch() {
    const std::string chosen = random_.of<const char *>({"#20", "#21", "#120"});
    lines_.push_back(chosen + "=1");
    lines_.push_back("IF" + condition() + "THEN" + chosen + "=" + random_.of<const char *>({"2", "#0", "3"}));
    block();
    lines_.push_back("IF[" + chosen + " EQ 1]GOTO" + label());
    lines_.push_back("IF[" + chosen + " EQ 2]GOTO" + label());
    if (random_.oneIn(3))
      lines_.push_back("GOTO[" + chosen + "*10]");
  }
  std::string severalAssignments() {
    return assignment() + random_.of<const char *>({" ", ""}) + (random_.oneIn(2) ? assignment() : motion());
  }
  /// What stands in few programs, and ends, leaves or breaks them.
  std::string oddBlock() {
    switch (random_.below(10)) {
    case 0: return random_.of<const char *>({"M99", "M30", "M02", "M00", "M01", "M98", "G65", "M99P#1", "M99P0"});
    case 1: return random_.of<const char *>({"END1", "END2", "DO2", "DO1", "DO4", "END3", "ELSE", "ENDIF"});
    case 2: return random_.of<const char *>({"GOTO0", "GOTO99", "GOTO[#1/0]", "GOTO-1", "GOTO99999999", "GOTO"});
    case 3: return "IF" + condition() + "M99" + (random_.oneIn(2) ? "P" + label() : "");
    case 4: return "IF" + condition() + "THEN" + random_.of<const char *>({"G91", "S900", "G0X#1", "M98P2", ""});
    case 5:
      return random_.of<const char *>({"X", "G", "#1=", "#=1", "X1X2", "G0G1X1", "G90G91", "X#", "X[#1", "#1=[1+"});
    case 6: return "G1X" + operand() + "/Y" + operand();
    case 7: return random_.of<const char *>({"M97P10", "M97P20L2", "M97P#1", "M98P2Q10", "G66.1P2A1", "G66P3L2A#1"});
    case 8: return random_.of<const char *>({"G200", "G200.1X1", "M150", "G65P#1", "G10L50", "G11", "G12.1", "G13.1"});
    default:
      return random_.of<const char *>({"#1=ADP[#2]", "#2=PRM[10]", "DPRNT[X#1[53]]", "SETVN500[ABC]", "#3=[#ABC]",
                                       "#1=#1+1 GOTO10", "WHILE[#1 LT 3]DO1 END1", "#30=30 #[#30]=1"});
    }
  }
  std::string call() {
    const std::string program = random_.oneIn(20)  ? random_.of<const char *>({"9", "#1", "1"})
                                : random_.oneIn(8) ? fmt::format("{}", inside_)
                                                   : fmt::format("{}", 2 + random_.below(3));
    const std::string repeats = random_.oneIn(5)
                                    ? "L" + (random_.oneIn(4) ? "#" + fmt::format("{}", 1 + random_.below(3))
                                                              : random_.of<const char *>({"0", "2", "3", "7"}))
                                    : "";
    switch (random_.below(6)) {
    case 0:
    case 1: return "M98P" + program + repeats;
    case 2: return "G66P" + program + arguments();
    case 3: return "G67";
    default: return "G65P" + program + repeats + arguments();
    }
  }
  std::string arguments() {
    std::string text;
    for (const char letter : {'A', 'B', 'C', 'I', 'J', 'D', 'X', 'Z', 'F', 'K', 'I', 'J'})
      if (random_.oneIn(3))
        text += letter + (random_.oneIn(2)   ? number()
                          : random_.oneIn(3) ? "[" + expression(1) + "]"
                                             : simpleVariable());
    return text;
  }
  std::string simpleVariable() { return random_.of<const char *>({"#1", "#2", "#3", "#4", "#100", "#500", "#0"}); }

  // ---- words ----

  std::string operand() {
    if (random_.oneIn(2))
      return number();
    return random_.oneIn(3) ? "[" + expression(1) + "]" : (random_.oneIn(6) ? "-" : "") + simpleVariable();
  }
  std::string words(std::string_view letters) {
    std::string text;
    for (const char letter : letters)
      if (random_.oneIn(2))
        text += letter + operand();
    return text;
  }
  std::string motion() {
    const std::string code = random_.of<const char *>(
        {"G0", "G1", "", "", "G91", "G90", "G91G1", "G90G0", "G28", "G31", "G53G0", "G4", "G30", "G94", "G40", "G41"});
    if (random_.oneIn(30))
      return code + words("UWCAH");
    return code + words("XYZ") + (random_.oneIn(4) ? words("FSTDH") : "") +
           random_.of<const char *>({"", "", "M3", "M5", "M8"});
  }
  std::string modes() {
    return random_.of<const char *>({"G90",     "G91",      "G17",       "G18",     "G19",       "G20",     "G21",
                                     "G54",     "G55",      "G59",       "G98",     "G99",       "G80",     "G94",
                                     "G95",     "G49",      "G43H1",     "G43H#1",  "G15",       "G16",     "G54.1P1",
                                     "G54.1P2", "G54P2",    "G54X1P1",   "G96S100", "G97",       "G0",      "G1",
                                     "M3S500",  "F100",     "F#2",       "S#3",     "T#1",       "G#1",     "G[#100]",
                                     "M#2",     "G54.1P#2", "G43H2Z1.",  "G44H1",   "G90G17G54", "G112",    "G96",
                                     "G92S500", "T0101",    "G40G49G80", "G94F#3",  "G113",      "G43.4H1", "G7.1C9"});
  }
  std::string shifts() {
    return random_.of<const char *>({"G92",    "G52",     "G92",      "G52",      "G68",      "G51.1",
                                     "G51",    "G10L2P1", "G10L2P#1", "G10L12P1", "G10L20P1", "G10L20P2",
                                     "G92.1",  "G69",     "G50.1",    "G50",      "G51.1",    "G51I2J2",
                                     "G51P.5", "G68",     "G68.2",    "G69",      "G22",      "G27"}) +
           words("XYZ") + (random_.oneIn(3) ? "R" + operand() : "") + (random_.oneIn(6) ? "P" + number() : "");
  }
  std::string arcOrCycle() {
    if (random_.oneIn(2))
      return random_.of<const char *>({"G2", "G3", "G17G2", "G18G3"}) + words("XYZ") +
             (random_.oneIn(2) ? "R" + operand() : words("IJK"));
    return random_.of<const char *>(
               {"G81", "G83", "G73", "G82", "G98G81", "G99G81", "G91G81", "G85", "G76", "G87", "G88"}) +
           words("XYZRQ") + (random_.oneIn(5) ? random_.of<const char *>({"K2", "K0", "K#1", "L3"}) : "");
  }
  std::string system() {
    return random_.of<const char *>(
        {"#3000=1(STOP)", "#3000=#1",     "#5221=#1",      "#5222=[#5222+1]", "#5201=.5",       "#7001=#1",
         "#14003=.5",     "#[7000+#1]=2", "#2001=#2",      "#3003=0",         "#3006=1",        "#1100=1",
         "#3901=#3",      "#[#1]=5",      "#[#1+100]=#2",  "#[99+#3]=#0",     "#3000=#0",       "#4001=1",
         "#5001=0",       "#1=#3012",     "#[5220+#1]=.5", "#[5200+#2]=#3",   "#[#1]=#[#2]",    "#[#100+3000]=1",
         "#33=#[33]",     "#5061=1",      "#1=#5043",      "#2=#5061",        "#3=#5002-#5022", "#149=#1",
         "#0=1"});
  }
  void saveAndRestore() {
    const std::string group = random_.of<const char *>({"4001", "4002", "4003", "4006", "4014", "4010"});
    const std::string keep = random_.of<const char *>({"#31", "#32", "#105"});
    add(keep + "=#" + group);
    block();
    block();
    add("G" + keep);
    if (random_.oneIn(2))
      add(motion());
  }

  Random &random_;
  ProgramLines lines_;
  int loops_ = 0;
  int inside_ = 1;
};

} // namespace

std::uint64_t Random::next() {
  std::uint64_t mixed = state_ += 0x9E3779B97F4A7C15ULL;
  mixed = (mixed ^ (mixed >> 30)) * 0xBF58476D1CE4E5B9ULL;
  mixed = (mixed ^ (mixed >> 27)) * 0x94D049BB133111EBULL;
  return mixed ^ (mixed >> 31);
}

Sample macroSample(Random &random) {
  std::string_view dialect =
      random.of<std::string_view>({"fanuc-30i", "fanuc-30i", "fanuc-30i", "fanuc-30i", "fanuc-0i", "haas-ngc",
                                   "haas-classic", "mitsubishi-m700", "fanuc-30i-lathe", "linuxcnc", "linuxcnc"});
  if (dialect == "fanuc-30i-lathe")
    dialect = random.of<std::string_view>({"fanuc-30i-lathe", "fanuc-30i-lathe/B", "fanuc-30i-lathe/C"});
  return {dialect, dialect == "linuxcnc" ? ngcProgram(random) : Writer(random).run()};
}

std::string textOf(const ProgramLines &lines) {
  std::string text = "%\n";
  for (const std::string &line : lines)
    text += line + "\n";
  return text + "%\n";
}

double anyInput(Random &random) {
  switch (random.below(4)) {
  case 0: return random.of({0.0, 1.0, 2.0, 3.0, 10.0, 20.0, -1.0, 30.0});
  case 1: return random.of({0.1, 0.3, -0.1, 0.001, 12.345, -2.5, 0.5, 1e-9});
  case 2: return static_cast<double>(random.below(2000)) - 1000;
  default: return (static_cast<double>(random.below(2'000'000)) - 1e6) / 1000;
  }
}

} // namespace feedhold::soundness
