// Haas Next Generation Control: NGC, software 100.x.
#include "dialects/common/haas.h"

namespace feedhold {

const Dialect &haasNgc();
const Dialect &haasNgcLathe();

namespace {

#include "dialects/common/rows.h"
constexpr std::array kExtraVariables = {
#include "dialects/haas_ngc/variables.def"
};
constexpr auto kVariables = merged(kHaasVariables, kExtraVariables);
constexpr auto kMillingGCodes = merged(kHaasMillingGCodes, kHaasWorkCoordinates);
constexpr auto kTurningGCodes = merged(kHaasTurningGCodes, haasLatheWorkCoordinates());
constexpr auto kFunctions = joined(kBasicFunctions);

constexpr auto kMillingHints = joined(kHaasHints, std::array{LanguageHint{TextSignal::HaasVariable, 6}});
constexpr auto kLatheHints = joined(kMillingHints, kTurningHints);

Dialect make(MachineKind machine) {
  Dialect dialect = makeHaas(machine);
  dialect.controls = "NGC, software 100.x";
  dialect.variables = kVariables;
  dialect.aliases = kHaasNgcAliases;
  dialect.functions = kFunctions;
  dialect.grammar.fractionalVariable = true;
  dialect.limits.lastSequenceNumber = 99999999;
  return dialect;
}

} // namespace

const Dialect &haasNgc() {
  static const Dialect kDialect = [] {
    Dialect dialect = make(MachineKind::Milling);
    dialect.id = "haas-ngc";
    dialect.title = "Haas Next Generation Control, milling";
    dialect.gCodes = kMillingGCodes;
    dialect.hints = kMillingHints;
    return dialect;
  }();
  return kDialect;
}

const Dialect &haasNgcLathe() {
  static const Dialect kDialect = [] {
    Dialect dialect = make(MachineKind::Turning);
    dialect.id = "haas-ngc-lathe";
    dialect.title = "Haas Next Generation Control, turning";
    dialect.gCodes = kTurningGCodes;
    dialect.hints = kLatheHints;
    return dialect;
  }();
  return kDialect;
}

} // namespace feedhold
