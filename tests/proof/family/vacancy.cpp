// Variables that hold nothing: what tells them from 0, what does not, and what fills them.
#include "proof/family/draft.h"

#include <fmt/format.h>

namespace feedhold::proof_tests {

namespace {

/// `IF[..]GOTO91` behind some blocks, and whether the alarm at N91 can be raised when #1 may hold anything, when it
/// holds a number other than 0, and when it holds 0 to 5 or nothing.
struct Row {
  std::string_view front;
  std::string_view condition;
  bool withAnything;
  bool withNumber;   // 1 to 5
  bool withOptional; // 0 to 5, or nothing
  Inputs bad;
  Inputs badOptional;
};

const std::vector<Row> &rows() {
  static const std::vector<Row> all = {
      {"", "#1EQ#0", true, false, true, {}, {}},
      {"", "#1NE#0", true, true, true, {{1, 1}}, {{1, 1}}},
      {"", "#1EQ0", true, false, true, {{1, 0}}, {{1, 0}}},
      {"", "#1LT0", true, false, false, {{1, -1}}, {}},
      {"", "#1LE0", true, false, true, {}, {}},
      {"#2=#1", "#2EQ#0", true, false, true, {}, {}},
      {"#2=#1+0", "#2EQ#0", false, false, false, {}, {}},
      {"#2=-#1", "#2EQ#0", false, false, false, {}, {}},
      {"#2=ABS[#1]", "#2LT0", false, false, false, {}, {}},
      {"IF[#1EQ#0]THEN#1=3", "#1EQ#0", false, false, false, {}, {}},
      {"IF[#1EQ0]THEN#1=3", "#1EQ#0", true, false, true, {}, {}},
      {"IF[#1EQ0]THEN#1=#0", "#1EQ0", false, false, false, {}, {}},
      {"IF[#1LE0]THEN#1=1", "#1LT1", true, false, true, {{1, .5}}, {{1, .5}}},
      {"IF[#1LE0]THEN#1=1", "#1LE0", false, false, false, {}, {}},
      {"IF[#1NE#0]GOTO95", "#1GT0", false, false, false, {}, {}},
      {"IF[#1EQ#0]GOTO95", "#1EQ#0", false, false, false, {}, {}},
      {"IF[#1NE0]GOTO95", "#1EQ#0", false, false, false, {}, {}},
      {"#1=#0", "#1NE#0", false, false, false, {}, {}},
      {"#1=0", "#1EQ#0", false, false, false, {}, {}},
      {"#2=#1*#1", "#2LT0", false, false, false, {}, {}},
      {"#2=FIX[#1]", "#2GT#1", true, false, false, {{1, -.5}}, {}},
      {"#2=#1", "#2NE#1", false, false, false, {}, {}},
      {"#2=#1+0", "#2NE#1", true, false, true, {}, {}},
  };
  return all;
}

void finish(Family &family, Draft &draft, const Row &row, bool isRaised, const Inputs &bad) {
  if (!row.front.empty())
    draft.line(row.front);
  draft.line(fmt::format("IF[{}]GOTO91", row.condition)).lines({"N95GOTO99", "N91#3000=1(SEEN)", "N99"});
  if (isRaised)
    draft.refuted("alarm-unreachable.N91", bad);
  else
    draft.proved("alarm-unreachable.N91");
  family.push_back(draft.done());
}

/// Loops that wait for a variable to be filled, or emptied.
void addWaiting(Family &family) {
  struct Waiting {
    std::string_view guard;
    std::string_view pass;
    bool ends;
    Inputs bad;
  };
  const Waiting loops[] = {
      {"[#1EQ#0]", "#2=1", false, {}},
      {"[#1EQ#0]", "#1=1", true, {}},
      {"[#1NE#0]", "#1=#0", true, {}},
      {"[#1NE#0]", "#2=#2+1", false, {{1, 1}}},
      {"[#1EQ#0]", "#1=#2", false, {}},
      {"[#1EQ#0]", "#1=#2+0", true, {}},
      {"[#1NE0]", "#1=0", true, {}},
      {"[#1NE0]", "#1=#0", false, {{1, 1}}},
      {"[#1LT#2]", "#1=#1+1", true, {}},
      {"[#1LT5]", "#1=#2+1", false, {}},
      {"[#1EQ#0]", "#2=#2+1\nIF[#2GT9]THEN#1=#2", true, {}},
      {"[#1EQ0]", "#1=#0", true, {}},
  };
  for (const Waiting &loop : loops)
    for (const bool asGoto : {false, true}) {
      Draft draft(fmt::format("waits: {} {} {}", loop.guard, loop.pass, asGoto));
      draft.free(1).free(2);
      if (asGoto)
        draft.line(fmt::format("N20IF{}GOTO30", loop.guard)).line("GOTO90").line("N30").line(loop.pass).line("GOTO20");
      else
        draft.line(fmt::format("N20WHILE{}DO1", loop.guard)).line(loop.pass).line("END1");
      draft.line("N90");
      if (loop.ends)
        draft.proved("loop-ends.N20").proved("program-ends");
      else
        draft.refuted("loop-ends.N20", loop.bad).refuted("program-ends", loop.bad);
      family.push_back(draft.done());
    }
}

} // namespace

void addVacancy(Family &family) {
  for (const Row &row : rows()) {
    Draft anything(fmt::format("vacancy: {} {}", row.front, row.condition));
    finish(family, anything.free(1), row, row.withAnything, row.bad);
    Draft number(fmt::format("vacancy, a number: {} {}", row.front, row.condition));
    finish(family, number.promised({1, 1, 5}), row, row.withNumber, {{1, 1}});
    Draft optional(fmt::format("vacancy, optional: {} {}", row.front, row.condition));
    finish(family, optional.promised({1, 0, 5, ArgumentKind::Real, Presence::Optional}), row, row.withOptional,
           row.badOptional);
  }
  addWaiting(family);
}

} // namespace feedhold::proof_tests
