// Loops by their iterations: what ends them, and from where they go on for ever.
#include "proof/termination/termination.h"

#include "dialects/registry.h"
#include "proof/termination/recurrence.h"

#include <gtest/gtest.h>

namespace feedhold::prove {
namespace {

using smt::Number;
using smt::Sort;
using smt::TermId;
using smt::TermStore;

class LoopTest : public ::testing::Test {
protected:
  LoopTest() {
    loop.iterations = store.variable("passes", Sort::Int);
    loop.mark = store.size();
    x = variable("x");
    y = variable("y");
  }
  TermId variable(std::string_view name) {
    const TermId made = store.variable(name, Sort::Int);
    loop.variables.push_back(made);
    return made;
  }
  TermId number(int value) { return store.number(Number(value)); }
  TermId plus(TermId term, int value) { return store.add(term, number(value)); }
  TermId less(TermId left, TermId right) { return store.less(left, right); }
  TermId atMost(TermId left, TermId right) { return store.lessOrEqual(left, right); }

  /// What is not named stays as it is.
  void iteration(std::vector<TermId> conditions, const smt::Substitution &changes) {
    Transition transition{loop.arrival, changes};
    transition.conditions.insert(transition.conditions.end(), conditions.begin(), conditions.end());
    transition.next.emplace(loop.iterations, plus(loop.iterations, 1));
    for (const TermId each : loop.variables)
      transition.next.emplace(each, each);
    loop.transitions.push_back(std::move(transition));
  }
  bool ends() {
    loop.findDeciding(store);
    return provesEnd(interpretation, store, loop).proved;
  }

  TermStore store;
  SymbolicInterpretation interpretation{store, *findDialect(allDialects(), "fanuc-30i")};
  TermId n = store.variable("n", Sort::Int);
  TermId zero = number(0);
  LoopInstance loop{.head = {FileId(0), NodeId(0)}, .calls = {}, .iterations = zero, .mark = 0, .arrival = {}};
  TermId x = zero;
  TermId y = zero;
};

using Ends = LoopTest;

TEST_F(Ends, WhatFallsToABound) {
  iteration({less(zero, x)}, {{x, plus(x, -1)}});
  EXPECT_TRUE(ends());
}
TEST_F(Ends, WhatOnlyFalls) {
  iteration({less(x, number(9))}, {{x, plus(x, -1)}});
  EXPECT_FALSE(ends());
}
TEST_F(Ends, SumWithFactors) {
  const TermId isLow = atMost(x, number(100));
  iteration({less(zero, y), isLow, less(number(-50), x)}, {{x, plus(x, 11)}, {y, plus(y, -6)}});
  iteration({less(zero, y), less(number(-50), x), store.logicalNot(isLow)}, {{x, plus(x, -10)}, {y, plus(y, 5)}});
  EXPECT_TRUE(ends());
}
TEST_F(Ends, SumThatOnePassRaises) {
  const TermId isLow = atMost(x, number(100));
  iteration({less(zero, y), isLow, less(number(-50), x)}, {{x, plus(x, 11)}, {y, plus(y, -6)}});
  iteration({less(zero, y), less(number(-50), x), store.logicalNot(isLow)}, {{x, plus(x, -10)}, {y, plus(y, 6)}});
  EXPECT_FALSE(ends());
}
TEST_F(Ends, SpeedThatFalls) {
  iteration({atMost(zero, x)}, {{x, store.add(x, y)}, {y, plus(y, -1)}});
  EXPECT_TRUE(ends());
}
TEST_F(Ends, SpeedOfASpeed) {
  const TermId z = variable("z");
  iteration({atMost(zero, x)}, {{x, store.add(x, y)}, {y, store.add(y, z)}, {z, plus(z, -1)}});
  EXPECT_TRUE(ends());
}
TEST_F(Ends, SpeedThatRises) {
  iteration({atMost(zero, x)}, {{x, store.add(x, y)}, {y, plus(y, 1)}});
  EXPECT_FALSE(ends());
}
TEST_F(Ends, SpeedThatTurns) {
  iteration({less(zero, x)}, {{x, plus(store.add(x, y), -1)}, {y, store.negate(y)}});
  EXPECT_TRUE(ends());
}
TEST_F(Ends, SpeedThatTurnsAndDoesNotFall) {
  iteration({less(zero, x)}, {{x, store.add(x, y)}, {y, store.negate(y)}});
  EXPECT_FALSE(ends());
}
TEST_F(Ends, SidesChangeAndTheDistanceFalls) {
  iteration({less(zero, x)}, {{x, store.subtract(number(1), x)}});
  iteration({less(x, zero)}, {{x, plus(store.negate(x), -1)}});
  EXPECT_TRUE(ends());
}
TEST_F(Ends, SidesChangeAndTheDistanceStays) {
  iteration({less(zero, x)}, {{x, store.negate(x)}});
  iteration({less(x, zero)}, {{x, store.negate(x)}});
  EXPECT_FALSE(ends());
}
TEST_F(Ends, WhileEitherIsLeft) {
  iteration({store.logicalOr(less(zero, x), less(zero, y))}, {{x, plus(x, -1)}, {y, plus(y, -2)}});
  EXPECT_TRUE(ends());
}
TEST_F(Ends, WhileEitherIsLeftAndOneStays) {
  iteration({store.logicalOr(less(zero, x), less(zero, y))}, {{x, plus(x, -1)}});
  EXPECT_FALSE(ends());
}
/// Up to the top, once to 0, and up to n.
TEST_F(Ends, WhatOnePassLeavesLasts) {
  const TermId isElsewhere = store.notEqual(x, n);
  const TermId isBelow = atMost(x, number(20));
  loop.arrival = {atMost(zero, n), atMost(n, number(20))};
  iteration({isElsewhere, isBelow}, {{x, plus(x, 1)}});
  iteration({isElsewhere, store.logicalNot(isBelow)}, {{x, zero}});
  EXPECT_TRUE(ends());
}
TEST_F(Ends, ARingWithoutThePlace) {
  const TermId isElsewhere = store.notEqual(x, n);
  const TermId isBelow = atMost(x, number(20));
  loop.arrival = {atMost(zero, n)};
  iteration({isElsewhere, isBelow}, {{x, plus(x, 1)}});
  iteration({isElsewhere, store.logicalNot(isBelow)}, {{x, zero}});
  EXPECT_FALSE(ends());
}
/// The lower one is taken from the higher, which needs both to be positive.
TEST_F(Ends, WhatHoldsAtTheArrivalSupports) {
  loop.arrival = {atMost(number(1), n)};
  loop.first = {{loop.iterations, zero}, {x, n}, {y, number(12)}};
  iteration({less(x, y)}, {{y, store.subtract(y, x)}});
  iteration({less(y, x)}, {{x, store.subtract(x, y)}});
  EXPECT_TRUE(ends());
}
TEST_F(Ends, NoSupportAtTheArrival) {
  loop.first = {{loop.iterations, zero}, {x, n}, {y, number(12)}};
  iteration({less(x, y)}, {{y, store.subtract(y, x)}});
  iteration({less(y, x)}, {{x, store.subtract(x, y)}});
  EXPECT_FALSE(ends());
}

class GoesOn : public LoopTest {
protected:
  /// From x = 501, y = 502.
  std::optional<Recurrence> from(int first, int second) {
    const SymbolicValue a = interpretation.atEntry(501);
    const SymbolicValue b = interpretation.atEntry(502);
    smt::Model inputs;
    for (const auto &[value, held] : {std::pair{a, first}, std::pair{b, second}}) {
      inputs.emplace(store[value.number].name, Number(held));
      inputs.emplace(store[value.vacant].name, false);
    }
    loop.first = {{loop.iterations, zero}, {x, a.number}, {y, b.number}};
    for (const TermId each : loop.variables)
      loop.first.emplace(each, zero);
    Exploration exploration;
    exploration.loops.push_back(loop);
    return recurrenceFrom(interpretation, store, exploration, exploration.loops.front(), inputs);
  }
};

TEST_F(GoesOn, StepOverTheEnd) {
  iteration({store.notEqual(x, zero)}, {{x, plus(x, -2)}});
  EXPECT_TRUE(from(1, 0));
  EXPECT_FALSE(from(2, 0));
  EXPECT_FALSE(from(200, 0)); // behind the iterations that are followed
}
TEST_F(GoesOn, TheSpeedGrows) {
  iteration({atMost(zero, x)}, {{x, store.add(x, y)}, {y, plus(y, 1)}});
  EXPECT_TRUE(from(3, 0));
  EXPECT_TRUE(from(100, -10)); // after it has fallen
  EXPECT_FALSE(from(3, -10));
}
TEST_F(GoesOn, GrowthOfBoth) {
  iteration({less(zero, x)}, {{x, store.scale(Number(2), y)}, {y, store.scale(Number(3), x)}});
  EXPECT_TRUE(from(1, 1));
  EXPECT_FALSE(from(1, -1));
}
TEST_F(GoesOn, SidesChangeAndTheDistanceGrows) {
  iteration({store.notEqual(x, zero), less(zero, x)}, {{x, plus(store.negate(x), -1)}});
  iteration({store.notEqual(x, zero), atMost(x, zero)}, {{x, plus(store.negate(x), 1)}});
  EXPECT_TRUE(from(5, 0));
}
/// The iterations are closed under their conditions, and there is another way at the branch.
TEST_F(GoesOn, AWayOutThatComesLate) {
  iteration({less(zero, x), less(y, number(1000))}, {{x, plus(x, 1)}, {y, plus(y, 1)}});
  EXPECT_FALSE(from(1, 0));
}
TEST_F(GoesOn, AWayOutThatAnUnknownTakes) {
  const TermId unknown = store.variable("any 1", Sort::Real);
  iteration({less(zero, x), less(unknown, number(7))}, {{x, plus(x, 1)}});
  EXPECT_FALSE(from(1, 0));
}
TEST_F(GoesOn, ASignalThatStaysOff) {
  const TermId signal = store.variable("read of #1000 3", Sort::Real);
  iteration({store.notEqual(signal, number(1))}, {{x, plus(x, 1)}});
  EXPECT_TRUE(from(1, 0));
}
TEST_F(GoesOn, AClockDoesNotStandStill) {
  const TermId clock = store.variable("read of #3001 3", Sort::Real);
  iteration({less(clock, number(500))}, {{x, plus(x, 1)}});
  EXPECT_FALSE(from(1, 0));
}

} // namespace
} // namespace feedhold::prove
