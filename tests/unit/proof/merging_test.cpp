// Merging: what is true on each of two paths, and nothing else, is true on the one that they make.
#include "proof/explore/merging.h"

#include "proof/decide/discharge.h"
#include "unit/proof/explored.h"

#include <gtest/gtest.h>

namespace feedhold::prove {
namespace {

using smt::TermId;

class MergingTest : public ::testing::Test {
protected:
  MergingTest() : program("O1\nM99\n"), store(program.start.store()) {}

  Path path(TermId condition, int held) {
    Path made{.at = {FileId(0), NodeId(0)},
              .state = program.start.entry(),
              .conditions = {condition},
              .frames = {},
              .loops = {},
              .moved = store.no()};
    made.state.variables.set(500, program.start.interpretation().number(held));
    return made;
  }
  bool follows(const Path &from, TermId goal) { return discharge(store, {from.conditions, goal}).proved(); }
  TermId holds(const Path &at, int value) {
    return store.equal(at.state.variables.find(500)->number, store.number(smt::Number(value)));
  }

  Explored program;
  smt::TermStore &store;
};

TEST_F(MergingTest, TheStateIsThatOfTheOneOrOfTheOther) {
  const TermId condition = store.variable("c", smt::Sort::Bool);
  Path merged = path(condition, 1);
  mergeInto(program.start.interpretation(), merged, path(store.logicalNot(condition), 2));
  EXPECT_TRUE(follows(merged, store.implies(condition, holds(merged, 1))));
  EXPECT_TRUE(follows(merged, store.implies(store.logicalNot(condition), holds(merged, 2))));
  EXPECT_FALSE(follows(merged, holds(merged, 1)));
  EXPECT_FALSE(follows(merged, store.no()));
}

TEST_F(MergingTest, PathsThatShareNoConditionMayBothBeMeant) {
  Path merged = path(store.variable("a", smt::Sort::Bool), 1);
  mergeInto(program.start.interpretation(), merged, path(store.variable("b", smt::Sort::Bool), 2));
  EXPECT_TRUE(follows(merged, store.logicalOr(holds(merged, 1), holds(merged, 2))));
  EXPECT_FALSE(follows(merged, holds(merged, 1)));
  EXPECT_FALSE(follows(merged, holds(merged, 2)));
}

TEST_F(MergingTest, ForgettingKeepsWhatBothPathsHold) {
  const TermId both = store.variable("both", smt::Sort::Bool);
  const TermId first = store.variable("a", smt::Sort::Bool);
  Path merged = path(both, 1);
  merged.conditions.push_back(first);
  Path other = path(both, 2);
  other.conditions.push_back(store.logicalNot(first));
  mergeAndForget(program.start.interpretation(), merged, std::move(other));
  EXPECT_EQ(merged.conditions, std::vector{both});
  EXPECT_TRUE(follows(merged, store.logicalOr(holds(merged, 1), holds(merged, 2))));
  EXPECT_FALSE(follows(merged, holds(merged, 1)));
}

TEST_F(MergingTest, ForgettingMakesLargeValuesUnknown) {
  SymbolicValue large = program.start.interpretation().number(0);
  for (int i = 0; i < 40; ++i)
    large.number =
        store.ite(store.variable("c" + std::to_string(i), smt::Sort::Bool), store.number(smt::Number(i)), large.number);
  Path merged = path(store.yes(), 1);
  merged.state.variables.set(500, large);
  Path other = merged;
  mergeAndForget(program.start.interpretation(), merged, std::move(other));
  EXPECT_NE(merged.state.variables.find(500)->number, large.number);
  EXPECT_EQ(merged.state.variables.find(500)->vacant, store.no());
  EXPECT_FALSE(
      follows(merged, store.lessOrEqual(merged.state.variables.find(500)->number, store.number(smt::Number(40)))));
}

/// Each way round goes past an exit.  What leads there is forgotten where the ways meet.
constexpr std::string_view kLongLoop = "O1\n"
                                       "#1=0\n"
                                       "N1IF[#2GT0]GOTO2\n"
                                       "IF[#1GT100000]GOTO9\n"
                                       "GOTO3\n"
                                       "N2IF[#1GT100001]GOTO9\n"
                                       "N3#1=#1+1\n"
                                       "GOTO1\n"
                                       "N9M30\n";

TEST(Forgetting, FollowsEveryProgramToItsEnd) {
  const Explored program(kLongLoop, {.mostWork = 1});
  EXPECT_FALSE(program.found.incomplete);
  EXPECT_TRUE(program.found.forgets);
}

TEST(Forgetting, IsNoReasonForALoopWithoutEnd) {
  Explored program(kLongLoop, {.mostWork = 1});
  ASSERT_EQ(program.found.loops.size(), 1U);
  EXPECT_FALSE(loopRow(program.context(), program.found.loops.front().head).verdict == Verdict::Refuted);
}

TEST_F(MergingTest, OnlyPathsAtOnePlaceInOneCallAreMerged) {
  const Path here = path(store.yes(), 1);
  Path elsewhere = here;
  elsewhere.at.node = NodeId(1);
  EXPECT_TRUE(canMerge(here, here));
  EXPECT_FALSE(canMerge(here, elsewhere));
}

TEST(Worklist, GivesThePathsThatOthersMayMeetLaterFirst) {
  Explored program("O1\nM99\n");
  Worklist list;
  const auto add = [&](Worklist::Position position, std::uint32_t node) {
    list.add(std::move(position), {.at = {FileId(0), NodeId(node)},
                                   .state = program.start.entry(),
                                   .conditions = {},
                                   .frames = {},
                                   .loops = {},
                                   .moved = program.start.store().no()});
  };
  add({2}, 2);
  add({1, 5}, 5);
  add({1, 5}, 6);
  EXPECT_EQ(list.size(), 3U);
  EXPECT_EQ(list.takeFirst().size(), 2U);
  EXPECT_EQ(list.takeFirst().front().at.node, NodeId(2));
  EXPECT_TRUE(list.empty());
}

} // namespace
} // namespace feedhold::prove
