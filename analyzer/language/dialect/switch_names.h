// Switch names: how configurations, options and witnesses name the settings of a machine.
#pragma once

#include "language/dialect/dialect.h"

#include <optional>
#include <span>
#include <string_view>

namespace feedhold {

struct SwitchName {
  std::string_view name;
  Switch Switches::*which;
  bool usual = false; // what a run takes where it is not known
  /// One parameter of the control, which decides all its questions alike; else a control may answer them differently.
  bool isOneParameter = false;
};
std::span<const SwitchName> switchNames();

/// Its place in switchNames().
using SwitchId = std::uint8_t;
SwitchId idOf(Switch Switches::*which);
std::optional<SwitchId> switchNamed(std::string_view name);

} // namespace feedhold
