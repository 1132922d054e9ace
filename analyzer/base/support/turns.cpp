#include "base/support/turns.h"

#include <utility>

namespace feedhold {

namespace {

using Clock = std::chrono::steady_clock;

/// Below what a person notices, and far above what it costs to look whether anything is to be done.
constexpr auto kBetween = std::chrono::milliseconds(10);

thread_local Turns *current = nullptr;

} // namespace

Turns::Turns(std::function<void()> others)
    : others_(std::move(others)), next_(Clock::now() + kBetween), outer_(std::exchange(current, this)) {}

Turns::~Turns() { current = outer_; }

void giveTurn() {
  Turns *const giver = current;
  if (giver == nullptr || Clock::now() < giver->next_)
    return;
  current = nullptr;
  giver->others_();
  current = giver;
  giver->next_ = Clock::now() + kBetween;
}

} // namespace feedhold
