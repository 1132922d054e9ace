// Guard search: conditions that fit what runs have shown, weak ones before strong ones.
#include "proof/guards/guard_search.h"

#include <gtest/gtest.h>

namespace feedhold::prove {
namespace {

GuardAtom atom(std::string text, AtomRank rank = AtomRank::Sign) {
  return {smt::TermId(0), std::move(text), "", rank, smt::TermId(0), Comparison::Above};
}

TEST(GuardSearch, TriesOneConditionBeforeTwo) {
  GuardSearch search({atom("a"), atom("b")});
  search.add(SampleKind::Breaks, {false, false});
  search.add(SampleKind::Ends, {true, true});
  EXPECT_EQ(search.next(), (Conjunction{0}));
  EXPECT_EQ(search.next(), (Conjunction{1}));
}

TEST(GuardSearch, LeavesOutWhatLetsARunBreakTheClaim) {
  GuardSearch search({atom("a"), atom("b")});
  search.add(SampleKind::Breaks, {true, false});
  search.add(SampleKind::Ends, {true, true});
  EXPECT_EQ(search.next(), (Conjunction{1}));
}

TEST(GuardSearch, JoinsTwoWhereNoOneWillDo) {
  GuardSearch search({atom("a"), atom("b")});
  search.add(SampleKind::Breaks, {true, false});
  search.add(SampleKind::Breaks, {false, true});
  search.add(SampleKind::Ends, {true, true});
  EXPECT_EQ(search.next(), (Conjunction{0, 1}));
  EXPECT_FALSE(search.next());
}

TEST(GuardSearch, LeavesOutWhatLetsNothingRun) {
  GuardSearch search({atom("a")});
  search.add(SampleKind::Breaks, {false});
  for (int run = 0; run < 20; ++run)
    search.add(SampleKind::Ends, {false});
  EXPECT_FALSE(search.next());
}

} // namespace
} // namespace feedhold::prove
