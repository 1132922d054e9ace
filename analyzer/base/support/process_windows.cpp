// Child processes on Windows.  There are no copies of a process: what asks for one gets no answer.
#include "base/support/process.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <mutex>
#include <string_view>
#include <thread>
#include <utility>

#include <windows.h>

namespace feedhold {
namespace {

thread_local std::uint64_t failures = 0;

thread_local const std::stop_token *childrenStop = nullptr;
bool isStopped() { return childrenStop != nullptr && childrenStop->stop_requested(); }
constexpr DWORD kLook = 5; // ms, between two looks at a child that says nothing

Error failed(std::string why) {
  ++failures;
  return {std::move(why)};
}

class Handle {
public:
  Handle() = default;
  explicit Handle(HANDLE handle) : handle_(handle) {}
  Handle(Handle &&other) noexcept : handle_(std::exchange(other.handle_, nullptr)) {}
  Handle &operator=(Handle &&other) noexcept {
    std::swap(handle_, other.handle_);
    return *this;
  }
  ~Handle() { close(); }
  void close() {
    if (handle_ != nullptr && handle_ != INVALID_HANDLE_VALUE)
      ::CloseHandle(handle_);
    handle_ = nullptr;
  }
  HANDLE get() const { return handle_; }

private:
  HANDLE handle_ = nullptr;
};

std::wstring wide(std::string_view text) {
  const int size = ::MultiByteToWideChar(CP_UTF8, 0, text.data(), static_cast<int>(text.size()), nullptr, 0);
  std::wstring result(static_cast<std::size_t>(size), L'\0');
  ::MultiByteToWideChar(CP_UTF8, 0, text.data(), static_cast<int>(text.size()), result.data(), size);
  return result;
}

/// As the C runtime of the child takes it apart again.
void addQuoted(std::wstring &line, const std::wstring &argument) {
  line += L'"';
  std::size_t backslashes = 0;
  for (const wchar_t c : argument) {
    if (c == L'"')
      line.append(backslashes + 1, L'\\');
    backslashes = c == L'\\' ? backslashes + 1 : 0;
    line += c;
  }
  line.append(backslashes, L'\\');
  line += L"\" ";
}

/// In the folders of PATH alone: the current folder, in which programs of others lie, is not asked.
std::wstring placeOf(const std::string &program) {
  std::array<wchar_t, 32767> path{};
  std::array<wchar_t, 32767> found{};
  const DWORD length = ::GetEnvironmentVariableW(L"PATH", path.data(), static_cast<DWORD>(path.size()));
  if (length == 0 || length >= path.size())
    return {};
  const DWORD size = ::SearchPathW(path.data(), wide(program).c_str(), L".exe", static_cast<DWORD>(found.size()),
                                   found.data(), nullptr);
  return size > 0 && size < found.size() ? std::wstring(found.data(), size) : std::wstring();
}

struct Pipe {
  Handle read;
  Handle write;
};

/// The end of the child is inherited, ours is not.
Pipe makePipe(bool childReads) {
  SECURITY_ATTRIBUTES inherited{sizeof(SECURITY_ATTRIBUTES), nullptr, TRUE};
  HANDLE read = nullptr;
  HANDLE write = nullptr;
  ::CreatePipe(&read, &write, &inherited, 0);
  ::SetHandleInformation(childReads ? write : read, HANDLE_FLAG_INHERIT, 0);
  return {Handle(read), Handle(write)};
}

Handle makeJob(const ProcessLimits &limits) {
  Handle job(::CreateJobObjectW(nullptr, nullptr));
  JOBOBJECT_EXTENDED_LIMIT_INFORMATION information = {};
  information.BasicLimitInformation.LimitFlags = JOB_OBJECT_LIMIT_PROCESS_TIME | JOB_OBJECT_LIMIT_KILL_ON_JOB_CLOSE;
  information.BasicLimitInformation.PerProcessUserTimeLimit.QuadPart = 10'000'000LL * limits.processorSeconds;
  ::SetInformationJobObject(job.get(), JobObjectExtendedLimitInformation, &information, sizeof information);
  return job;
}

void writeAll(HANDLE to, std::string_view text) {
  DWORD count = 0;
  while (!text.empty() && ::WriteFile(to, text.data(), static_cast<DWORD>(std::min<std::size_t>(text.size(), 65536)),
                                      &count, nullptr) != 0)
    text.remove_prefix(count);
}

/// Reads until the child closes its end or the time is over.  False: it was cut short.
bool readAll(HANDLE from, const ProcessLimits &limits, std::string &output) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::seconds(limits.watchdogSeconds);
  std::array<char, 4096> buffer{};
  while (Clock::now() < end && !isStopped() && output.size() <= limits.mostBytes) {
    DWORD available = 0;
    DWORD count = 0;
    if (::PeekNamedPipe(from, nullptr, 0, nullptr, &available, nullptr) == 0)
      return true;
    if (available == 0)
      ::Sleep(kLook);
    else if (::ReadFile(from, buffer.data(), static_cast<DWORD>(buffer.size()), &count, nullptr) == 0)
      return true;
    output.append(buffer.data(), count);
  }
  return false;
}

} // namespace

Result<ProcessOutput> runProgram(const std::vector<std::string> &command, const std::string &input,
                                 const ProcessLimits &limits) {
  const std::wstring place = placeOf(command.front());
  if (place.empty())
    return failed("the program `" + command.front() + "` is not installed");
  std::wstring line;
  for (const std::string &part : command)
    addQuoted(line, wide(part));
  // A child that another thread starts meanwhile would inherit these pipes, too, and hold them open.
  static std::mutex oneAtATime;
  std::unique_lock<std::mutex> alone(oneAtATime);
  Pipe in = makePipe(true);
  Pipe out = makePipe(false);
  SECURITY_ATTRIBUTES inherited{sizeof(SECURITY_ATTRIBUTES), nullptr, TRUE};
  const Handle nowhere(::CreateFileW(L"NUL", GENERIC_WRITE, FILE_SHARE_WRITE, &inherited, OPEN_EXISTING, 0, nullptr));
  STARTUPINFOW start = {};
  start.cb = sizeof start;
  start.dwFlags = STARTF_USESTDHANDLES;
  start.hStdInput = in.read.get();
  start.hStdOutput = out.write.get();
  start.hStdError = nowhere.get();
  PROCESS_INFORMATION child = {};
  const Handle job = makeJob(limits);
  if (::CreateProcessW(place.c_str(), line.data(), nullptr, nullptr, TRUE, CREATE_NO_WINDOW | CREATE_SUSPENDED, nullptr,
                       nullptr, &start, &child) == 0)
    return failed("the program `" + command.front() + "` cannot be started");
  const Handle process(child.hProcess);
  const Handle thread(child.hThread);
  ::AssignProcessToJobObject(job.get(), process.get());
  ::ResumeThread(thread.get());
  in.read.close();
  out.write.close();
  alone.unlock();
  ProcessOutput output{ProcessOutput::End::Exited, 0, ""};
  bool isWhole = false;
  {
    const std::jthread writer([&] {
      writeAll(in.write.get(), input);
      in.write.close();
    });
    isWhole = readAll(out.read.get(), limits, output.output);
    if (!isWhole)
      ::TerminateJobObject(job.get(), ERROR_NOT_ENOUGH_QUOTA);
    ::WaitForSingleObject(process.get(), INFINITE);
  }
  DWORD code = 0;
  ::GetExitCodeProcess(process.get(), &code);
  if (isWhole && code != ERROR_NOT_ENOUGH_QUOTA) {
    output.exitCode = static_cast<int>(code);
  } else {
    ++failures;
    output.end = ProcessOutput::End::Killed;
  }
  return output;
}

Result<ProcessOutput> runInChild(const std::function<std::string()> &, const ProcessLimits &, std::shared_mutex &) {
  return failed("this system makes no copies of a process");
}

ChildrenStop::ChildrenStop(const std::stop_token &stop) : outer_(childrenStop) { childrenStop = &stop; }
ChildrenStop::~ChildrenStop() { childrenStop = outer_; }

std::uint64_t failedChildren() { return failures; }

} // namespace feedhold
