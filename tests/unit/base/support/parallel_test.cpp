// parallelFor: every index once, whatever the number of threads; the first failure by index is the one thrown.
#include "base/support/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <vector>

namespace feedhold {
namespace {

TEST(ParallelFor, CallsEachIndexOnce) {
  for (const unsigned threads : {0U, 1U, 2U, 7U, 64U}) {
    std::vector<int> calls(1000);
    parallelFor(calls.size(), threads, [&](std::size_t i) { ++calls[i]; });
    EXPECT_EQ(calls, std::vector<int>(1000, 1)) << threads << " threads";
  }
}

TEST(ParallelFor, DoesNothingForNoWork) {
  parallelFor(0, 4, [](std::size_t) { FAIL(); });
}

TEST(ParallelFor, ThrowsTheFirstFailureAfterAllWorkIsDone) {
  for (const unsigned threads : {1U, 4U}) {
    std::atomic<int> done{0};
    std::string thrown;
    try {
      parallelFor(100, threads, [&](std::size_t i) {
        ++done;
        if (i % 10 == 3)
          throw std::runtime_error(std::to_string(i));
      });
    } catch (const std::runtime_error &error) {
      thrown = error.what();
    }
    EXPECT_EQ(thrown, "3");
    EXPECT_EQ(done, 100);
  }
}

} // namespace
} // namespace feedhold
