// All kinds of obligations, in the order of obligation_kinds.def.
#pragma once

#include "proof/obligation/obligation.h"

#include <array>

namespace feedhold::prove {

inline constexpr std::array kObligationKinds = {
#define OBLIGATION(kind, name) ObligationKind::kind,
#include "proof/obligation/obligation_kinds.def"
};

} // namespace feedhold::prove
