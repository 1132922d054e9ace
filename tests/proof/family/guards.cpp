// Macros that look at their step before they count with it: each set of guards lets some steps pass and stops others.
#include "proof/family/draft.h"

#include <fmt/format.h>

namespace feedhold::proof_tests {

namespace {

enum class Loop : std::uint8_t { While, Goto };

/// What a guard `IF[#22..]GOTO91` stops, of the steps with which the loop behind it does not end.
struct Guard {
  std::string_view condition;
  bool vacant;
  bool zero;
  bool negative;
};
constexpr Guard kGuards[] = {
    {"#22EQ#0", true, false, false},   {"#22EQ0", false, true, false},        {"#22LT0", false, false, true},
    {"#22LE0", true, true, true},      {"0GE#22", true, true, true},          {"0GT#22", false, false, true},
    {"[#22*1]EQ0", true, true, false}, {"ABS[#22]LT.001", true, true, false},
};

void addGuarded(Family &family, std::initializer_list<int> guards, Loop loop) {
  bool vacant = false;
  bool zero = false;
  bool negative = false;
  std::string name = loop == Loop::While ? "guards in front of WHILE:" : "guards in front of GOTO:";
  std::string checks;
  for (const int at : guards) {
    const Guard &guard = kGuards[at];
    vacant = vacant || guard.vacant;
    zero = zero || guard.zero;
    negative = negative || guard.negative;
    name += fmt::format(" {}", guard.condition);
    checks += fmt::format("IF[{}]GOTO91\n", guard.condition);
  }
  const std::string body =
      checks + (loop == Loop::While ? "#10=0\nN20WHILE[#10LT#21]DO1\n#10=#10+#22\nEND1\nGOTO99\nN91#3000=101(STEP)\nN99"
                                    : "#10=0\nN20#10=#10+#22\nIF[#10LT#21]GOTO20\nGOTO99\nN91#3000=101(STEP)\nN99");

  Draft anything(name);
  anything.free(21).free(22).line(body);
  if (vacant && zero && negative)
    anything.proved("loop-ends.N20").proved("program-ends");
  else
    anything.refuted("loop-ends.N20", !vacant ? Inputs{{21, 5}}
                                      : !zero ? Inputs{{21, 5}, {22, 0}}
                                              : Inputs{{21, 5}, {22, -1}});
  if (guards.size() != 0)
    anything.refuted("alarm-unreachable.N91", vacant ? Inputs{{21, 5}}
                                              : zero ? Inputs{{21, 5}, {22, 0}}
                                                     : Inputs{{21, 5}, {22, -1}});
  family.push_back(anything.done());

  Draft good(name + ", under a contract");
  good.promised({21, 0, 200}).promised({22, .125, 20}).line(body);
  good.proved("loop-ends.N20").proved("program-ends");
  if (guards.size() != 0)
    good.proved("alarm-unreachable.N91");
  family.push_back(good.done());

  Draft zeroAllowed(name + ", under a contract with 0");
  zeroAllowed.promised({21, 1, 200}).promised({22, 0, 20}).line(body);
  if (zero) {
    zeroAllowed.proved("loop-ends.N20").proved("program-ends");
    zeroAllowed.refuted("alarm-unreachable.N91", {{21, 1}, {22, 0}});
  } else {
    zeroAllowed.refuted("loop-ends.N20", {{21, 1}, {22, 0}});
    if (guards.size() != 0)
      zeroAllowed.proved("alarm-unreachable.N91");
  }
  family.push_back(zeroAllowed.done());
}

} // namespace

void addGuards(Family &family) {
  for (const Loop loop : {Loop::While, Loop::Goto}) {
    addGuarded(family, {}, loop);
    for (int single = 0; single < 8; ++single)
      addGuarded(family, {single}, loop);
    addGuarded(family, {0, 1}, loop);
    addGuarded(family, {1, 2}, loop);
    addGuarded(family, {0, 1, 2}, loop);
    addGuarded(family, {6, 5}, loop);
    addGuarded(family, {0, 3}, loop);
  }
}

} // namespace feedhold::proof_tests
