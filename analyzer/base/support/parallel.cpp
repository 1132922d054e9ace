// parallelFor by one shared counter: each thread takes the next index until none is left.
#include "base/support/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace feedhold {

namespace {

/// Keeps the exception of the lowest index, so that the one thrown does not depend on timing.
class FirstFailure {
public:
  void record(std::size_t index, std::exception_ptr error) {
    const std::lock_guard lock(mutex_);
    if (error_ && index_ < index)
      return;
    index_ = index;
    error_ = std::move(error);
  }
  void rethrow() const {
    if (error_)
      std::rethrow_exception(error_);
  }

private:
  std::mutex mutex_;
  std::size_t index_ = 0;
  std::exception_ptr error_;
};

unsigned threadsFor(std::size_t count, unsigned asked) {
  const unsigned wanted = asked != 0 ? asked : std::max(1U, std::thread::hardware_concurrency());
  return static_cast<unsigned>(std::min<std::size_t>(wanted, count));
}

} // namespace

void parallelFor(std::size_t count, unsigned threads, const std::function<void(std::size_t)> &work) {
  std::atomic<std::size_t> next{0};
  FirstFailure failure;
  const auto worker = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        work(i);
      } catch (...) {
        failure.record(i, std::current_exception());
      }
    }
  };
  {
    std::vector<std::jthread> helpers;
    for (unsigned i = 1; i < threadsFor(count, threads); ++i)
      helpers.emplace_back(worker);
    worker();
  }
  failure.rethrow();
}

} // namespace feedhold
