#include "proof/table_programs.h"

#include "proof/short_programs.h"

#include <fmt/format.h>

namespace feedhold::proof_tests {

using soundness::EntryValues;
using soundness::LoadedSample;
using soundness::ProgramLines;
using soundness::Random;
using soundness::Sample;

namespace {

class TableWriter {
public:
  explicit TableWriter(Random &random) : random_(random) {}

  ProgramLines run() {
    add("O1");
    contract();
    if (random_.oneIn(4))
      add("IF[" + pointer() + pick({" LT 500]", " GT 520]", " LT 100]"}) + "GOTO9001");
    for (std::uint32_t i = 1 + random_.below(3); i > 0; --i)
      random_.oneIn(3) ? loop() : statement();
    for (std::uint32_t i = 1 + random_.below(3); i > 0; --i)
      check();
    add("N9001M99");
    if (called_)
      called();
    return std::move(lines_);
  }

private:
  void add(std::string line) { lines_.push_back(std::move(line)); }
  std::string pick(std::initializer_list<const char *> choices) { return random_.of<const char *>(choices); }

  void contract() {
    add("(@PARAM #1 " +
        pick({"500..509 INT", "500..503 INT", "500..540 INT", "501..502 INT", "500..509", "498..505 INT", "10..14 INT",
              "100..120 INT", "1..6 INT"}) +
        ")");
    add("(@PARAM #2 " + pick({"0..3 INT", "0..1", "1..2 INT", "0..12 INT", "-1..1 INT"}) + ")");
    if (random_.oneIn(2))
      add("(@PARAM #3 " + pick({"500..509 INT", "504..512 INT", "505..506 INT", "100..103 INT"}) + ")");
    if (random_.oneIn(4))
      add("(@ASSIGNS " + pick({"#500..#509", "#500..#560", "#100..#130", "#501"}) + ")");
    if (random_.oneIn(4))
      add("(@ENSURE " + pick({"#505 EQ OLD[#505]", "#520 EQ OLD[#520]", "#100 EQ OLD[#100]", "#501 GE 0"}) + ")");
    if (random_.oneIn(4))
      add("(@REQUIRE " + pick({"#1 LT #3", "#1 NE #3", "#2 GT 0"}) + ")");
  }

  // ---- words ----

  std::string pointer() { return pick({"#1", "#1", "#3", "#20"}); }
  std::string index() {
    return pick({"#1", "#1", "#1+1", "#1+#2", "#3", "#20", "#20", "#20+1", "500+#2", "502+#2*2", "100+#2", "10+#2",
                 "#1-1", "#21", "#[#1]", "#1/2", "519-#2"});
  }
  std::string cell() {
    return random_.oneIn(3) ? pick({"#500", "#501", "#502", "#505", "#510", "#11", "#12", "#100", "#101"})
                            : "#[" + index() + "]";
  }
  std::string value() {
    switch (random_.below(6)) {
    case 0: return pick({"0", "1", "2", "7", "-1", ".5", "#0", "501", "503"});
    case 1: return cell() + pick({"+1", "-1", "*2", "+#2"});
    case 2: return pick({"#2", "#1", "#22", "#23"});
    default: return cell();
    }
  }
  std::string relation() { return pick({" EQ ", " NE ", " LT ", " GE "}); }

  // ---- statements ----

  void statement() {
    switch (random_.below(10)) {
    case 0: return add("#20=" + pick({"#1", "500", "#1+1", "#3", "501", "100"}));
    case 1: return add(pick({"#22=", "#23="}) + value());
    case 2: return add("IF[" + cell() + relation() + value() + "]THEN" + cell() + "=" + value());
    case 3: return add("IF[" + cell() + relation() + value() + "]GOTO9001");
    case 4: return add("IF[" + cell() + " EQ #0]THEN" + cell() + "=" + value());
    case 5: called_ = true; return add(pick({"G65P2A#1B#2", "G65P2A500B3", "G65P2A[#1+1]B#3", "M98P2", "G65P2A10B1"}));
    default: return add(cell() + "=" + value());
    }
  }
  void check() {
    if (random_.oneIn(3)) {
      const std::string at = index();
      add("#[" + at + "]=" + pick({"5", "#2", "#22"}));
      if (random_.oneIn(2))
        add("#[" + index() + "]=" + pick({"6", "#0"}));
      return add("IF[#[" + at + "] NE 5]THEN#3000=4(READ BACK)");
    }
    if (random_.oneIn(3)) {
      const std::string at = cell();
      add("#24=" + at);
      statement();
      return add("IF[#24 NE " + at + "]THEN#3000=5(CHANGED)");
    }
    add("IF[" + cell() + relation() + value() + "]THEN#3000=6(COMPARED)");
  }
  void loop() {
    ++depth_;
    const std::string counter = depth_ == 1 ? "#20" : "#21";
    add(counter + "=" + pick({"500", "#1", "0", "100", "10", "#1+1"}));
    add("WHILE[" + counter + pick({" LE ", " LT ", " LE "}) +
        pick({"519", "#1+5", "510", "#3", "5", "105", "14", "509"}) + fmt::format("]DO{}", depth_));
    for (std::uint32_t i = 1 + random_.below(2); i > 0; --i)
      if (depth_ < 2 && random_.oneIn(12))
        loop();
      else if (random_.oneIn(2))
        add("#[" + counter + pick({"", "", "+1", "+500", "+#2"}) + "]=" + value());
      else
        statement();
    add(counter + "=" + counter + pick({"+1", "+1", "+2", "+#2", "+.5"}));
    add(fmt::format("END{}", depth_));
    --depth_;
  }
  void called() {
    add("O2");
    for (std::uint32_t i = 1 + random_.below(3); i > 0; --i)
      switch (random_.below(4)) {
      case 0: add("#[#1]=" + pick({"#2", "0", "#[#1+1]"})); break;
      case 1: add("#[#1+#2]=#[#1]"); break;
      case 2: add("IF[#[#1] EQ #0]THEN#[#1]=" + pick({"1", "#2"})); break;
      default: add("#501=#[#1]+1");
      }
    add("M99");
  }

  Random &random_;
  ProgramLines lines_;
  int depth_ = 0;
  bool called_ = false;
};

} // namespace

Sample tableSample(Random &random) {
  const std::string_view dialect =
      random.of<std::string_view>({"fanuc-30i", "fanuc-30i", "fanuc-0i", "haas-ngc", "mitsubishi-m700"});
  return {dialect, TableWriter(random).run()};
}

EntryValues tableEntry(const LoadedSample &machine, Random &random) {
  EntryValues entry = shortEntry(machine, random);
  const auto set = [&](std::uint32_t variable, ConcreteValue value) {
    entry.given.set(variable, value);
    if (variable <= kLocalVariables)
      entry.state.locals[variable] = value;
    else if (entry.state.variables.find(variable))
      entry.state.variables.set(variable, value);
  };
  for (std::uint32_t variable = 498; variable <= 522; ++variable)
    if (!random.oneIn(4))
      set(variable, ConcreteValue::of(static_cast<double>(random.below(4)) + (random.oneIn(6) ? 500 : 0)));
  for (const std::uint32_t pointer : {1, 3})
    if (random.oneIn(2))
      set(pointer, ConcreteValue::of(500 + static_cast<double>(random.below(12))));
  return entry;
}

} // namespace feedhold::proof_tests
