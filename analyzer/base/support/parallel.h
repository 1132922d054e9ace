// parallelFor: runs work(0) .. work(count-1) on several threads; each call fills its own slot, so that the
// result does not depend on the number of threads.
#pragma once

#include <cstddef>
#include <functional>

namespace feedhold {

/// `threads` 0 means one per processor.  The first exception of a call (by index) is thrown again here.
void parallelFor(std::size_t count, unsigned threads, const std::function<void(std::size_t)> &work);

} // namespace feedhold
