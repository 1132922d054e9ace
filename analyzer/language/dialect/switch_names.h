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
};
std::span<const SwitchName> switchNames();

/// Its place in switchNames().
using SwitchId = std::uint8_t;
SwitchId idOf(Switch Switches::*which);
std::optional<SwitchId> switchNamed(std::string_view name);

} // namespace feedhold
