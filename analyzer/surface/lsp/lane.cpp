#include "surface/lsp/lane.h"

namespace feedhold::lsp {

Lane::Lane(Worker worker)
    : worker_(worker), thread_(worker == Worker::Thread ? std::jthread([this] { run(); }) : std::jthread()) {}

Lane::~Lane() { end(); }

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

void Lane::end() {
  {
    const std::lock_guard lock(mutex_);
    isOver_ = true;
    waiting_.clear();
    stop_.request_stop();
  }
  changed_.notify_one();
}

bool Lane::isReady() const {
  const std::lock_guard lock(mutex_);
  return worker_ == Worker::Owner && !isWorking_ && !waiting_.empty();
}

bool Lane::isWorking() const {
  const std::lock_guard lock(mutex_);
  return isWorking_;
}

bool Lane::workNext() {
  Waiting next;
  std::stop_token stop;
  {
    const std::lock_guard lock(mutex_);
    if (isOver_ || isWorking_ || waiting_.empty())
      return false;
    next = std::move(waiting_.front());
    waiting_.pop_front();
    isWorking_ = true;
    running_ = next.document;
    stop_ = next.stop;
    stop = stop_.get_token();
  }
  next.job(stop);
  const std::lock_guard lock(mutex_);
  isWorking_ = false;
  running_.clear();
  return true;
}

void Lane::run() {
  for (;;) {
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return isOver_ || !waiting_.empty(); });
      if (isOver_)
        return;
    }
    workNext();
  }
}

} // namespace feedhold::lsp
