// EventQueue: what the server has to do next, from the thread that reads and from those that work in the background;
// or, where there are no threads, from who is asked for it and from work in between.
#pragma once

#include "surface/lsp/transport.h"

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <optional>

namespace feedhold::lsp {

using Clock = std::chrono::steady_clock;

struct Event {
  Incoming incoming = {.kind = Incoming::Kind::End};
  std::function<void()> task = {}; // of work in the background; if there is one, it is the event
  bool isCancelled = false;        // the client does not want the answer any more
};

class EventQueue {
public:
  /// Pushes what has come.  If nothing has, waits until then, or without an end.
  using Fetch = std::function<void(std::optional<Clock::time_point> until)>;

  /// With `fetch` nobody else pushes but the thread that pops.
  explicit EventQueue(Fetch fetch = {}) : fetch_(std::move(fetch)) {}

  void push(Event event);
  /// Marks a request that still waits.
  void cancel(const Json &id);
  bool isEmpty();
  /// Absent: nothing came until then.
  std::optional<Event> popUntil(std::optional<Clock::time_point> until);

private:
  bool holdsNothing() const;

  Fetch fetch_;
  mutable std::mutex mutex_;
  std::condition_variable arrived_;
  std::deque<Event> events_;
};

} // namespace feedhold::lsp
