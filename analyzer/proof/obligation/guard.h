// Guard: what the inputs would have to satisfy for a claim to hold, and how a contract or the program would say so.
#pragma once

#include "base/diag/diagnostic.h"

#include <optional>
#include <string>
#include <vector>

namespace feedhold::prove {

struct Guard {
  std::vector<std::string> conditions; // `#22 GT 0`; all of them together
  std::string clause;                  // of a contract: `@REQUIRE #22 GT 0`
  std::optional<FixIt> fix;            // the program raises an alarm where they do not hold; absent: it has no alarms
  bool exactOnly = false;              // with it, the claim is proved in exact arithmetic
};

} // namespace feedhold::prove
