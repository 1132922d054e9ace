// Child processes in WebAssembly: there are none.  What asks for one gets no answer.
#include "base/support/process.h"

namespace feedhold {

namespace {

std::uint64_t failures = 0;

Error failed(std::string why) {
  ++failures;
  return {std::move(why)};
}

} // namespace

Result<ProcessOutput> runProgram(const std::vector<std::string> &command, const std::string &, const ProcessLimits &) {
  return failed("the program `" + command.front() + "` is not installed");
}

Result<ProcessOutput> runInChild(const std::function<std::string()> &, const ProcessLimits &, std::shared_mutex &) {
  return failed("this system makes no copies of a process");
}

ChildrenStop::ChildrenStop(const std::stop_token &stop) : outer_(&stop) {}
ChildrenStop::~ChildrenStop() = default;

std::uint64_t failedChildren() { return failures; }

} // namespace feedhold
