// What speaks for a Macro B control, whoever made it, and for the kind of machine.
#pragma once

#include "language/dialect/dialect.h"

#include <array>

namespace feedhold {

inline constexpr std::array kMacroBHints = {
    LanguageHint{TextSignal::HashVariable, 1},   LanguageHint{TextSignal::WordRelation, 1},
    LanguageHint{TextSignal::MacroControl, 1},   LanguageHint{TextSignal::MacroCall, 3},
    LanguageHint{TextSignal::SubprogramCall, 1}, LanguageHint{TextSignal::MacroAlarm, 3},
    LanguageHint{TextSignal::ProgramNumber, 1},
};

/// Only turning dialects carry these: milling is what is assumed.
inline constexpr std::array kTurningHints = {
    LanguageHint{TextSignal::TurningCycle, 6},
    LanguageHint{TextSignal::SpindleLimit, 16},
    LanguageHint{TextSignal::SurfaceSpeed, 3},
    LanguageHint{TextSignal::TurretTool, 2},
    LanguageHint{TextSignal::ThreadPass, 6}, // a mill threads by G33
    LanguageHint{TextSignal::IncrementalHome, 4},
    LanguageHint{TextSignal::IncrementalAxis, 1},
    LanguageHint{TextSignal::YAxis, -4},
    LanguageHint{TextSignal::LengthOffset, -6},
    LanguageHint{TextSignal::ToolChange, -4},
    LanguageHint{TextSignal::DistanceMode, -3}, // in G code system A, `G90` is a cycle and `G91` is none
    LanguageHint{TextSignal::PlaneMove, 1},
    LanguageHint{TextSignal::LatheName, 4},
    LanguageHint{TextSignal::MillName, -4},
    LanguageHint{TextSignal::SystemBCycle, 3},
};

} // namespace feedhold
