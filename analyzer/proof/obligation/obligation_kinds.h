// All kinds of obligations, in the order of obligation_kinds.def.
#pragma once

#include "proof/obligation/obligation.h"

#include <array>

namespace feedhold::prove {

inline constexpr std::array kObligationKinds = {
#define OBLIGATION(kind, name) ObligationKind::kind,
#include "proof/obligation/obligation_kinds.def"
};

/// Claims about where the tool goes.
inline constexpr std::array kSpaceKinds = {ObligationKind::KeepIn, ObligationKind::KeepOut, ObligationKind::Clearance,
                                           ObligationKind::Travel};

} // namespace feedhold::prove
