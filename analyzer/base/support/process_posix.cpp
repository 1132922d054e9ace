#include "base/support/process.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <memory>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace feedhold {
namespace {

/// What a shell says of a command that it does not find.
constexpr int kNotFound = 127;
/// Of a function in a child that ended without its text.
constexpr int kGaveUp = 1;

thread_local std::uint64_t failures = 0;

thread_local const std::stop_token *childrenStop = nullptr;
bool isStopped() { return childrenStop != nullptr && childrenStop->stop_requested(); }
/// Between two looks at it.
constexpr std::int64_t kLook = 20; // ms

Error failed(std::string why) {
  ++failures;
  return {std::move(why)};
}

struct Pipe {
  int read = -1;
  int write = -1;
};

Result<Pipe> makePipe() {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0)
    return failed(std::string("no pipe: ") + std::strerror(errno));
  return Pipe{ends[0], ends[1]};
}

void limitChild(const ProcessLimits &limits) {
  const rlimit processor{limits.processorSeconds, limits.processorSeconds + 1};
  setrlimit(RLIMIT_CPU, &processor);
  const rlimit noCore{0, 0};
  setrlimit(RLIMIT_CORE, &noCore);
}

/// A library that gives up in a copy of the process may print why, and leave by exit(): neither its text nor what this
/// process has not yet written may come out of the copy.
void silenceCopy() {
  const int nowhere = open("/dev/null", O_WRONLY);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
  std::atexit([] { _exit(kGaveUp); });
}

/// Reads until the child closes its end or the time is over; then waits for the child, which is killed if it lives on.
ProcessOutput collect(pid_t child, int from, const ProcessLimits &limits) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::seconds(limits.watchdogSeconds);
  ProcessOutput result{ProcessOutput::End::Exited, 0, ""};
  std::array<char, 4096> buffer{};
  bool isCutShort = false; // also of one that has ended meanwhile: its output was not read to the end
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
    pollfd wait{from, POLLIN, 0};
    const std::int64_t pause = childrenStop != nullptr ? std::min<std::int64_t>(left, kLook) : left;
    const bool isOver = left <= 0 || isStopped();
    const int ready = isOver ? 0 : poll(&wait, 1, static_cast<int>(pause));
    if ((ready < 0 && errno == EINTR) || (ready == 0 && !isOver && pause < left))
      continue;
    if (ready <= 0 || result.output.size() > limits.mostBytes) {
      kill(child, SIGKILL);
      isCutShort = true;
      break;
    }
    const ssize_t count = read(from, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR)
      continue;
    if (count <= 0)
      break;
    result.output.append(buffer.data(), static_cast<std::size_t>(count));
  }
  close(from);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && !isCutShort) {
    result.exitCode = WEXITSTATUS(status);
  } else {
    ++failures;
    result.end = ProcessOutput::End::Killed;
  }
  return result;
}

void writeAll(int to, const std::string &text) {
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t count = write(to, text.data() + done, text.size() - done);
    if (count < 0 && errno != EINTR)
      return;
    done += count > 0 ? static_cast<std::size_t>(count) : 0;
  }
}

} // namespace

Result<ProcessOutput> runProgram(const std::vector<std::string> &command, const std::string &input,
                                 const ProcessLimits &limits) {
  // A file, not a pipe: a child that ends early must not stop us in the middle of writing.
  std::unique_ptr<std::FILE, int (*)(std::FILE *)> file(std::tmpfile(), std::fclose);
  if (!file || std::fwrite(input.data(), 1, input.size(), file.get()) != input.size() || std::fflush(file.get()) != 0)
    return failed(std::string("no temporary file: ") + std::strerror(errno));
  const int inputFile = fileno(file.get());
  lseek(inputFile, 0, SEEK_SET);
  std::vector<char *> arguments;
  for (const std::string &part : command)
    arguments.push_back(const_cast<char *>(part.c_str()));
  arguments.push_back(nullptr);
  Result<Pipe> pipe = makePipe();
  if (!pipe)
    return pipe.error();
  const pid_t child = fork();
  if (child < 0)
    return failed(std::string("no child process: ") + std::strerror(errno));
  if (child == 0) {
    limitChild(limits);
    const int nowhere = open("/dev/null", O_WRONLY);
    if (dup2(inputFile, STDIN_FILENO) < 0 || dup2(pipe.value().write, STDOUT_FILENO) < 0 ||
        dup2(nowhere, STDERR_FILENO) < 0)
      _exit(kNotFound);
    execvp(arguments[0], arguments.data());
    _exit(kNotFound);
  }
  close(pipe.value().write);
  ProcessOutput output = collect(child, pipe.value().read, limits);
  if (output.end == ProcessOutput::End::Exited && output.exitCode == kNotFound)
    return failed("the program `" + command.front() + "` is not installed");
  return output;
}

Result<ProcessOutput> runInChild(const std::function<std::string()> &function, const ProcessLimits &limits,
                                 std::shared_mutex &gate) {
  Result<Pipe> pipe = makePipe();
  if (!pipe)
    return pipe.error();
  gate.lock();
  const pid_t child = fork();
  if (child != 0)
    gate.unlock();
  if (child < 0)
    return failed(std::string("no child process: ") + std::strerror(errno));
  if (child == 0) {
    limitChild(limits);
    close(pipe.value().read);
    silenceCopy();
    try {
      writeAll(pipe.value().write, function());
    } catch (...) {
      _exit(kGaveUp); // nothing may leave this copy of the process
    }
    _exit(0);
  }
  close(pipe.value().write);
  return collect(child, pipe.value().read, limits);
}

ChildrenStop::ChildrenStop(const std::stop_token &stop) : outer_(childrenStop) { childrenStop = &stop; }
ChildrenStop::~ChildrenStop() { childrenStop = outer_; }

std::uint64_t failedChildren() { return failures; }

} // namespace feedhold
