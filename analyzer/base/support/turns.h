// Turns: where there are no threads, work that takes long lets others do theirs now and then.
#pragma once

#include <chrono>
#include <functional>

namespace feedhold {

/// While it lives, the work of this thread calls `others` now and then, but not from what these do themselves.
/// They must not throw.
class Turns {
public:
  explicit Turns(std::function<void()> others);
  ~Turns();
  Turns(const Turns &) = delete;
  Turns &operator=(const Turns &) = delete;

private:
  friend void giveTurn();
  std::function<void()> others_;
  std::chrono::steady_clock::time_point next_;
  Turns *outer_;
};

/// To be called again and again by work that takes long, where it holds no lock.  Costs nothing where nobody waits.
void giveTurn();

} // namespace feedhold
