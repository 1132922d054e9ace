// Loops with several phases or several counters: one has to run out before the other begins to.
#include "proof/family/draft.h"

#include <fmt/format.h>

namespace feedhold::proof_tests {

namespace {

/// Two counters from arguments that may be anything, made whole.
struct Loop {
  std::string_view guard;
  std::string_view pass;
  bool ends;
  Inputs bad;
};

const std::vector<Loop> &loops() {
  static const std::vector<Loop> rows = {
      {"[#1GE0]", "#1=#1+#2\n#2=#2-1", true, {}},
      {"[#1GT0]", "#1=#1-#2\n#2=#2+.5", true, {}},
      {"[#1LT100]", "#1=#1+#2\n#2=#2+1", true, {}},
      {"[#1GE0]", "#1=#1+#2\n#2=#2+1", false, {{501, 1}, {502, 1}}},
      {"[[#1GT0]AND[#2GT0]]", "IF[#1GT#2]GOTO30\n#2=#2-1\nGOTO40\nN30#1=#1-1\nN40", true, {}},
      {"[[#1GT0]AND[#2GT0]]", "IF[#1GT#2]GOTO30\n#2=#2-1\nGOTO40\nN30#1=#2\nN40", true, {}},
      {"[#1NE#2]", "IF[#1GT#2]GOTO30\n#1=#1+1\nGOTO40\nN30#1=#1-1\nN40", true, {}},
      {"[#1LT#2]", "#1=#1+1\n#2=#2-1", true, {}},
      {"[#1LT#2]", "#1=#1+1\n#2=#2+1", false, {{502, 1}}},
      {"[#1LT#2]", "#1=#1+2\n#2=#2+1", true, {}},
      {"[[#1GE0]AND[#2GE0]]", "IF[#2EQ0]GOTO30\n#2=#2-1\nGOTO40\nN30#1=#1-1\n#2=5\nN40", true, {}},
      {"[[#1GE0]AND[#2GE0]]", "IF[#2EQ0]GOTO30\n#2=#2-1\nGOTO40\nN30#1=#1-1\n#2=FIX[#1032]\nN40", true, {}},
      {"[#1GT0]", "IF[#2GT0]GOTO30\n#1=#1-1\nGOTO40\nN30#2=#2-1\nN40", true, {}},
      {"[#1GT0]", "IF[#2GT0]GOTO30\n#1=#1-1\n#2=3\nGOTO40\nN30#2=#2-1\nN40", true, {}},
      {"[#1GT0]", "IF[#2GT0]GOTO30\n#1=#1-1\n#2=3\nGOTO40\nN30#2=#2-1\n#1=#1+1\nN40", false, {{501, 2}, {502, 1}}},
      {"[#1GT0]", "#3=#1\n#1=#2-1\n#2=#3-1", true, {}},
      {"[#1GT0]", "#3=#1\n#1=#2\n#2=#3", false, {{501, 1}, {502, 1}}},
      {"[#1GT0]", "#1=#1-1\nIF[#1EQ5]THEN#1=3", true, {}},
      {"[#1GT0]", "#1=#1-1\nIF[#1EQ5]THEN#1=8", false, {{501, 6}}},
      {"[#1+#2GT0]", "IF[#1GT0]GOTO30\n#2=#2-1\nGOTO40\nN30#1=#1-1\nN40", true, {}},
      {"[#1+#2GT0]", "#1=#1-1\n#2=#2+1", false, {{501, 1}}},
      {"[#1+#2GT0]", "#1=#1-2\n#2=#2+1", true, {}},
      {"[#1GT#2]", "IF[#2LT0]GOTO30\n#1=#1-1\nGOTO40\nN30#2=#2+1\nN40", true, {}},
      {"[#1*#1GT#2]", "#2=#2+1", true, {}},
      {"[ABS[#1]GT1]", "#1=FIX[#1/2]", true, {}},
  };
  return rows;
}

} // namespace

void addPhases(Family &family) {
  for (const Loop &loop : loops())
    for (const bool asGoto : {false, true}) {
      Draft draft(fmt::format("phases: {} {} {}", loop.guard, loop.pass, asGoto));
      draft.free(501).free(502).lines({"#1=FIX[#501]", "#2=FIX[#502]"});
      if (asGoto)
        draft.line(fmt::format("N20IF{}GOTO25", loop.guard)).lines({"GOTO90", "N25"}).line(loop.pass).line("GOTO20");
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

} // namespace feedhold::proof_tests
