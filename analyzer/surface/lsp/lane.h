// Lane: work that takes long, beside the session.  Newer work on a document takes the place of older one.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>

namespace feedhold::lsp {

/// Who does the work of a lane.
enum class Worker : std::uint8_t {
  Thread, // one of its own
  Owner,  // where there are no threads: it calls workNext() when it has nothing better to do
};

class Lane {
public:
  /// Should end soon once a stop is requested, which may be before it begins; nobody wants its result then.  Called in
  /// any case, but for those that wait when the lane ends.
  using Job = std::function<void(const std::stop_token &)>;

  explicit Lane(Worker worker);
  ~Lane(); // ends it, and waits for what runs

  Lane(const Lane &) = delete;
  Lane &operator=(const Lane &) = delete;

  void submit(const std::string &document, Job job);
  /// Whatever waits or runs for it.
  void drop(const std::string &document);
  /// Nothing begins any more, and what runs is stopped.
  void end();

  // ---- of an owner that works ----
  /// There is work, and it can begin.
  bool isReady() const;
  /// Works on what waits longest; false: nothing does, or work is going on and its owner asks in the middle of it.
  bool workNext();
  bool isWorking() const;

private:
  struct Waiting {
    std::string document;
    Job job;
    std::stop_source stop;
  };
  void run();

  Worker worker_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Waiting> waiting_;
  bool isOver_ = false;
  bool isWorking_ = false;
  std::string running_;
  std::stop_source stop_;
  std::jthread thread_; // the last member: it uses the others
};

} // namespace feedhold::lsp
