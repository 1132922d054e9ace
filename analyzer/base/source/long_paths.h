// Paths of more than 260 characters, which Windows alone refuses.
#pragma once

namespace feedhold {

/// From here on, where the version of Windows has them: 10 of 2017 or later.
void allowLongPaths();

} // namespace feedhold
