// Haas classic control: before NGC: software M16 to M18, L11.
#include "dialects/common/haas.h"

namespace feedhold {

const Dialect &haasClassic();
const Dialect &haasClassicLathe();

namespace {

constexpr auto kVariables = merged(kHaasVariables);
constexpr auto kMillingGCodes = merged(kHaasMillingGCodes, kHaasWorkCoordinates);
constexpr auto kTurningGCodes = merged(kHaasTurningGCodes, haasLatheWorkCoordinates());
// BIN and BCD came later, if at all; one- and two-argument ATAN are both in the later manuals.
constexpr auto kFunctions = [] {
  std::array<Function, kBasicFunctions.size() - 2> functions{};
  std::copy_if(kBasicFunctions.begin(), kBasicFunctions.end(), functions.begin(), [](const Function &function) {
    return function.kind != FunctionKind::Bin && function.kind != FunctionKind::Bcd;
  });
  return functions;
}();

// The newer control stands first and takes what does not tell the two apart.
constexpr auto kMillingHints = joined(kHaasHints);
constexpr auto kLatheHints = joined(kMillingHints, kTurningHints);

Dialect make(MachineKind machine) {
  Dialect dialect = makeHaas(machine);
  dialect.controls = "before NGC: software M16 to M18, L11";
  dialect.variables = kVariables;
  dialect.functions = kFunctions;
  return dialect;
}

} // namespace

const Dialect &haasClassic() {
  static const Dialect kDialect = [] {
    Dialect dialect = make(MachineKind::Milling);
    dialect.id = "haas-classic";
    dialect.title = "Haas classic control, milling";
    dialect.gCodes = kMillingGCodes;
    dialect.hints = kMillingHints;
    return dialect;
  }();
  return kDialect;
}

const Dialect &haasClassicLathe() {
  static const Dialect kDialect = [] {
    Dialect dialect = make(MachineKind::Turning);
    dialect.id = "haas-classic-lathe";
    dialect.title = "Haas classic control, turning";
    dialect.gCodes = kTurningGCodes;
    dialect.hints = kLatheHints;
    return dialect;
  }();
  return kDialect;
}

} // namespace feedhold
