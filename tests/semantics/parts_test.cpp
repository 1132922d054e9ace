// Each part of a state, changed by itself, is seen by whatever compares, joins, forgets, aligns or keeps whole states.
#include "dialects/registry.h"
#include "inference/absint/kept_state.h"
#include "meaning/machine/concrete_reading.h"
#include "meaning/semantics/parts.h"
#include "proof/symbolic/symbolic_interpretation.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace feedhold {
namespace {

using prove::Condition;
using prove::SymbolicCode;
using prove::SymbolicInterpretation;
using prove::SymbolicState;
using prove::SymbolicValue;

const Dialect &dialect() { return *findDialect(allDialects(), "fanuc-30i"); }

/// A state with elements in each of its lists, every part of which is `0`, false or the first code.
template <typename R> MachineState<R> plainState(R &reading) {
  MachineState<R> state;
  state.variables.set(100, {});
  state.variables.set(500, {});
  state.modalCalls.resize(2);
  for (std::uint32_t i = 0; i < state.modalCalls.size(); ++i)
    state.modalCalls[i].file = state.modalCalls[i].call = i;
  state.enteredLoops = {{1, {}}, {2, {}}};
  state.counters.resize(2);
  forEachPart(Overloaded{[&](PartId, typename R::Value &value) { value = reading.number(0); },
                         [&](PartId, typename R::ModalCode &code) { code = reading.code(0); },
                         [&](PartId, typename R::Truth &truth) { truth = reading.truth(false); }},
              state);
  return state;
}

/// The same but for one part; absent when there are no more parts.
template <typename R> std::optional<MachineState<R>> changedAt(R &reading, MachineState<R> state, std::size_t index) {
  std::size_t at = 0;
  const auto here = [&] { return at++ == index; };
  forEachPart(Overloaded{[&](PartId, typename R::Value &value) {
                           if (here())
                             value = reading.number(1);
                         },
                         [&](PartId, typename R::ModalCode &code) {
                           if (here())
                             code = reading.code(1);
                         },
                         [&](PartId, typename R::Truth &truth) {
                           if (here())
                             truth = reading.truth(true);
                         }},
              state);
  return index < at ? std::optional(state) : std::nullopt;
}

std::string nameOf(std::size_t index) {
  AbstractReading reading(dialect());
  const AbstractState state = plainState(reading);
  std::string name;
  forEachPart(
      [&, at = std::size_t{0}](PartId id, const auto &) mutable {
        if (at++ == index)
          name = "part " + std::to_string(static_cast<int>(id.part)) + ", " + std::to_string(id.key);
      },
      state);
  return name;
}

/// Calls check(changed) for each part of the plain state.
template <typename R, typename Check> void forEachChange(R &reading, const MachineState<R> &plain, Check &&check) {
  for (std::size_t i = 0;; ++i) {
    const auto changed = changedAt(reading, plain, i);
    if (!changed)
      break;
    SCOPED_TRACE(nameOf(i));
    check(*changed);
  }
}

TEST(Parts, EachKindIsInAState) {
  AbstractReading reading(dialect());
  const AbstractState state = plainState(reading);
  std::map<Part, std::size_t> counts;
  forEachPart([&](PartId id, const auto &) { ++counts[id.part]; }, state);
  for (int part = 0; part <= static_cast<int>(Part::Counter); ++part)
    EXPECT_GT(counts[static_cast<Part>(part)], 0U) << part;
  EXPECT_EQ(counts.size(), static_cast<std::size_t>(Part::Counter) + 1);
  EXPECT_EQ(counts[Part::LocalVariable], kLocalVariables + 1);
  EXPECT_EQ(counts[Part::ModalCallRepeats], 2U);
}

TEST(Parts, NoneIsVisitedTwice) {
  AbstractReading reading(dialect());
  const AbstractState state = plainState(reading);
  std::set<const void *> seen;
  forEachPart([&](PartId, const auto &part) { EXPECT_TRUE(seen.insert(&part).second); }, state);
}

TEST(Parts, TheWalkEndsAtTheFirstNo) {
  AbstractReading reading(dialect());
  const AbstractState state = plainState(reading);
  int visited = 0;
  const auto third = [&](PartId, const auto &) { return ++visited < 3; };
  EXPECT_FALSE(everyPart(third, state));
  EXPECT_EQ(visited, 3);
}

// ---- concrete ----

TEST(Parts, ConcreteStatesThatDifferInOneAreNotEqual) {
  ConcreteReading reading(dialect(), {});
  const auto plain = plainState(reading);
  forEachChange(reading, plain, [&](const auto &changed) { EXPECT_NE(changed, plain); });
}

TEST(Parts, PowerOnSetsAll) {
  const ModalTable modes(dialect());
  const ConcreteReading reading(dialect(), {});
  auto state = startState(reading, modes, {1, 2, 3});
  EXPECT_EQ(state.position[2], ConcreteValue::of(3));
  EXPECT_EQ(state.transform.scale[0], ConcreteValue::of(1));
  EXPECT_TRUE(state.cycle.peck.vacant);
  EXPECT_FALSE(state.modalCallsUnknown);
}

// ---- abstract ----

TEST(Parts, AbstractOrderAndJoinSeeEach) {
  AbstractReading reading(dialect());
  const AbstractState plain = plainState(reading);
  ASSERT_TRUE(leq(reading, plain, plain));
  forEachChange(reading, plain, [&](const AbstractState &changed) {
    EXPECT_FALSE(leq(reading, changed, plain));
    EXPECT_FALSE(leq(reading, plain, changed));
    AbstractState joined = plain;
    joinInto(reading, joined, changed);
    EXPECT_TRUE(leq(reading, plain, joined));
    EXPECT_TRUE(leq(reading, changed, joined));
    AbstractState widened = plain;
    widenInto(reading, widened, changed, {});
    EXPECT_TRUE(leq(reading, plain, widened));
    EXPECT_TRUE(leq(reading, changed, widened));
  });
}

TEST(Parts, AbstractHavocCoversEach) {
  AbstractReading reading(dialect());
  AbstractState plain = plainState(reading);
  plain.transformed = Truth::Maybe;
  AbstractState anything = plain;
  reading.havoc(anything, "", {});
  forEachChange(reading, plain, [&](AbstractState changed) {
    changed.locals[0] = AbstractValue::vacant();
    for (auto &call : changed.modalCalls)
      call.locals[0] = AbstractValue::vacant();
    AbstractState after = changed;
    reading.havoc(after, "", {});
    EXPECT_TRUE(leq(reading, changed, after));
    EXPECT_EQ(after, anything); // nothing of it is left
  });
}

TEST(Parts, KeptStatesHaveEach) {
  AbstractReading reading(dialect());
  const AbstractState plain = plainState(reading);
  StateKeeper keeper;
  keeper.keep(plain);
  forEachChange(reading, plain,
                [&](const AbstractState &changed) { EXPECT_EQ(keeper.keep(changed).state(), changed); });
}

TEST(Parts, AbstractStatesOfAnotherShapeAreAligned) {
  AbstractReading reading(dialect());
  const AbstractState plain = plainState(reading);
  AbstractState shorter = plain;
  shorter.variables.erase(100);
  shorter.enteredLoops.pop_back();
  shorter.counters.pop_back();
  AbstractState a = plain;
  AbstractState b = shorter;
  EXPECT_TRUE(align(reading, a, b));
  EXPECT_TRUE(haveSameParts(a, b));
  EXPECT_EQ(b.enteredLoops.back(), std::pair(std::uint8_t{2}, Truth::True));
  EXPECT_EQ(b.counters.back(), reading.number(0));
  EXPECT_FALSE(leq(reading, shorter, plain));
  AbstractState joined = plain;
  joinInto(reading, joined, shorter);
  EXPECT_TRUE(leq(reading, plain, joined));
  EXPECT_TRUE(leq(reading, shorter, joined));
}

TEST(Parts, OtherModalCallsAreNotTheSame) {
  AbstractReading reading(dialect());
  const AbstractState plain = plainState(reading);
  for (const auto member : {&ModalCallState<AbstractValue>::file, &ModalCallState<AbstractValue>::call}) {
    AbstractState other = plain;
    other.modalCalls.back().*member = 7;
    EXPECT_FALSE(leq(reading, other, plain));
    AbstractState joined = plain;
    joinInto(reading, joined, other);
    EXPECT_TRUE(joined.modalCalls.empty());
    EXPECT_EQ(joined.modalCallsUnknown, Truth::Maybe);
    EXPECT_TRUE(leq(reading, other, joined));
  }
}

TEST(Parts, ForgottenVariablesAreInTheOrder) {
  AbstractReading reading(dialect());
  const AbstractState plain = plainState(reading);
  AbstractState other = plain;
  other.forgotten = {{600, 700}};
  EXPECT_FALSE(leq(reading, other, plain));
  AbstractState joined = plain;
  joinInto(reading, joined, other);
  EXPECT_TRUE(leq(reading, other, joined));
}

/// What an analysis takes a program to find has every state of a control in it, mappings and loops apart.
TEST(Parts, EntryHasEachPart) {
  AbstractReading reading(dialect());
  const AbstractState entry = entryState(reading);
  forEachPart(Overloaded{[](PartId id, const AbstractValue &value) {
                           if (traitsOf(id.part).entry == PartEntry::Neutral || domainOf(id) == PartDomain::Vacancy)
                             return;
                           EXPECT_TRUE(leq(AbstractValue::anyNumber(), value)) << static_cast<int>(id.part);
                           EXPECT_EQ(value.mayBeVacant(), domainOf(id) == PartDomain::Value)
                               << static_cast<int>(id.part);
                         },
                         [](PartId, const CodeSet &code) { EXPECT_EQ(code, CodeSet::atEntry()); },
                         [](PartId, const Truth &truth) { EXPECT_EQ(truth, Truth::False); }},
              entry);
}

// ---- symbolic ----

class SymbolicParts : public ::testing::Test {
protected:
  smt::TermStore store;
  SymbolicInterpretation reading{store, dialect()};
  SymbolicState plain = plainState(reading);

  std::vector<smt::TermId> terms(const SymbolicState &state) {
    std::vector<smt::TermId> all;
    prove::forEachTerm(state, [&](smt::TermId term) { all.push_back(term); });
    return all;
  }
};

TEST_F(SymbolicParts, TermsOfEachAreVisited) {
  forEachChange(reading, plain, [&](const SymbolicState &changed) {
    EXPECT_NE(changed, plain);
    EXPECT_NE(terms(changed), terms(plain));
  });
}

TEST_F(SymbolicParts, JoinKeepsBothCases) {
  const Condition second = reading.unknownTruth();
  forEachChange(reading, plain, [&](const SymbolicState &changed) {
    SymbolicState joined = plain;
    reading.join(joined, second, changed);
    const auto taken = [&](smt::TermId choice) {
      SymbolicState state = joined;
      prove::forEachTerm(state, [&](smt::TermId &term) {
        term = smt::substitute(store, term, {{second.term, choice}});
      });
      return state;
    };
    EXPECT_EQ(taken(store.yes()), changed);
    EXPECT_EQ(taken(store.no()), plain);
  });
}

TEST_F(SymbolicParts, HavocLeavesNoneAsItWas) {
  plain.transformed = reading.unknownTruth();
  SymbolicState after = plain;
  reading.havoc(after, "", {});
  EXPECT_FALSE(after.forgotten.empty());
  after.variables = plain.variables; // the variables are among those of which nothing is known
  forEachPart(
      [&](PartId id, const auto &before, const auto &now) {
        const bool isForgotten = domainOf(id) == PartDomain::Vacancy || id.part == Part::Variable;
        EXPECT_TRUE(isForgotten || !(before == now)) << static_cast<int>(id.part) << ", " << id.key;
      },
      plain, after);
}

TEST_F(SymbolicParts, StatesOfAnotherShapeAreAligned) {
  SymbolicState shorter = plain;
  shorter.variables.erase(100);
  shorter.enteredLoops.erase(shorter.enteredLoops.begin());
  shorter.counters.clear();
  shorter.forgotten = {{600, 700}};
  SymbolicState a = plain;
  EXPECT_TRUE(prove::alignAll(reading, a, shorter));
  EXPECT_TRUE(haveSameParts(a, shorter));
  EXPECT_EQ(a.forgotten, shorter.forgotten);
  EXPECT_EQ(shorter.enteredLoops.front().second, reading.truth(true));
  shorter.modalCalls.pop_back();
  EXPECT_FALSE(prove::alignAll(reading, a, shorter));
}

} // namespace
} // namespace feedhold
