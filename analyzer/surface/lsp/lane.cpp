#include "surface/lsp/lane.h"

#include <algorithm>

namespace feedhold::lsp {

Lane::Lane() : thread_([this](const std::stop_token &end) { run(end); }) {}

Lane::~Lane() {
  thread_.request_stop();
  const std::lock_guard lock(mutex_);
  waiting_.clear();
  stop_.request_stop();
}

void Lane::submit(const std::string &document, Job job) {
  drop(document);
  {
    const std::lock_guard lock(mutex_);
    waiting_.push_back({document, std::move(job), {}});
  }
  changed_.notify_one();
}

void Lane::drop(const std::string &document) {
  const std::lock_guard lock(mutex_);
  for (Waiting &waiting : waiting_)
    if (waiting.document == document)
      waiting.stop.request_stop();
  if (running_ == document)
    stop_.request_stop();
}

void Lane::run(const std::stop_token &end) {
  for (;;) {
    Waiting next;
    std::stop_token stop;
    {
      std::unique_lock lock(mutex_);
      if (!changed_.wait(lock, end, [this] { return !waiting_.empty(); }) || end.stop_requested())
        return;
      next = std::move(waiting_.front());
      waiting_.pop_front();
      running_ = next.document;
      stop_ = next.stop;
      stop = stop_.get_token();
    }
    next.job(stop);
    const std::lock_guard lock(mutex_);
    running_.clear();
  }
}

} // namespace feedhold::lsp
