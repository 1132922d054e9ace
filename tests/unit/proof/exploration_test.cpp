// Exploration: which paths of a program are followed, and what is recorded on them.
#include "unit/proof/explored.h"

#include <gtest/gtest.h>

namespace feedhold::prove {
namespace {

TEST(Exploration, FollowsBothWaysOfACondition) {
  const Explored program("O1\nIF[#1GT5]GOTO10\n#2=1\nM99\nN10#2=2\nM99\n");
  EXPECT_EQ(program.found.exits.size(), 2U);
  EXPECT_FALSE(program.found.incomplete);
}

TEST(Exploration, LeavesOutAWayThatContradictsThePath) {
  const Explored program("O1\n#1=3\nIF[#1GT5]GOTO10\nM99\nN10#3000=1\n");
  EXPECT_EQ(program.found.exits.size(), 1U);
  EXPECT_TRUE(program.found.stopSites.empty());
}

TEST(Exploration, RecordsWhereARunMayStop) {
  const Explored program("O1\n#2=1/#1\nIF[#1GT5]THEN#3000=7\nM99\n");
  ASSERT_EQ(program.found.stopSites.size(), 2U);
  EXPECT_EQ(program.found.stopSites[0].alarm, AlarmKind::DivideByZero);
  EXPECT_EQ(program.lineOf(program.found.stopSites[0].place), 2U);
  EXPECT_FALSE(program.found.stopSites[1].alarm); // `#3000=`
  EXPECT_EQ(program.lineOf(program.found.stopSites[1].place), 3U);
}

TEST(Exploration, MeetsALoopOnceInAnyOfItsPasses) {
  const Explored program("O1\nWHILE[#1LT#2]DO1\n#1=#1+1\nEND1\nM99\n");
  ASSERT_EQ(program.found.loops.size(), 1U);
  EXPECT_EQ(program.found.loops[0].transitions.size(), 1U);
  EXPECT_EQ(program.found.exits.size(), 1U);
}

TEST(Exploration, FollowsEachPassWhereItIsAsked) {
  const Explored program("O1\n#1=0\nWHILE[#1LT3]DO1\n#500=#1\n#1=#1+1\nEND1\nM99\n",
                         {.loops = LoopTreatment::EachIteration});
  ASSERT_EQ(program.found.exits.size(), 1U);
  smt::TermStore &store = const_cast<Explored &>(program).start.store();
  EXPECT_EQ(program.found.exits[0].state.variables.find(500)->number, store.number(smt::Number(2)));
}

TEST(Exploration, TellsThatAPathComesBackToItsState) {
  const Explored program("O1\nWHILE[1EQ1]DO1\nEND1\nM99\n", {.loops = LoopTreatment::EachIteration});
  EXPECT_EQ(program.found.repeats.size(), 1U);
  EXPECT_TRUE(program.found.exits.empty());
}

TEST(Exploration, RecordsEachWriteThatOthersSee) {
  const Explored program("O1\n#500=1\n#500=#500\n#1=2\nG10L2P1X1.\nM99\n", {.keepWrites = true});
  std::vector<std::uint32_t> written;
  for (const WriteInstance &write : program.found.writes)
    if (write.variable && *write.variable >= 100 && (written.empty() || written.back() != *write.variable))
      written.push_back(*write.variable);
  EXPECT_EQ(written, (std::vector<std::uint32_t>{500, 5221}));
}

TEST(Exploration, AWriteToAnUnknownNumberMayBeToAny) {
  const Explored program("O1\n#[#1]=1\nM99\n", {.keepWrites = true});
  EXPECT_TRUE(std::any_of(program.found.writes.begin(), program.found.writes.end(),
                          [](const WriteInstance &write) { return !write.variable; }));
}

TEST(Exploration, AProgramThatIsNotThereMayDoAnything) {
  const Explored program("O1\nM98P2\nM99\n");
  ASSERT_EQ(program.found.unmodelledCalls.size(), 1U);
  EXPECT_EQ(program.found.unmodelledCalls.front().why, "O2 was not supplied");
  EXPECT_EQ(program.found.exits.size(), 1U);
}

TEST(Exploration, ReturnsToANumberBothAsCalledAndAsStarted) {
  constexpr std::string_view kText = "O1\n#500=1\nM99P10\nN10#500=2\nM30\n";
  EXPECT_EQ(Explored(kText).found.exits.size(), 2U);
  EXPECT_EQ(Explored(kText, {.mayBeCalled = false}).found.exits.size(), 1U);
}

TEST(Exploration, GivesUpAfterTheStepsThatItHas) {
  const Explored program("O1\n#2=#1\n#3=#2\n#4=#3\nM99\n", {.mostSteps = 2});
  EXPECT_EQ(program.found.incomplete, "gave up after 3 steps, in O1");
}

} // namespace
} // namespace feedhold::prove
