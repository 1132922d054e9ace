#include "language/dialect/switch_names.h"

#include <algorithm>
#include <array>

namespace feedhold {

namespace {

constexpr std::array kSwitchNames = {
    SwitchName{.name = "dpi", .which = &Switches::dpi, .isOneParameter = true},
    SwitchName{"ad2", &Switches::ad2},
    SwitchName{"cir", &Switches::cir},
    SwitchName{"lrp", &Switches::lrp},
    SwitchName{"m3b", &Switches::m3b},
    SwitchName{"g67", &Switches::g67, true},
    SwitchName{"v15", &Switches::v15},
    SwitchName{"nat", &Switches::nat},
    SwitchName{"sqc", &Switches::sqc},
    SwitchName{"mlg", &Switches::mlg},
    SwitchName{"f16", &Switches::f16},
    SwitchName{"mca", &Switches::mca},
    SwitchName{"gmp", &Switches::gmp},
    SwitchName{"ijk", &Switches::ijk},
    SwitchName{"fxy", &Switches::fxy, true},
    SwitchName{"ax1", &Switches::ax1, true},
    SwitchName{"sup", &Switches::sup},
    SwitchName{"odi", &Switches::odi},
    SwitchName{"short_arc_stops", &Switches::shortArcStops},
    SwitchName{"radii_differ_stops", &Switches::radiiDifferStops, true},
    SwitchName{"point_arc_stops", &Switches::pointArcStops},
    SwitchName{"beside_centre_stops", &Switches::besideCentreStops},
    SwitchName{"bare_cycle_stops", &Switches::bareCycleStops},
    SwitchName{"motion_ends_cycle", &Switches::motionEndsCycle},
    SwitchName{"set_ends_local", &Switches::setEndsLocal},
    SwitchName{"centre_stays", &Switches::centreStays},
};

SwitchId positionOf(const SwitchName *found) { return static_cast<SwitchId>(found - kSwitchNames.data()); }

} // namespace

std::span<const SwitchName> switchNames() { return kSwitchNames; }

SwitchId idOf(Switch Switches::*which) {
  return positionOf(std::ranges::find(kSwitchNames, which, &SwitchName::which));
}

std::optional<SwitchId> switchNamed(std::string_view name) {
  const auto *found = std::ranges::find(kSwitchNames, name, &SwitchName::name);
  return found == kSwitchNames.end() ? std::nullopt : std::optional(positionOf(found));
}

} // namespace feedhold
