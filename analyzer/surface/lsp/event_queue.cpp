#include "surface/lsp/event_queue.h"

namespace feedhold::lsp {

void EventQueue::push(Event event) {
  {
    const std::lock_guard lock(mutex_);
    events_.push_back(std::move(event));
  }
  arrived_.notify_one();
}

void EventQueue::cancel(const Json &id) {
  const std::lock_guard lock(mutex_);
  for (Event &event : events_) {
    const Json &message = event.incoming.json;
    if (message.is_object() && message.contains("method") && message.contains("id") && message["id"] == id)
      event.isCancelled = true;
  }
}

bool EventQueue::isEmpty() {
  if (fetch_)
    fetch_(Clock::now());
  return holdsNothing();
}

bool EventQueue::holdsNothing() const {
  const std::lock_guard lock(mutex_);
  return events_.empty();
}

std::optional<Event> EventQueue::popUntil(std::optional<Clock::time_point> until) {
  if (fetch_) {
    fetch_(holdsNothing() ? until : Clock::now());
    until = Clock::now();
  }
  std::unique_lock lock(mutex_);
  const auto isThere = [this] { return !events_.empty(); };
  if (!until)
    arrived_.wait(lock, isThere);
  else if (!arrived_.wait_until(lock, *until, isThere))
    return std::nullopt;
  Event event = std::move(events_.front());
  events_.pop_front();
  return event;
}

} // namespace feedhold::lsp
