// Turns: given now and then, only to who waits, and to nobody from what is done in one.
#include "base/support/turns.h"

#include <gtest/gtest.h>
#include <thread>

namespace feedhold {
namespace {

constexpr auto kLong = std::chrono::milliseconds(30);

TEST(Turns, NobodyWaits) { giveTurn(); }

TEST(Turns, NowAndThen) {
  int count = 0;
  const Turns turns([&] { ++count; });
  for (int i = 0; i < 1000; ++i)
    giveTurn();
  EXPECT_LT(count, 100);
  std::this_thread::sleep_for(kLong);
  const int before = count;
  giveTurn();
  giveTurn();
  EXPECT_EQ(count, before + 1);
}

TEST(Turns, NoneInATurnAndTheInnermostFirst) {
  int outer = 0;
  int inner = 0;
  const auto work = [] {
    std::this_thread::sleep_for(kLong);
    giveTurn();
  };
  const Turns turns([&] {
    ++outer;
    work();
    const Turns others([&] { ++inner; });
    work();
  });
  work();
  EXPECT_EQ(outer, 1);
  EXPECT_EQ(inner, 1);
  work();
  EXPECT_EQ(outer, 2);
}

} // namespace
} // namespace feedhold
