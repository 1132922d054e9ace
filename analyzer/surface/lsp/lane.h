// Lane: a thread for work that takes long.  Newer work on a document takes the place of older one.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>

namespace feedhold::lsp {

class Lane {
public:
  /// Should end soon once a stop is requested, which may be before it begins; nobody wants its result then.  Called in
  /// any case, but for those that wait when the lane ends.
  using Job = std::function<void(const std::stop_token &)>;

  Lane();
  ~Lane(); // stops what runs and waits for its end

  Lane(const Lane &) = delete;
  Lane &operator=(const Lane &) = delete;

  void submit(const std::string &document, Job job);
  /// Whatever waits or runs for it.
  void drop(const std::string &document);

private:
  struct Waiting {
    std::string document;
    Job job;
    std::stop_source stop;
  };
  void run(const std::stop_token &end);

  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::deque<Waiting> waiting_;
  std::string running_;
  std::stop_source stop_;
  std::jthread thread_; // the last member: it uses the others
};

} // namespace feedhold::lsp
