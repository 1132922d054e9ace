// What happens when one of our own assumptions is broken.
#include "base/support/check.h"

#include <cstdio>
#include <cstdlib>

namespace feedhold {

void checkFailed(const char *condition, const char *why, const char *file, int line) {
  std::fprintf(stderr, "feedhold: internal error at %s:%d: %s (%s)\n", file, line, why, condition);
  std::abort();
}

} // namespace feedhold
