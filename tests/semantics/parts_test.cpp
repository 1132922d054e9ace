// Each part of a state, changed by itself, is seen by whatever compares, joins, forgets, aligns or keeps whole states.
#include "dialects/registry.h"
#include "inference/absint/kept_state.h"
#include "meaning/machine/concrete_interpretation.h"
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
template <typename R> MachineState<R> plainState(R &interpretation) {
  MachineState<R> state;
  state.variables.set(100, {});
  state.variables.set(500, {});
  state.modalCalls.resize(2);
  for (std::uint32_t i = 0; i < state.modalCalls.size(); ++i)
    state.modalCalls[i].file = state.modalCalls[i].call = i;
  state.enteredLoops = {{1, {}}, {2, {}}};
  state.counters.resize(2);
  state.savedCodes = {{0, {}}, {3, {}}};
  state.savedWords = {{0, {}}, {1, {}}};
  forEachPart(Overloaded{[&](PartId, typename R::Value &value) { value = interpretation.number(0); },
                         [&](PartId, typename R::ModalCode &code) { code = interpretation.code(0); },
                         [&](PartId, typename R::Truth &truth) { truth = interpretation.truth(false); }},
              state);
  return state;
}

/// The same but for one part; absent when there are no more parts.
template <typename R>
std::optional<MachineState<R>> changedAt(R &interpretation, MachineState<R> state, std::size_t index) {
  std::size_t at = 0;
  const auto here = [&] { return at++ == index; };
  forEachPart(Overloaded{[&](PartId, typename R::Value &value) {
                           if (here())
                             value = interpretation.number(1);
                         },
                         [&](PartId, typename R::ModalCode &code) {
                           if (here())
                             code = interpretation.code(1);
                         },
                         [&](PartId, typename R::Truth &truth) {
                           if (here())
                             truth = interpretation.truth(true);
                         }},
              state);
  return index < at ? std::optional(state) : std::nullopt;
}

std::string nameOf(std::size_t index) {
  AbstractInterpretation interpretation(dialect());
  const AbstractState state = plainState(interpretation);
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
template <typename R, typename Check>
void forEachChange(R &interpretation, const MachineState<R> &plain, Check &&check) {
  for (std::size_t i = 0;; ++i) {
    const auto changed = changedAt(interpretation, plain, i);
    if (!changed)
      break;
    SCOPED_TRACE(nameOf(i));
    check(*changed);
  }
}

TEST(Parts, EachKindIsInAState) {
  AbstractInterpretation interpretation(dialect());
  const AbstractState state = plainState(interpretation);
  std::map<Part, std::size_t> counts;
  forEachPart([&](PartId id, const auto &) { ++counts[id.part]; }, state);
  for (int part = 0; part <= static_cast<int>(Part::RestoresModes); ++part)
    EXPECT_GT(counts[static_cast<Part>(part)], 0U) << part;
  EXPECT_EQ(counts.size(), static_cast<std::size_t>(Part::RestoresModes) + 1);
  EXPECT_EQ(counts[Part::LocalVariable], kLocalVariables + 1);
  EXPECT_EQ(counts[Part::ModalCallRepeats], 2U);
}

TEST(Parts, NoneIsVisitedTwice) {
  AbstractInterpretation interpretation(dialect());
  const AbstractState state = plainState(interpretation);
  std::set<const void *> seen;
  forEachPart([&](PartId, const auto &part) { EXPECT_TRUE(seen.insert(&part).second); }, state);
}

TEST(Parts, TheWalkEndsAtTheFirstNo) {
  AbstractInterpretation interpretation(dialect());
  const AbstractState state = plainState(interpretation);
  int visited = 0;
  const auto third = [&](PartId, const auto &) { return ++visited < 3; };
  EXPECT_FALSE(everyPart(third, state));
  EXPECT_EQ(visited, 3);
}

// ---- concrete ----

TEST(Parts, ConcreteStatesThatDifferInOneAreNotEqual) {
  ConcreteInterpretation interpretation(dialect(), {});
  const auto plain = plainState(interpretation);
  forEachChange(interpretation, plain, [&](const auto &changed) { EXPECT_NE(changed, plain); });
}

TEST(Parts, PowerOnSetsAll) {
  const ModalTable modes(dialect());
  const ConcreteInterpretation interpretation(dialect(), {});
  auto state = startState(interpretation, modes, {1, 2, 3});
  EXPECT_EQ(state.position[2], ConcreteValue::of(3));
  EXPECT_EQ(state.transform.scale[0], ConcreteValue::of(1));
  EXPECT_TRUE(state.cycle.peck.vacant);
  EXPECT_FALSE(state.modalCallsUnknown);
}

// ---- abstract ----

TEST(Parts, AbstractOrderAndJoinSeeEach) {
  AbstractInterpretation interpretation(dialect());
  const AbstractState plain = plainState(interpretation);
  ASSERT_TRUE(leq(interpretation, plain, plain));
  forEachChange(interpretation, plain, [&](const AbstractState &changed) {
    EXPECT_FALSE(leq(interpretation, changed, plain));
    EXPECT_FALSE(leq(interpretation, plain, changed));
    AbstractState joined = plain;
    joinInto(interpretation, joined, changed);
    EXPECT_TRUE(leq(interpretation, plain, joined));
    EXPECT_TRUE(leq(interpretation, changed, joined));
    AbstractState widened = plain;
    widenInto(interpretation, widened, changed, {});
    EXPECT_TRUE(leq(interpretation, plain, widened));
    EXPECT_TRUE(leq(interpretation, changed, widened));
  });
}

TEST(Parts, AbstractHavocCoversEach) {
  AbstractInterpretation interpretation(dialect());
  AbstractState plain = plainState(interpretation);
  plain.transformed = Truth::Maybe;
  AbstractState anything = plain;
  interpretation.havoc(anything, "", {});
  forEachChange(interpretation, plain, [&](AbstractState changed) {
    changed.locals[0] = AbstractValue::vacant();
    for (auto &call : changed.modalCalls)
      call.locals[0] = AbstractValue::vacant();
    AbstractState after = changed;
    interpretation.havoc(after, "", {});
    changed.corner = anything.corner; // PartHavoc::Neutral
    EXPECT_TRUE(leq(interpretation, changed, after));
    EXPECT_EQ(after, anything); // nothing of it is left
  });
}

TEST(Parts, KeptStatesHaveEach) {
  AbstractInterpretation interpretation(dialect());
  const AbstractState plain = plainState(interpretation);
  StateKeeper keeper;
  keeper.keep(plain);
  forEachChange(interpretation, plain,
                [&](const AbstractState &changed) { EXPECT_EQ(keeper.keep(changed).state(), changed); });
}

TEST(Parts, AbstractStatesOfAnotherShapeAreAligned) {
  AbstractInterpretation interpretation(dialect());
  const AbstractState plain = plainState(interpretation);
  AbstractState shorter = plain;
  shorter.variables.erase(100);
  shorter.enteredLoops.pop_back();
  shorter.counters.pop_back();
  AbstractState a = plain;
  AbstractState b = shorter;
  EXPECT_TRUE(align(interpretation, a, b));
  EXPECT_TRUE(haveSameParts(a, b));
  EXPECT_EQ(b.enteredLoops.back(), std::pair(std::uint8_t{2}, Truth::True));
  EXPECT_EQ(b.counters.back(), interpretation.number(0));
  EXPECT_FALSE(leq(interpretation, shorter, plain));
  AbstractState joined = plain;
  joinInto(interpretation, joined, shorter);
  EXPECT_TRUE(leq(interpretation, plain, joined));
  EXPECT_TRUE(leq(interpretation, shorter, joined));
}

TEST(Parts, OtherModalCallsAreNotTheSame) {
  AbstractInterpretation interpretation(dialect());
  const AbstractState plain = plainState(interpretation);
  for (const auto member : {&ModalCallState<AbstractValue>::file, &ModalCallState<AbstractValue>::call}) {
    AbstractState other = plain;
    other.modalCalls.back().*member = 7;
    EXPECT_FALSE(leq(interpretation, other, plain));
    AbstractState joined = plain;
    joinInto(interpretation, joined, other);
    EXPECT_TRUE(joined.modalCalls.empty());
    EXPECT_EQ(joined.modalCallsUnknown, Truth::Maybe);
    EXPECT_TRUE(leq(interpretation, other, joined));
  }
}

TEST(Parts, HavockedVariablesAreInTheOrder) {
  AbstractInterpretation interpretation(dialect());
  const AbstractState plain = plainState(interpretation);
  AbstractState other = plain;
  other.havocked = {{600, 700}};
  EXPECT_FALSE(leq(interpretation, other, plain));
  AbstractState joined = plain;
  joinInto(interpretation, joined, other);
  EXPECT_TRUE(leq(interpretation, other, joined));
}

/// What an analysis takes a program to find has every state of a control in it, mappings and loops apart.
TEST(Parts, EntryHasEachPart) {
  AbstractInterpretation interpretation(dialect());
  const AbstractState entry = entryState(interpretation);
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
  SymbolicInterpretation interpretation{store, dialect()};
  SymbolicState plain = plainState(interpretation);

  std::vector<smt::TermId> terms(const SymbolicState &state) {
    std::vector<smt::TermId> all;
    prove::forEachTerm(state, [&](smt::TermId term) { all.push_back(term); });
    return all;
  }
};

TEST_F(SymbolicParts, TermsOfEachAreVisited) {
  forEachChange(interpretation, plain, [&](const SymbolicState &changed) {
    EXPECT_NE(changed, plain);
    EXPECT_NE(terms(changed), terms(plain));
  });
}

TEST_F(SymbolicParts, JoinKeepsBothCases) {
  const Condition second = interpretation.unknownTruth();
  forEachChange(interpretation, plain, [&](const SymbolicState &changed) {
    SymbolicState joined = plain;
    interpretation.join(joined, second, changed);
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
  plain.transformed = interpretation.unknownTruth();
  SymbolicState after = plain;
  interpretation.havoc(after, "", {});
  EXPECT_FALSE(after.havocked.empty());
  after.variables = plain.variables; // the variables are among those of which nothing is known
  forEachPart(
      [&](PartId id, const auto &before, const auto &now) {
        const bool isHavocked = domainOf(id) == PartDomain::Vacancy || id.part == Part::Variable ||
                                traitsOf(id.part).havoc == PartHavoc::Neutral;
        EXPECT_TRUE(isHavocked || !(before == now)) << static_cast<int>(id.part) << ", " << id.key;
      },
      plain, after);
}

TEST_F(SymbolicParts, StatesOfAnotherShapeAreAligned) {
  SymbolicState shorter = plain;
  shorter.variables.erase(100);
  shorter.enteredLoops.erase(shorter.enteredLoops.begin());
  shorter.counters.clear();
  shorter.havocked = {{600, 700}};
  SymbolicState a = plain;
  EXPECT_TRUE(prove::alignAll(interpretation, a, shorter));
  EXPECT_TRUE(haveSameParts(a, shorter));
  EXPECT_EQ(a.havocked, shorter.havocked);
  EXPECT_EQ(shorter.enteredLoops.front().second, interpretation.truth(true));
  shorter.modalCalls.pop_back();
  EXPECT_FALSE(prove::alignAll(interpretation, a, shorter));
}

} // namespace
} // namespace feedhold
