// Calls by G65 and M98: what a called program changes, what it cannot, and loops that depend on it.
#include "proof/family/draft.h"

#include <fmt/format.h>

namespace feedhold::proof_tests {

namespace {

/// A loop whose step is taken in a called program.
void addCalledSteps(Family &family) {
  struct Step {
    std::string_view call;
    std::string_view body;
    bool ends;
  };
  const Step rows[] = {
      {"M98P9200", "#100=#100-1", true},
      {"M98P9200", "#100=#100-.5", true},
      {"M98P9200L2", "#100=#100-1", true},
      {"M98P9200", "#100=#100+1", false},
      {"M98P9200", "#101=#100-1", false},
      {"G65P9200A1.", "#100=#100-#1", true},
      {"G65P9200A#2", "#100=#100-#1-1", true},
      {"G65P9200", "#100=#100-#1", false},
      {"G65P9200A1.", "#100=#100-#1+1", false},
      {"G65P9200A#100", "#100=FIX[#1/2]", true},
      {"G65P9200A#100", "#1=#1-1", false},
      {"G65P9200A#100B1.", "#100=#1-#2", true},
      {"G65P9200A3.", "WHILE[#1GT0]DO1\n#1=#1-1\n#100=#100-1\nEND1", true},
      {"G65P9200A0.", "WHILE[#1GT0]DO1\n#1=#1-1\n#100=#100-1\nEND1", false},
      {"M98P9200", "IF[#100GT5]GOTO10\n#100=0\nGOTO20\nN10#100=#100-2\nN20", true},
      {"M98P9200", "M98P9300", true},
      {"M98P9200", "G65P9300A1.", true},
  };
  for (const Step &row : rows)
    for (const bool asGoto : {false, true}) {
      Draft draft(fmt::format("called step: {} {} {}", row.call, row.body, asGoto));
      draft.promised({501, 1, 60, ArgumentKind::Whole}).line("#100=#501").line("#2=1");
      draft.line(asGoto ? "N20IF[#100LE0]GOTO90" : "N20WHILE[#100GT0]DO1").line(row.call);
      draft.line(asGoto ? "GOTO20" : "END1").line("N90");
      draft.other({"O9200", row.body, "M99", "O9300", "#100=#100-1", "M99"});
      if (row.ends)
        draft.proved("loop-ends.N20").proved("program-ends");
      else
        draft.refuted("loop-ends.N20", {{501, 1}}).refuted("program-ends", {{501, 1}});
      family.push_back(draft.done());
    }
}

/// What is known behind a call.
void addResults(Family &family) {
  struct Result {
    std::string_view call;
    std::string_view body;
    std::string_view condition; // of an alarm behind the call
    bool isRaised;
  };
  const Result rows[] = {
      {"#1=5\nM98P9200", "#1=#1+1", "#1NE6", false},
      {"#1=5\nG65P9200", "#1=7", "#1NE5", false},
      {"#1=5\nG65P9200A#1", "#100=#1*2", "#100NE10", false},
      {"G65P9200A#501B2.", "#100=#1*#2", "#100NE#501*2", false},
      {"G65P9200A#501B2.", "#100=#1*#2", "#100NE#501", true},
      {"G65P9200A#501", "#100=#2", "#100NE#0", false},
      {"G65P9200A#501", "#100=#2+1", "#100NE1", false},
      {"#33=4\nG65P9200A1.", "#100=#33", "#100NE#0", false},
      {"#33=4\nM98P9200", "#100=#33", "#100NE4", false},
      {"#100=3\nG65P9200A#501", "IF[#1GT10]THEN#100=4", "#100GT4", false},
      {"#100=3\nG65P9200A#501", "IF[#1GT10]THEN#100=4", "#100EQ4", true},
      {"#100=3\nM98P9200L3", "#100=#100*2", "#100NE24", false},
      {"#100=0\nG65P9200A#501", "WHILE[#100LT#1]DO1\n#100=#100+1\nEND1", "#100LT#501", false},
      {"#100=0\nG65P9200A#501", "WHILE[#100LT#1]DO1\n#100=#100+1\nEND1", "#100GT#501", false},
      {"#100=0\nG65P9200A#501", "WHILE[#100LE#1]DO1\n#100=#100+1\nEND1", "#100GT#501", true},
  };
  for (const Result &row : rows) {
    Draft draft(fmt::format("behind a call: {} {} {}", row.call, row.body, row.condition));
    draft.promised({501, 1, 60, ArgumentKind::Whole}).line(row.call);
    draft.line(fmt::format("IF[{}]GOTO91", row.condition)).lines({"GOTO99", "N91#3000=1(WRONG)", "N99"});
    draft.other({"O9200", row.body, "M99"}).proved("program-ends");
    if (row.isRaised)
      draft.refuted("alarm-unreachable.N91", {{501, 20}});
    else
      draft.proved("alarm-unreachable.N91");
    family.push_back(draft.done());
  }
}

} // namespace

void addCalls(Family &family) {
  addCalledSteps(family);
  addResults(family);
}

} // namespace feedhold::proof_tests
