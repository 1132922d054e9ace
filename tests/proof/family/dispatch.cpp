// Computed jumps: to blocks that are there, to blocks that are not, and round in circles.
#include "proof/family/draft.h"

#include <fmt/format.h>

namespace feedhold::proof_tests {

namespace {

/// GOTO of a number of a range, with blocks N1 to N5.
void addJumps(Family &family) {
  struct Jump {
    std::string_view target;
    double low;
    double high;
    bool found;
    double bad;
  };
  const Jump rows[] = {
      {"#1", 1, 5, true, 0},
      {"#1", 1, 6, false, 6},
      {"#1", 0, 5, false, 0},
      {"[#1+1]", 0, 4, true, 0},
      {"[#1+1]", 0, 5, false, 5},
      {"[#1*2]", 1, 2, true, 0},
      {"[#1*2]", 1, 3, false, 3},
      {"[6-#1]", 1, 5, true, 0},
      {"FUP[#1/2]", 1, 10, true, 0},
      {"FUP[#1/2]", 1, 11, false, 11},
      {"[1+#1MOD5]", 0, 90, true, 0},
      {"[1+#1MOD6]", 0, 90, false, 5},
      {"[1+FIX[#1/20]]", 0, 99, true, 0},
      {"ABS[#1]", -5, -1, true, 0},
  };
  for (const Jump &row : rows) {
    Draft draft(fmt::format("jump {} of {}..{}", row.target, row.low, row.high));
    draft.promised({1, row.low, row.high, ArgumentKind::Whole});
    draft.line(fmt::format("N50GOTO{}", row.target));
    draft.lines({"N1#2=1", "GOTO99", "N2#2=2", "GOTO99", "N3#2=3", "GOTO99", "N4#2=4", "GOTO99", "N5#2=5",
                 "N99IF[#2EQ#0]GOTO91", "IF[#2GT5]GOTO91", "GOTO100", "N91#3000=1(NO CHOICE)", "N100"});
    draft.proved("program-ends").proved("alarm-unreachable.N91");
    if (row.found)
      draft.proved("no-control-alarm.N50");
    else
      draft.refuted("no-control-alarm.N50", {{1, row.bad}});
    family.push_back(draft.done());
  }
}

/// Guards in front of the jump.
void addGuardedJumps(Family &family) {
  struct Guard {
    std::string_view blocks;
    bool safe;
    Inputs bad;
  };
  const Guard rows[] = {
      {"IF[[#1NE1]AND[#1NE2]]GOTO91", true, {}},
      {"IF[#1EQ1]GOTO1\nIF[#1EQ2]GOTO2\nGOTO91", true, {}},
      {"IF[#1LT1]GOTO91\nIF[#1GT2]GOTO91\n#1=FIX[#1]", true, {}},
      {"IF[#1LT1]GOTO91\n#1=FIX[#1]", false, {{1, 3}}},
      {"IF[#1GT2]GOTO91\n#1=FIX[#1]", false, {{1, -4}}},
      {"#1=1+FIX[ABS[#1]]MOD2", true, {}},
      {"IF[#1NE1]THEN#1=2", true, {}},
      {"IF[#1EQ#0]THEN#1=1\nIF[#1NE1]GOTO91", true, {}},
  };
  for (const Guard &row : rows) {
    Draft draft(fmt::format("guarded jump: {}", row.blocks));
    draft.free(1).line(row.blocks);
    draft.lines({"N50GOTO#1", "N1#2=1", "GOTO99", "N2#2=2", "GOTO99", "N91#3000=1(NO CHOICE)", "N99"});
    if (row.safe)
      draft.proved("no-control-alarm.N50").proved("program-ends");
    else
      draft.refuted("no-control-alarm.N50", row.bad);
    family.push_back(draft.done());
  }
}

/// A table of states: each block names the next one.
void addStates(Family &family) {
  struct States {
    std::string_view first;
    std::string_view second;
    std::string_view third;
    bool ends;
  };
  const States rows[] = {
      {"#2=2", "#2=3", "#2=9", true},
      {"#2=2", "#2=3", "#2=1", false},
      {"#2=3", "#2=9", "#2=2", true},
      {"#2=2", "#2=1", "#2=9", false},
      {"#2=2", "#1=#1-1\n#2=3", "#2=1\nIF[#1LE0]THEN#2=9", true},
      {"#2=2", "#1=#1+1\n#2=3", "#2=1\nIF[#1LE0]THEN#2=9", false},
      {"#2=2\nIF[#1GT5]THEN#2=3", "#2=9", "#2=9", true},
  };
  for (const States &row : rows) {
    Draft draft(fmt::format("states: {} / {} / {}", row.first, row.second, row.third));
    draft.promised({1, 1, 20, ArgumentKind::Whole}).line("#2=1").line("N50GOTO#2");
    draft.line("N1").line(row.first).line("GOTO50").line("N2").line(row.second).line("GOTO50");
    draft.line("N3").line(row.third).line("GOTO50").line("N9");
    if (row.ends)
      draft.proved("program-ends").proved("no-control-alarm.N50");
    else
      draft.refuted("program-ends", {{1, 1}});
    family.push_back(draft.done());
  }
}

} // namespace

void addDispatch(Family &family) {
  addJumps(family);
  addGuardedJumps(family);
  addStates(family);
}

} // namespace feedhold::proof_tests
