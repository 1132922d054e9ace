// FEEDHOLD_CHECK: we are wrong, not the user's program.  On in every build; prints the reason and aborts.
#pragma once

namespace feedhold {

[[noreturn]] void checkFailed(const char *condition, const char *why, const char *file, int line);

} // namespace feedhold

#define FEEDHOLD_CHECK(condition, why)                                                                                 \
  do {                                                                                                                 \
    if (!(condition))                                                                                                  \
      ::feedhold::checkFailed(#condition, why, __FILE__, __LINE__);                                                    \
  } while (false)

#define FEEDHOLD_UNREACHABLE(why) ::feedhold::checkFailed("unreachable", why, __FILE__, __LINE__)
