#include "proof/short_programs.h"

#include <fmt/format.h>

namespace feedhold::proof_tests {

using soundness::EntryValues;
using soundness::LoadedSample;
using soundness::ProgramLines;
using soundness::Random;
using soundness::Sample;

namespace {

class Writer {
public:
  explicit Writer(Random &random) : random_(random) {}

  ProgramLines run() {
    add("O1");
    if (random_.oneIn(2))
      contract();
    for (std::uint32_t i = random_.below(3); i > 0; --i)
      guard();
    for (std::uint32_t i = 1 + random_.below(2); i > 0; --i)
      part();
    if (random_.oneIn(3))
      add(statement());
    add(pick({"M30", "M99"}));
    if (guarded_)
      add("N9001#3000=101(NOT ALLOWED)");
    if (called_)
      called();
    if (random_.oneIn(3))
      damage();
    return std::move(lines_);
  }

private:
  void add(std::string line) { lines_.push_back(std::move(line)); }
  std::string pick(std::initializer_list<const char *> choices) { return random_.of<const char *>(choices); }
  std::uint32_t nextLabel() { return label_ += 10; }

  // ---- words ----

  std::string input() { return pick({"#1", "#2", "#3", "#1", "#2", "#500"}); }
  std::string local() { return pick({"#1", "#2", "#3", "#10", "#11", "#12", "#100"}); }
  std::string number() { return pick({"0", "1", "2", "3", "5", "10", ".5", "1.5", "-1", "-2", ".125"}); }
  std::string value() {
    switch (random_.below(9)) {
    case 0: return "FIX[" + input() + "]";
    case 1: return "ABS[" + input() + "]";
    case 2: return "[" + local() + pick({"+", "-"}) + number() + "]";
    case 3: return "[" + local() + "*" + pick({"2", ".5", "-1", "#2"}) + "]";
    case 4: return pick({"FUP[", "FIX[", "ROUND["}) + local() + "/" + pick({"2", "4", "#2", "#3"}) + "]";
    case 5:
    case 6: return number();
    default: return local();
    }
  }
  std::string relation() { return pick({" EQ ", " NE ", " GT ", " GE ", " LT ", " LE "}); }
  std::string comparison() {
    if (random_.oneIn(8))
      return "[" + input() + pick({" EQ #0]", " NE #0]"});
    return "[" + local() + relation() + (random_.oneIn(2) ? number() : value()) + "]";
  }
  std::string condition() {
    if (random_.oneIn(6))
      return "[" + comparison() + pick({" AND ", " OR "}) + comparison() + "]";
    return comparison();
  }

  // ---- contracts and guards ----

  void contract() {
    for (const char *variable : {"#1", "#2", "#3"})
      if (!random_.oneIn(4))
        add(fmt::format("(@PARAM {} {}{}{})", variable,
                        pick({"0..6", "1..5", ".5..4", "-2..3", "..5", "1..", "0...5", "IN 1,2,3"}),
                        random_.oneIn(4) ? " INT" : "", random_.oneIn(6) ? " OPTIONAL" : ""));
    if (random_.oneIn(3))
      add("(@GLOBAL #500 " + pick({"0..4", "-3..3", "1..2"}) + ")");
    if (random_.oneIn(3))
      add("(@REQUIRE " + pick({"#1 LE #2", "#2 GT #3", "[#1+#2] GE 1", "#3 NE 0", "[#1 NE #2] AND [#3 LT 4]"}) + ")");
    if (random_.oneIn(3))
      add("(@ENSURE " +
          pick({"#100 GE 0", "#100 EQ #10", "#10 GE #1", "#10 LE #2", "#500 EQ OLD[#500]", "#11 EQ OLD[#1]",
                "POS[X] EQ ENTRY[X]", "MODAL PRESERVED", "[#10 GE #2] OR [#1 LT 0]", "#10 NE #0", "G90"}) +
          ")");
    if (random_.oneIn(4))
      add("(@ASSIGNS " + pick({"NOTHING", "#100", "#100..#120", "#500"}) + ")");
    if (random_.oneIn(3))
      add("(@ALARM " + pick({"101", "3", "7"}) + pick({" IF ", " IFF "}) +
          pick({"#1 LE 0", "#2 EQ #0", "#1 GT #2", "#3 LT 1", "[#1 LE 0] OR [#2 LE 0]"}) + ")");
    if (random_.oneIn(4))
      add("(@GUARDED)");
  }
  void guard() {
    if (random_.oneIn(3))
      return add("IF" + condition() + "THEN#3000=" + pick({"3(LIMIT)", "7(STEP)"}));
    if (random_.oneIn(4))
      return add("IF[" + input() + " EQ #0]THEN" + input() + "=" + number());
    guarded_ = true;
    add("IF[" + input() + pick({" LE 0", " EQ #0", " LT 1", " GT 5", " GT #2", " LT 0"}) + "]GOTO9001");
  }

  // ---- statements ----

  std::string statement() {
    switch (random_.below(12)) {
    case 0: return "IF" + condition() + "THEN#3000=" + pick({"3(LIMIT)", "7(STEP)"});
    case 1: return "#5=[" + input() + "/" + local() + "]";
    case 2: return "#6=SQRT[" + local() + pick({"-", "+"}) + value() + "]";
    case 3: return pick({"G1X[", "G0Z-[", "G91G1X["}) + local() + "]";
    case 4: return "#100=#100" + pick({"+1", "-1", "+#1"});
    case 5: called_ = true; return pick({"G65P2A#10", "M98P2", "G65P2A[#1]B#2", "M98P2L2", "G65P2L3A1", "M98P2L#1"});
    case 6: return "IF" + condition() + "THEN" + local() + "=" + value();
    case 7: return pick({"G90", "G91", "G17", "G0", "G98"});
    case 8: return "#13=ASIN[" + local() + "/" + pick({"4", "#2"}) + "]";
    case 9: return "IF" + condition() + "GOTO" + fmt::format("{}", 10 * (1 + random_.below(4)));
    case 10: return "#[100+" + local() + "]=" + number();
    default: return local() + "=" + value();
    }
  }
  void part() {
    if (random_.oneIn(8))
      return dispatch();
    if (loops_ > 0 && random_.oneIn(3))
      return add(statement());
    loop();
  }
  /// Where to go is computed.
  void dispatch() {
    const std::uint32_t label = nextLabel();
    add("GOTO[" + pick({"#1", "#10", "FIX[#2]"}) + fmt::format("*{}]", label));
    add(statement());
    add(fmt::format("N{}", label) + statement());
    add(fmt::format("N{}", label * 2) + statement());
  }

  // ---- loops ----

  void loop() {
    switch (random_.below(10)) {
    case 0: return halving();
    case 1: return phases();
    case 2: return lexicographic();
    case 3: return remainders();
    case 4: return anyLoop();
    default: return counted();
    }
  }
  std::string counter() { return depth_ == 0 ? pick({"#10", "#11"}) : "#12"; }
  std::string start() { return pick({"0", "1", "#1", "#2", "FIX[#1]", "ABS[#3]", "-3", "FUP[#1/#2]", "#500"}); }
  std::string bound() { return pick({"5", "3.5", "#1", "#2", "10", "FIX[#2]", "0", "[#1*2]", "#500"}); }
  std::string step() {
    return pick({"1", "1", ".5", "2", ".125", "#3", "#2", "ABS[#3]", "[#3*#3]", "FIX[#3]", "#500", "[#1-#2]"});
  }
  void counted() {
    const std::string name = counter();
    const bool up = random_.oneIn(2);
    const std::string limit = bound();
    const std::string next = name + "=" + name + (up ? "+" : "-") + step();
    std::string compared = up ? pick({" LT ", " LE ", " NE ", " LT "}) : pick({" GT ", " GE ", " NE ", " GT "});
    if (random_.oneIn(10))
      compared = relation();
    if (!random_.oneIn(8))
      add(name + "=" + start());
    const std::string goesOn = random_.oneIn(6)
                                   ? "[[" + name + compared + limit + "]" + pick({"AND", "OR"}) + comparison() + "]"
                                   : "[" + name + compared + limit + "]";
    const std::string clamp =
        random_.oneIn(5) ? "IF[" + name + (up ? " GT " : " LT ") + limit + "]THEN" + name + "=" + limit : "";
    around(goesOn, next, clamp);
  }
  /// The loop by WHILE, by a jump at its end, or by a jump back to a test.
  void around(const std::string &goesOn, const std::string &next, const std::string &behind) {
    const auto inside = [&] {
      ++depth_;
      ++loops_;
      const bool early = random_.oneIn(5);
      if (early)
        add(next);
      for (std::uint32_t i = random_.below(3); i > 0; --i)
        depth_ < 2 && random_.oneIn(6) ? loop() : add(statement());
      if (!early)
        add(next);
      if (!behind.empty())
        add(behind);
      --depth_;
    };
    const std::uint32_t label = nextLabel();
    switch (random_.below(4)) {
    case 0:
      add(fmt::format("N{}", label));
      inside();
      return add("IF" + goesOn + fmt::format("GOTO{}", label));
    case 1: {
      const std::uint32_t out = nextLabel();
      add(fmt::format("N{}IF", label) + goesOn + fmt::format("GOTO{}", out));
      add(fmt::format("GOTO{}", out + 1));
      add(fmt::format("N{}", out));
      inside();
      add(fmt::format("GOTO{}", label));
      return add(fmt::format("N{}", out + 1));
    }
    default:
      add("WHILE" + goesOn + fmt::format("DO{}", depth_ + 1));
      const std::uint32_t number = depth_ + 1;
      inside();
      add(fmt::format("END{}", number));
    }
  }
  void halving() {
    const std::string name = counter();
    add(name + "=" + start());
    around("[" + name + pick({" GT 1]", " GT 0]", " GE 1]", " NE 0]"}),
           name + "=" + pick({"FIX[", "ROUND[", "["}) + name + pick({"/2]", "*.5]", "/4]"}), "");
  }
  void phases() {
    const std::string name = counter();
    add(name + "=" + start());
    around("[" + name + pick({" GT 0]", " GE #1]"}), name + "=" + name + "+#14",
           "#14=#14-" + pick({"1", ".5", "#3", "0"}));
  }
  void lexicographic() {
    const std::string name = counter();
    add(name + "=" + start());
    around("[" + name + " GT 0]", "IF[#15 GT 0]THEN" + pick({"#15=#15-1", "#15=#15-#3", "#10=#10-1"}),
           "IF[#15 LE 0]THEN" + pick({"", "#16=1 "}) + name + "=" + name + "-1");
    add("#15=" + bound());
  }
  void remainders() {
    add("#10=" + start());
    add("#11=" + bound());
    around("[#11 " + pick({"GT", "NE"}) + " 0]", "#12=[#10 MOD #11]", "#10=#11");
    add("#11=#12");
  }
  void anyLoop() {
    const std::string name = local();
    around(condition(), name + "=" + value(), random_.oneIn(2) ? statement() : "");
  }

  // ---- the rest ----

  void called() {
    add("O2");
    for (std::uint32_t i = 1 + random_.below(2); i > 0; --i)
      add(random_.oneIn(5) ? "IF" + condition() + pick({"M99", "GOTO50"}) : statement());
    if (random_.oneIn(4))
      counted();
    add(pick({"M99", "M99", "M99", "M99P10", "M30"}));
  }
  /// As a slip would: a block is left out, comes twice, or changes its place.
  void damage() {
    const auto at = [&] { return lines_.begin() + 1 + random_.below(static_cast<std::uint32_t>(lines_.size() - 1)); };
    switch (random_.below(3)) {
    case 0: lines_.erase(at()); break;
    case 1: std::iter_swap(at(), at()); break;
    default: {
      const std::string line = *at();
      lines_.insert(at(), line);
    }
    }
  }

  Random &random_;
  ProgramLines lines_;
  std::uint32_t label_ = 0;
  std::uint32_t depth_ = 0;
  int loops_ = 0;
  bool guarded_ = false;
  bool called_ = false;
};

} // namespace

Sample shortSample(Random &random) {
  const std::string_view dialect = random.of<std::string_view>(
      {"fanuc-30i", "fanuc-30i", "fanuc-30i", "fanuc-30i", "fanuc-0i", "haas-ngc", "mitsubishi-m700"});
  return {dialect, Writer(random).run()};
}

EntryValues shortEntry(const LoadedSample &machine, Random &random) {
  EntryValues entry = soundness::randomEntry(machine, random);
  const bool vacancy = machine.dialect().behaviour.variablesMayBeVacant;
  const auto value = [&] {
    if (random.oneIn(8))
      return vacancy ? ConcreteValue{} : ConcreteValue::of(0);
    if (random.oneIn(3))
      return ConcreteValue::of((static_cast<double>(random.below(80)) - 20) / 8);
    return ConcreteValue::of(static_cast<double>(random.below(9)) - 2);
  };
  for (const std::uint32_t variable : {1, 2, 3, 10, 11, 12, 14, 15, 100, 101, 102, 500}) {
    entry.given.set(variable, value());
    if (variable <= kLocalVariables)
      entry.state.locals[variable] = *entry.given.find(variable);
    else if (entry.state.variables.find(variable))
      entry.state.variables.set(variable, *entry.given.find(variable));
  }
  return entry;
}

} // namespace feedhold::proof_tests
