#include "base/support/process.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <gtest/gtest.h>
#include <memory>
#include <thread>

namespace feedhold {
namespace {

TEST(Process, ReadsAndWrites) {
  const std::string text(200'000, 'x');
  Result<ProcessOutput> output = runProgram({"cat"}, text, {});
  ASSERT_TRUE(output.ok());
  EXPECT_EQ(output.value().end, ProcessOutput::End::Exited);
  EXPECT_EQ(output.value().exitCode, 0);
  EXPECT_EQ(output.value().output, text);
}

TEST(Process, EndsBeforeItsInput) {
  Result<ProcessOutput> output = runProgram({"false"}, std::string(200'000, 'x'), {});
  ASSERT_TRUE(output.ok());
  EXPECT_EQ(output.value().exitCode, 1);
}

TEST(Process, ChildThatLeavesPrintsNothing) {
  const std::string written = testing::TempDir() + "/left_by_exit.txt";
  std::unique_ptr<std::FILE, int (*)(std::FILE *)> file(std::fopen(written.c_str(), "w"), std::fclose);
  ASSERT_TRUE(file);
  std::fputs("once", file.get()); // in the buffer, of which the child has a copy
  std::shared_mutex gate;
  testing::internal::CaptureStdout();
  Result<ProcessOutput> output = runInChild(
      []() -> std::string {
        std::fputs("why\n", stdout);
        std::exit(113);
      },
      {}, gate);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  ASSERT_TRUE(output.ok());
  EXPECT_EQ(output.value().end, ProcessOutput::End::Exited);
  EXPECT_EQ(output.value().exitCode, 1);
  file.reset();
  EXPECT_EQ(std::filesystem::file_size(written), 4U);
}

TEST(Process, SaysThatAProgramIsMissing) {
  Result<ProcessOutput> output = runProgram({"feedhold-no-such-program"}, "", {});
  ASSERT_FALSE(output.ok());
  EXPECT_EQ(output.error().message, "the program `feedhold-no-such-program` is not installed");
}

TEST(Process, CountsWhatFailed) {
  const std::uint64_t before = failedChildren();
  (void)runProgram({"true"}, "", {});
  (void)runProgram({"false"}, "", {});
  EXPECT_EQ(failedChildren(), before);
  (void)runProgram({"feedhold-no-such-program"}, "", {});
  EXPECT_EQ(failedChildren(), before + 1);
  (void)runProgram({"sh", "-c", "kill -9 $$"}, "", {});
  EXPECT_EQ(failedChildren(), before + 2);
}

TEST(Process, WatchdogStopsWhatWaits) {
  Result<ProcessOutput> output = runProgram({"sleep", "100"}, "", {.processorSeconds = 5, .watchdogSeconds = 1});
  ASSERT_TRUE(output.ok());
  EXPECT_EQ(output.value().end, ProcessOutput::End::Killed);
}

TEST(Process, AStopEndsTheChildrenOfItsThread) {
  std::stop_source source;
  const ChildrenStop stop(source.get_token());
  EXPECT_EQ(runProgram({"sleep", "0.1"}, "", {}).value().end, ProcessOutput::End::Exited);
  std::jthread later([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    source.request_stop();
  });
  const auto begun = std::chrono::steady_clock::now();
  EXPECT_EQ(runProgram({"sleep", "60"}, "", {}).value().end, ProcessOutput::End::Killed);
  std::shared_mutex gate;
  const auto sleeps = [] {
    std::this_thread::sleep_for(std::chrono::seconds(60));
    return std::string();
  };
  EXPECT_EQ(runInChild(sleeps, {}, gate).value().end, ProcessOutput::End::Killed);
  EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(20));
  std::jthread([] { EXPECT_EQ(runProgram({"sleep", "0.1"}, "", {}).value().end, ProcessOutput::End::Exited); });
}

TEST(Process, WhatIsNotReadToTheEndCountsAsKilled) {
  const std::uint64_t before = failedChildren();
  std::stop_source source;
  const ChildrenStop stop(source.get_token());
  std::jthread later([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    source.request_stop();
  });
  // The shell has ended when the stop comes, and what it started holds the pipe.
  EXPECT_EQ(runProgram({"sh", "-c", "sleep 5 & exit 0"}, "", {}).value().end, ProcessOutput::End::Killed);
  EXPECT_EQ(failedChildren(), before + 1);
}

TEST(Process, ChildGivesItsText) {
  std::shared_mutex gate;
  Result<ProcessOutput> output = runInChild([] { return std::string("done"); }, {}, gate);
  ASSERT_TRUE(output.ok());
  EXPECT_EQ(output.value().output, "done");
  EXPECT_TRUE(gate.try_lock());
  gate.unlock();
}

TEST(Process, ChildThatReckonsForEverIsStopped) {
  std::shared_mutex gate;
  Result<ProcessOutput> output = runInChild(
      [] {
        volatile bool forEver = true;
        while (forEver) {
        }
        return std::string();
      },
      {.processorSeconds = 1, .watchdogSeconds = 20}, gate);
  ASSERT_TRUE(output.ok());
  EXPECT_EQ(output.value().end, ProcessOutput::End::Killed);
}

TEST(Process, ChildThatThrowsIsNoSecondProcess) {
  std::shared_mutex gate;
  Result<ProcessOutput> output = runInChild([]() -> std::string { throw 1; }, {}, gate);
  ASSERT_TRUE(output.ok());
  EXPECT_EQ(output.value().exitCode, 1);
}

} // namespace
} // namespace feedhold
