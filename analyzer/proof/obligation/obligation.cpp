#include "proof/obligation/obligation_kinds.h"

namespace feedhold::prove {

std::string_view nameOf(ObligationKind kind) {
  constexpr std::array<std::string_view, kObligationKinds.size()> kNames = {
#define OBLIGATION(kind, name) name,
#include "proof/obligation/obligation_kinds.def"
  };
  return kNames[static_cast<std::size_t>(kind)];
}

} // namespace feedhold::prove
