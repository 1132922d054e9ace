// EventQueue: what the server has to do next, from the thread that reads and from those that work in the background.
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
  std::function<void()> task = {}; // of a thread in the background; if there is one, it is the event
  bool isCancelled = false;        // the client does not want the answer any more
};

class EventQueue {
public:
  void push(Event event);
  /// Marks a request that still waits.
  void cancel(const Json &id);
  bool isEmpty() const;
  /// Absent: nothing came until then.
  std::optional<Event> popUntil(std::optional<Clock::time_point> until);

private:
  mutable std::mutex mutex_;
  std::condition_variable arrived_;
  std::deque<Event> events_;
};

} // namespace feedhold::lsp
