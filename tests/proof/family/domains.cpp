// Divisions and functions whose arguments must be in a range, with guards and contracts that keep them there or do not.
#include "proof/family/draft.h"

#include <fmt/format.h>

namespace feedhold::proof_tests {

namespace {

/// A block at N50 that may stop the control, what stands in front of it, and what is promised.
struct Row {
  std::string_view front;
  std::string_view block;
  std::vector<Argument> promised;
  bool safe;
  Inputs bad;
};

Argument real(std::uint32_t variable, double low, double high) { return {variable, low, high}; }
Argument maybe(std::uint32_t variable, double low, double high) {
  return {variable, low, high, ArgumentKind::Real, Presence::Optional};
}

const std::vector<Row> &divisions() {
  static const std::vector<Row> rows = {
      {"", "#3=#1/#2", {real(2, 1, 10)}, true, {}},
      {"", "#3=#1/#2", {real(2, -10, -.5)}, true, {}},
      {"", "#3=#1/#2", {real(2, 0, 10)}, false, {{2, 0}}},
      {"", "#3=#1/#2", {real(2, -5, 5)}, false, {{2, 0}}},
      {"", "#3=#1/#2", {maybe(2, 1, 10)}, false, {}},
      {"", "#3=#1/#2", {}, false, {}},
      {"IF[#2EQ0]GOTO99", "#3=#1/#2", {}, false, {}},
      {"IF[#2EQ#0]GOTO99", "#3=#1/#2", {}, false, {{2, 0}}},
      {"IF[#2LE0]GOTO99", "#3=#1/#2", {}, true, {}},
      {"IF[[#2EQ#0]OR[#2EQ0]]GOTO99", "#3=#1/#2", {}, true, {}},
      {"IF[#2*1EQ0]GOTO99", "#3=#1/#2", {}, true, {}},
      {"IF[ABS[#2]LT.01]GOTO99", "#3=#1/#2", {}, true, {}},
      {"IF[#2GT5]GOTO99", "#3=#1/#2", {real(2, 1, 10)}, true, {}},
      {"IF[#2LT0]THEN#2=-#2", "#3=#1/#2", {real(2, -5, 5)}, false, {{2, 0}}},
      {"#2=ABS[#2]+1", "#3=#1/#2", {}, true, {}},
      {"#2=#2*#2+.5", "#3=#1/#2", {}, true, {}},
      {"#2=FIX[#2]", "#3=#1/#2", {real(2, .5, 10)}, false, {{2, .5}}},
      {"#2=FUP[#2]", "#3=#1/#2", {real(2, .5, 10)}, true, {}},
      {"", "#3=1/[#1-#2]", {real(1, 5, 10), real(2, 0, 4.5)}, true, {}},
      {"", "#3=1/[#1-#2]", {real(1, 5, 10), real(2, 0, 5)}, false, {{1, 5}, {2, 5}}},
      {"IF[#1EQ#2]GOTO99", "#3=1/[#1-#2]", {real(1, 5, 10), real(2, 0, 8)}, true, {}},
      {"IF[#1LE#2]GOTO99", "#3=1/[#1-#2]", {}, true, {}},
      {"IF[#1NE#2]GOTO50\nGOTO99", "#3=1/[#1-#2]", {real(1, 5, 10), real(2, 0, 8)}, true, {}},
      {"", "#3=1/[#1*#2]", {real(1, 1, 10), real(2, 2, 8)}, true, {}},
      {"", "#3=1/[#1*#2]", {real(1, -1, 10), real(2, 2, 8)}, false, {{1, 0}, {2, 2}}},
      {"#4=#1MOD2", "#3=1/[#4+1]", {{1, 0, 50, ArgumentKind::Whole}}, true, {}},
      {"#4=#1MOD2", "#3=1/#4", {{1, 0, 50, ArgumentKind::Whole}}, false, {{1, 2}}},
      {"", "#3=#1MOD#2", {real(1, 0, 9), real(2, 1, 3)}, true, {}},
      {"", "#3=360/FUP[#1]", {real(1, .25, 12)}, true, {}},
  };
  return rows;
}

const std::vector<Row> &functions() {
  static const std::vector<Row> rows = {
      {"", "#3=SQRT[#1-#2]", {real(1, 5, 10), real(2, 0, 5)}, true, {}},
      {"", "#3=SQRT[#1-#2]", {real(1, 5, 10), real(2, 0, 6)}, false, {{1, 5}, {2, 6}}},
      {"IF[#1LT#2]GOTO99", "#3=SQRT[#1-#2]", {}, true, {}},
      {"IF[#2GT#1]GOTO99", "#3=SQRT[#1-#2]", {}, true, {}},
      {"IF[#1EQ#2]GOTO99", "#3=SQRT[#1-#2]", {}, false, {{2, 1}}},
      {"", "#3=SQRT[#1*#1+#2*#2]", {}, true, {}},
      {"", "#3=SQRT[#1*#1-#2*#2]", {real(1, 10, 20), real(2, -10, 10)}, true, {}},
      {"", "#3=SQRT[#1*#1-#2*#2]", {real(1, 10, 20), real(2, -12, 12)}, false, {{1, 10}, {2, -12}}},
      {"", "#3=SQRT[ABS[#1]]", {}, true, {}},
      {"", "#3=SQRT[#1]", {}, false, {{1, -1}}},
      {"", "#3=SQRT[#1]", {maybe(1, 0, 5)}, true, {}},
      {"IF[#1LT0]THEN#1=0", "#3=SQRT[#1]", {}, true, {}},
      {"#4=SQRT[#1*#1]", "#3=SQRT[#4]", {}, true, {}},
      {"", "#3=SQRT[[#1-1]*[#1+1]]", {real(1, 1, 9)}, true, {}},
      {"", "#3=SQRT[[#1-1]*[#1+1]]", {real(1, 0, 9)}, false, {{1, 0}}},
      {"", "#3=SQRT[1-SIN[#1]*SIN[#1]]", {}, true, {}},
      {"", "#3=SQRT[2-SIN[#1]-COS[#1]]", {}, true, {}},
      {"", "#3=ASIN[#1]", {real(1, -1, 1)}, true, {}},
      {"", "#3=ASIN[#1]", {real(1, -1, 1.5)}, false, {{1, 1.5}}},
      {"IF[ABS[#1]GT1]GOTO99", "#3=ASIN[#1]", {}, true, {}},
      {"IF[#1GT1]GOTO99", "#3=ASIN[#1]", {}, false, {{1, -2}}},
      {"", "#3=ACOS[#1/10]", {real(1, -10, 10)}, true, {}},
      {"", "#3=ACOS[#1/#2]", {real(1, 0, 5), real(2, 5, 9)}, true, {}},
      {"", "#3=ACOS[#1/#2]", {real(1, 0, 5), real(2, 4, 9)}, false, {{1, 5}, {2, 4}}},
      {"", "#3=ACOS[#1/[ABS[#1]+1]]", {}, true, {}},
      {"", "#3=ACOS[COS[#1]]", {}, true, {}},
      {"#4=SQRT[#1*#1+4]", "#3=ASIN[2/#4]", {}, true, {}},
      {"", "#3=LN[#1]", {real(1, .125, 5)}, true, {}},
      {"", "#3=LN[#1]", {real(1, 0, 5)}, false, {{1, 0}}},
      {"IF[#1LE0]GOTO99", "#3=LN[#1]", {}, true, {}},
      {"IF[#1LT0]GOTO99", "#3=LN[#1]", {}, false, {}},
      {"", "#3=LN[#1*#1+1]", {}, true, {}},
      {"", "#3=LN[EXP[#1]]", {real(1, -5, 5)}, true, {}},
      {"", "#3=LN[2+SIN[#1]]", {}, true, {}},
      {"", "#3=LN[ABS[#1]]", {real(1, -5, 5)}, false, {{1, 0}}},
  };
  return rows;
}

void addRow(Family &family, const Row &row) {
  Draft draft(fmt::format("domain: {} {}", row.front, row.block));
  bool given[3] = {false, false, false};
  for (const Argument &argument : row.promised) {
    draft.promised(argument);
    given[argument.variable] = true;
  }
  for (const std::uint32_t variable : {1U, 2U})
    if (!given[variable])
      draft.free(variable);
  if (!row.front.empty())
    draft.line(row.front);
  draft.line(fmt::format("N50{}", row.block)).line("N99");
  if (row.safe)
    draft.proved("no-control-alarm.N50");
  else
    draft.refuted("no-control-alarm.N50", row.bad);
  draft.proved("program-ends");
  family.push_back(draft.done());
}

/// Within a loop: the counter is in the argument.
void addInLoops(Family &family) {
  struct InLoop {
    std::string_view start;
    std::string_view guard;
    std::string_view block;
    std::string_view step;
    bool safe;
    Inputs bad;
  };
  const InLoop rows[] = {
      {"#3=#1", "[#3GT0]", "#4=100/#3", "#3=#3-1", true, {}},
      {"#3=#1", "[#3GE0]", "#4=100/#3", "#3=#3-1", false, {{1, 1}}},
      {"#3=1", "[#3LE#1]", "#4=#1/#3", "#3=#3+1", true, {}},
      {"#3=0", "[#3LE#1]", "#4=#1/#3", "#3=#3+1", false, {{1, 1}}},
      {"#3=0", "[#3LT#1]", "#4=1/[#1-#3]", "#3=#3+.5", true, {}},
      {"#3=0", "[#3LE#1]", "#4=1/[#1-#3]", "#3=#3+.5", false, {{1, 1}}},
      {"#3=0", "[#3LE#1]", "#4=SQRT[#1*#1-#3*#3]", "#3=#3+.25", true, {}},
      {"#3=0", "[#3LE#1+1]", "#4=SQRT[#1*#1-#3*#3]", "#3=#3+.25", false, {{1, 1}}},
      {"#3=-#1", "[#3LE#1]", "#4=ASIN[#3/#1]", "#3=#3+1", true, {}},
      {"#3=-#1", "[#3LT#1+1]", "#4=ACOS[#3/[#1+1]]", "#3=#3+1", true, {}},
      {"#3=-#1", "[#3LT#1+1]", "#4=ACOS[#3/[#1-.5]]", "#3=#3+1", false, {{1, 1}}},
      {"#3=#1", "[#3GT0]", "#4=LN[#3]", "#3=#3-.25", true, {}},
      {"#3=#1", "[#3GE0]", "#4=LN[#3]", "#3=#3-.25", false, {{1, 1}}},
  };
  for (const InLoop &row : rows)
    for (const bool asGoto : {false, true}) {
      Draft draft(fmt::format("domain in a loop: {} {} {}", row.guard, row.block, asGoto));
      draft.promised({1, 1, 100}).line(row.start);
      if (asGoto)
        draft.line(fmt::format("N20IF{}GOTO50", row.guard)).line("GOTO99");
      else
        draft.line(fmt::format("N20WHILE{}DO1", row.guard));
      draft.line(fmt::format("N50{}", row.block)).line(row.step).line(asGoto ? "GOTO20" : "END1").line("N99");
      draft.proved("loop-ends.N20");
      if (row.safe)
        draft.proved("no-control-alarm.N50");
      else
        draft.refuted("no-control-alarm.N50", row.bad);
      family.push_back(draft.done());
    }
}

} // namespace

void addDomains(Family &family) {
  for (const Row &row : divisions())
    addRow(family, row);
  for (const Row &row : functions())
    addRow(family, row);
  addInLoops(family);
}

} // namespace feedhold::proof_tests
