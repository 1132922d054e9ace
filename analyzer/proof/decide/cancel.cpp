#include "proof/decide/cancel.h"

namespace feedhold::prove {

namespace {

thread_local const std::stop_token *current = nullptr;

} // namespace

StopScope::StopScope(const std::stop_token &stop) : outer_(current), children_(stop) { current = &stop; }
StopScope::~StopScope() { current = outer_; }

void throwIfCancelled() {
  if (current != nullptr && current->stop_requested())
    throw Cancelled{};
}

} // namespace feedhold::prove
