// Loops whose step is an argument, is cut at the end, depends on a condition, or shrinks with what is left.
#include "proof/family/draft.h"

#include <fmt/format.h>

namespace feedhold::proof_tests {

namespace {

/// The step is an argument, and its range decides whether it may be 0, negative or missing.
void addArgumentSteps(Family &family, Draw &draw) {
  struct StepRange {
    double low;
    double high;
    Presence presence;
    bool good;
    Inputs bad;
  };
  const StepRange ranges[] = {{.1, 20, Presence::Given, true, {}},
                              {.001, 5, Presence::Given, true, {}},
                              {0, 20, Presence::Given, false, {{21, 8}, {22, 0}}},
                              {-1, 4, Presence::Given, false, {{21, 8}, {22, -1}}},
                              {1, 4, Presence::Optional, false, {{21, 8}}}};
  for (const StepRange &range : ranges)
    for (const bool down : {false, true})
      for (const bool clamped : {false, true}) {
        Draft draft(fmt::format("step {}..{}, {}, {}", range.low, range.high, down, clamped));
        draft.promised({21, .5, draw.of({50., 200.})})
            .promised({22, range.low, range.high, ArgumentKind::Real, range.presence});
        if (down)
          draft.lines({"#10=#21", "N20WHILE[#10GT0]DO1", "#10=#10-#22"});
        else
          draft.lines({"#10=0", "N20IF[#10GE#21]GOTO40", "#10=#10+#22"});
        if (clamped)
          draft.line(down ? "IF[#10LT0]THEN#10=0" : "IF[#10GT#21]THEN#10=#21");
        draft.line(down ? "END1" : "GOTO20")
            .lines(
                {"N40", down ? "IF[#10NE0]GOTO91" : "IF[#10NE#21]GOTO91", "GOTO99", "N91#3000=1(NOT AT DEPTH)", "N99"});
        if (!range.good)
          draft.refuted("loop-ends.N20", range.bad).refuted("program-ends", range.bad);
        else
          draft.proved("loop-ends.N20").proved("program-ends");
        if (clamped)
          draft.proved("alarm-unreachable.N91");
        else if (range.good)
          draft.refuted("alarm-unreachable.N91", {{21, 1}, {22, .75}});
        if (range.low >= 1 && !clamped)
          draft.refuted("alarm-unreachable.N91", {{21, 1}, {22, 2}});
        family.push_back(draft.done());
      }
}

/// Equal passes: the step is a length divided by a whole number of passes.
void addEqualPasses(Family &family, Draw &draw) {
  for (const std::string_view function : {"FUP", "FIX"})
    for (const bool safe : {true, false}) {
      const double high = draw.of({20., 100.});
      Draft draft(fmt::format("equal passes, {} {}", function, safe));
      draft.promised({21, .5, 200}).promised({22, safe ? .1 : 0, high});
      draft.lines({fmt::format("N10#1={}[#21/#22]", function), "IF[#1LT1]THEN#1=1", "N15#2=#21/#1", "#3=0", "#4=0",
                   "N20WHILE[#3LT#1]DO1", "#4=#4+#2", "#3=#3+1", "END1"});
      draft.proved("loop-ends.N20").proved("no-control-alarm.N15");
      if (safe)
        draft.proved("no-control-alarm.N10");
      else
        draft.refuted("no-control-alarm.N10", {{21, 1}, {22, 0}});
      family.push_back(draft.done());
    }
}

/// One of two steps, chosen by a condition of the program or by an input.
void addConditionalSteps(Family &family, Draw &draw) {
  struct Choice {
    std::string_view condition;
    std::string_view then;
    std::string_view otherwise;
    bool ends;
    Inputs bad;
  };
  const Choice choices[] = {
      {"[#1LT10]", "#1=#1+1", "#1=#1+3", true, {}},
      {"[#1LT10]", "#1=#1+.5", "#1=#1+.25", true, {}},
      {"[#1000EQ1]", "#1=#1+1", "#1=#1+2", true, {}},
      {"[#502GT0]", "#1=#1+1", "#1=#1+.5", true, {}},
      {"[#502GT0]", "#1=#1+1", "#2=#2+1", false, {{501, 20}, {502, 0}}},
      {"[#502EQ#0]", "#2=1", "#1=#1+1", false, {{501, 20}}},
      {"[#1GE15]", "#2=#2+1", "#1=#1+1", false, {{501, 20}}},
      {"[#1EQ7]", "#1=3", "#1=#1+1", false, {{501, 20}}},
      {"[#1EQ7]", "#1=9", "#1=#1+1", true, {}},
      {"[#1032GT5]", "#1=#1+1", "#1=#1+4", true, {}},
  };
  for (const Choice &choice : choices)
    for (const bool asGoto : {false, true}) {
      Draft draft(fmt::format("conditional step {} {} {} {}", choice.condition, choice.then, choice.otherwise, asGoto));
      draft.promised({501, 16, draw.of({30., 80.})}).free(502).lines({"#1=0", "#2=0"});
      draft.line(asGoto ? "N20IF[#1GE#501]GOTO50" : "N20WHILE[#1LT#501]DO1")
          .line(fmt::format("IF{}GOTO30", choice.condition))
          .line(choice.otherwise)
          .line("GOTO40")
          .line(fmt::format("N30{}", choice.then))
          .line(asGoto ? "N40GOTO20" : "N40END1")
          .line("N50");
      if (choice.ends)
        draft.proved("loop-ends.N20").proved("program-ends");
      else
        draft.refuted("loop-ends.N20", choice.bad).refuted("program-ends", choice.bad);
      family.push_back(draft.done());
    }
}

/// What is left is halved, cut to whole numbers, or reduced by a root.
void addShrinking(Family &family, Draw &draw) {
  struct Shrinking {
    std::string_view guard;
    std::string_view pass;
    bool ends;
    double bad;
  };
  const Shrinking rows[] = {
      {"[#1GT0]", "#1=FIX[#1/2]", true, 0},      {"[#1GE1]", "#1=FIX[#1/3]", true, 0},
      {"[#1GT0]", "#1=FUP[#1/2]", false, 1},     {"[#1GT0]", "#1=FUP[#1/4]", false, 1},
      {"[#1GE1]", "#1=ROUND[#1/2]", false, 1},   {"[#1GT1]", "#1=FUP[#1/2]", true, 0},
      {"[#1GT0]", "#1=#1-FUP[#1/2]", true, 0},   {"[#1GT0]", "#1=#1-FIX[#1/2]", false, 1},
      {"[#1GT1]", "#1=#1-FIX[#1/2]", true, 0},   {"[#1GT1]", "#1=FIX[SQRT[#1]]", true, 0},
      {"[#1GE1]", "#1=FIX[SQRT[#1]]", false, 1}, {"[#1GT.5]", "#1=#1/2", true, 0},
      {"[#1GT10]", "#1=#1*.75", true, 0},        {"[#1GT0]", "#1=#1-#1MOD3-1", true, 0},
      {"[#1GE3]", "#1=#1-3", true, 0},           {"[#1NE0]", "#1=#1-1", true, 0},
  };
  for (const Shrinking &row : rows) {
    Draft draft(fmt::format("shrinking {} {}", row.guard, row.pass));
    draft.promised({501, 0, draw.of({100., 1000.}), ArgumentKind::Whole});
    draft.line("#1=#501").line(fmt::format("N20WHILE{}DO1", row.guard)).line(row.pass).line("END1");
    if (row.ends)
      draft.proved("loop-ends.N20").proved("program-ends");
    else
      draft.refuted("loop-ends.N20", {{501, row.bad}}).refuted("program-ends", {{501, row.bad}});
    family.push_back(draft.done());
  }
}

} // namespace

void addSpecialSteps(Family &family) {
  Draw draw(2);
  addArgumentSteps(family, draw);
  addEqualPasses(family, draw);
  addConditionalSteps(family, draw);
  addShrinking(family, draw);
}

} // namespace feedhold::proof_tests
