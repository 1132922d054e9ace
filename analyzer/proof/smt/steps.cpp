#include "proof/smt/steps.h"

#include <algorithm>
#include <limits>

namespace feedhold::smt {
namespace {

thread_local Steps *innermost = nullptr;
thread_local const Steps *outermost = nullptr;

} // namespace

Steps::Steps(std::uint64_t most, AtEnd atEnd)
    : outer_(innermost), most_(outer_ ? std::min(most, outer_->most_ - outer_->spent_) : most), atEnd_(atEnd) {
  innermost = this;
  if (!outer_)
    outermost = this;
}

Steps::~Steps() {
  innermost = outer_;
  if (outer_)
    outer_->take(spent_);
  else
    outermost = nullptr;
}

void spend(std::uint64_t steps) {
  if (!innermost)
    return;
  innermost->take(steps);
  if (innermost->areUsedUp() && innermost->atEnd_ == Steps::AtEnd::Throw)
    throw OutOfSteps{};
}

bool areStepsUsedUp() { return outermost && outermost->areUsedUp(); }

std::uint64_t stepsLeft() {
  return innermost ? innermost->most_ - innermost->spent_ : std::numeric_limits<std::uint64_t>::max();
}

} // namespace feedhold::smt
