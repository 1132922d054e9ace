// ControlOptions: what the command line says of the control.  It overrides the configuration.
#pragma once

#include "language/dialect/dialect.h"

#include <optional>
#include <string>
#include <vector>

namespace feedhold {

/// One of the settings of a machine (switch_names.h).
struct SwitchSetting {
  Switch Switches::*which;
  Switch value;
};

struct ControlOptions {
  std::optional<std::string> dialect = std::nullopt; // an id that exists
  std::optional<IncrementSystem> incrementSystem = std::nullopt;
  std::optional<GCodeSystem> gCodeSystem = std::nullopt; // of lathes that have several
  std::vector<SwitchSetting> switches = {};
};

} // namespace feedhold
