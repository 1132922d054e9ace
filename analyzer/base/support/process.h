// Child processes: programs run to their end, and functions that may have to be killed.  With files, the only door to
// the operating system.
#pragma once

#include "base/support/result.h"

#include <cstdint>
#include <functional>
#include <shared_mutex>
#include <stop_token>
#include <string>
#include <vector>

namespace feedhold {

struct ProcessLimits {
  std::uint32_t processorSeconds = 60;
  /// By the clock: against children that wait for ever.
  std::uint32_t watchdogSeconds = 120;
  /// Of its output: against children that never stop talking.
  std::size_t mostBytes = std::size_t{1} << 30;
};

struct ProcessOutput {
  enum class End : std::uint8_t { Exited, Killed };
  End end;
  int exitCode; ///< after Exited
  std::string output;
};

/// Runs a program (looked up in PATH) with a text as its standard input, and gives what it wrote to standard output.
/// Refused when there is no such program.
Result<ProcessOutput> runProgram(const std::vector<std::string> &command, const std::string &input,
                                 const ProcessLimits &limits);

/// Runs a function in a copy of this process and gives the text that it returns; with another exit code than 0, it
/// threw or left by exit().  What it prints is lost.  No other thread may hold a lock that the function takes while the
/// copy is made: the caller's gate is held for that moment.
Result<ProcessOutput> runInChild(const std::function<std::string()> &function, const ProcessLimits &limits,
                                 std::shared_mutex &gate);

/// While it lives, a child of this thread is killed soon after the stop is requested: nobody waits for its answer.
class ChildrenStop {
public:
  explicit ChildrenStop(const std::stop_token &stop);
  ~ChildrenStop();
  ChildrenStop(const ChildrenStop &) = delete;
  ChildrenStop &operator=(const ChildrenStop &) = delete;

private:
  const std::stop_token *outer_;
};

/// How many children of this thread were stopped or could not be started so far: what came of them may be otherwise
/// another time.
std::uint64_t failedChildren();

} // namespace feedhold
