// ControlOptions: what the command line says of the control.  It overrides the configuration.
#pragma once

#include "language/dialect/dialect.h"

#include <optional>
#include <string>

namespace feedhold {

struct ControlOptions {
  std::optional<std::string> dialect = std::nullopt; // an id that exists
  std::optional<IncrementSystem> incrementSystem = std::nullopt;
};

} // namespace feedhold
