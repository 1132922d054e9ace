// Loops in loops: the inner one counts by itself, up to the outer counter, or changes what the outer one counts.
#include "proof/family/draft.h"

#include <fmt/format.h>

namespace feedhold::proof_tests {

namespace {

struct Nest {
  std::string_view outerGuard; // under which it goes on
  std::string_view outerExit;
  std::string_view before; // the inner loop
  std::string_view innerGuard;
  std::string_view innerExit;
  std::string_view inside;
  std::string_view behind;
  bool outerEnds;
  bool innerEnds;
  Inputs bad;
};

// a row a line
// clang-format off
/// The counters are #1 and #2, from 0; #501 and #502 are promised to be whole and 1 to 50.
const std::vector<Nest> &nests() {
  static const std::vector<Nest> rows = {
      {"[#1LT#501]", "[#1GE#501]", "#2=0", "[#2LT#502]", "[#2GE#502]", "#2=#2+1", "#1=#1+1", true, true, {}},
      {"[#1LT#501]", "[#1GE#501]", "#2=0", "[#2LT#1]", "[#2GE#1]", "#2=#2+.5", "#1=#1+1", true, true, {}},
      {"[#1LT#501]", "[#1GE#501]", "#2=#1", "[#2LT#501]", "[#2GE#501]", "#2=#2+1", "#1=#1+1", true, true, {}},
      {"[#1LT#501]", "[#1GE#501]", "#3=1", "[#2LT#502]", "[#2GE#502]", "#2=#2+1", "#1=#1+1", true, true, {}},
      {"[#1LT#501]", "[#1GE#501]", "#2=#502", "[#2GT0]", "[#2LE0]", "#2=#2-1", "#1=#1+2", true, true, {}},
      {"[#1LT#501]", "[#1GE#501]", "#2=#502", "[#2NE0]", "[#2EQ0]", "#2=#2-1", "#1=#1+.25", true, true, {}},
      {"[#1LT#501]", "[#1GE#501]", "#2=0", "[#2LT3]", "[#2GE3]", "#2=#2+1\n#1=#1+1", "#3=#1", true, true, {}},
      {"[#1LT#501]", "[#1GE#501]", "#2=#1\n#1=#1+1", "[#2GT0]", "[#2LE0]", "#2=#2-2", "#3=0", true, true, {}},
      {"[#1LT#501]", "[#1GE#501]", "#2=0", "[#2LT#502]", "[#2GE#502]", "#2=#2+1", "#3=#1+1", false, true,
       {{501, 1}, {502, 1}}},
      {"[#1LT#501]", "[#1GE#501]", "#2=0", "[#2LT#502]", "[#2GE#502]", "#3=#2+1", "#1=#1+1", false, false,
       {{501, 1}, {502, 1}}},
      {"[#1LT#501]", "[#1GE#501]", "#2=0", "[#2LT#502]", "[#2GE#502]", "#2=#2-1", "#1=#1+1", false, false,
       {{501, 1}, {502, 1}}},
      {"[#1LT#501]", "[#1GE#501]", "#2=0", "[#2LT2]", "[#2GE2]", "#2=#2+1\n#1=#1-1", "#1=#1+2", false, true,
       {{501, 1}, {502, 1}}},
      {"[#1LT#501]", "[#1GE#501]", "#2=0\n#1=#1+1", "[#2LT#502]", "[#2GE#502]", "#2=#2+1", "#1=#1-1", false, true,
       {{501, 2}, {502, 1}}},
      {"[#1LT#501]", "[#1GE#501]", "#3=0", "[#2LT#502]", "[#2GE#502]", "#2=#2+1\n#1=#1+1", "#3=1", false, true,
       {{501, 2}, {502, 1}}},
      {"[#1LE#501]", "[#1GT#501]", "#2=0", "[#2LE#1]", "[#2GT#1]", "#2=#2+1", "#1=#1+1", true, true, {}},
      {"[#1LT#501]", "[#1GE#501]", "#2=100", "[#2GT#502]", "[#2LE#502]", "#2=#2-5", "#1=#1+1", true, true, {}},
  };
  return rows;
}
// clang-format on

enum class Form : std::uint8_t { While, Goto, Mixed };

void addNest(Family &family, const Nest &nest, Form form) {
  Draft draft(fmt::format("nested {} {} {}: {} / {}", nest.outerGuard, nest.innerGuard, static_cast<int>(form),
                          nest.inside, nest.behind));
  draft.promised({501, 1, 50, ArgumentKind::Whole}).promised({502, 1, 50, ArgumentKind::Whole});
  draft.lines({"#1=0", "#2=0"});
  draft.line(form == Form::While ? fmt::format("N20WHILE{}DO1", nest.outerGuard)
                                 : fmt::format("N20IF{}GOTO90", nest.outerExit));
  draft.line(nest.before);
  draft.line(form == Form::Goto ? fmt::format("N30IF{}GOTO60", nest.innerExit)
                                : fmt::format("N30WHILE{}DO2", nest.innerGuard));
  draft.line(nest.inside).line(form == Form::Goto ? "GOTO30" : "END2").line("N60").line(nest.behind);
  draft.line(form == Form::While ? "END1" : "GOTO20").line("N90");
  if (nest.outerEnds)
    draft.proved("loop-ends.N20").proved("loop-ends.N30").proved("program-ends");
  else
    draft.refuted("program-ends", nest.bad);
  if (!nest.outerEnds && nest.innerEnds)
    draft.refuted("loop-ends.N20", nest.bad).proved("loop-ends.N30");
  if (!nest.innerEnds)
    draft.refuted("loop-ends.N30", nest.bad);
  family.push_back(draft.done());
}

/// Left by GOTO from within, on conditions of all kinds.
void addExits(Family &family) {
  struct Exit {
    std::string_view condition;
    std::string_view pass;
    bool ends;
  };
  const Exit rows[] = {
      {"[#1GE#501]", "#1=#1+1", true},    {"[#1GT#501]", "#1=#1+.5", true},
      {"[#1EQ#501]", "#1=#1+1", true},    {"[#1LT#501-5]", "#1=#1+1", false},
      {"[#1EQ.5]", "#1=#1+1", false},     {"[#1GE1000]", "#1=#1+#501", true},
      {"[#1EQ#0]", "#1=#1+1", false},     {"[#2GT#501]", "#1=#1+1\n#2=#1*2", true},
      {"[#1*#1GT#501]", "#1=#1+1", true}, {"[ABS[#1]GT100]", "#1=#1-2", true},
      {"[#1LE-20]", "#1=#1-#501", true},  {"[#1LE-20]", "#1=#1-#501+1", false},
  };
  for (const Exit &row : rows)
    for (const int depth : {1, 2}) {
      Draft draft(fmt::format("left by GOTO: {} {} {}", row.condition, row.pass, depth));
      draft.promised({501, 1, 40, ArgumentKind::Whole}).lines({"#1=0", "#2=0"});
      draft.line(depth == 1 ? "N20WHILE[1EQ1]DO1" : "N20DO1");
      if (depth == 2)
        draft.line("#4=0").line("N30WHILE[#4LT3]DO2");
      draft.line(fmt::format("IF{}GOTO90", row.condition)).line(row.pass);
      if (depth == 2)
        draft.line("#4=#4+1").line("END2");
      draft.line("END1").line("N90");
      if (row.ends)
        draft.proved("loop-ends.N20").proved("program-ends");
      else
        draft.refuted("loop-ends.N20", {{501, 1}}).refuted("program-ends", {{501, 1}});
      family.push_back(draft.done());
    }
}

} // namespace

void addNestedLoops(Family &family) {
  for (const Nest &nest : nests())
    for (const Form form : {Form::While, Form::Goto, Form::Mixed})
      addNest(family, nest, form);
  addExits(family);
}

} // namespace feedhold::proof_tests
