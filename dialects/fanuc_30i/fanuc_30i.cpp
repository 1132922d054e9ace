// FANUC Series 30i, 31i, 32i and 0i-F.
#include "dialects/common/fanuc.h"

namespace feedhold {

const Dialect &fanuc30i();
const Dialect &fanuc30iLathe();

namespace {

#include "dialects/common/rows.h"
constexpr std::array k30iVariables = {
#include "dialects/fanuc_30i/variables.def"
};
#include "dialects/common/rows.h"
constexpr std::array kAlarms = {
#include "dialects/fanuc_30i/alarms.def"
};
constexpr auto kMillingVariables = merged(kFanucVariables, kFanucMillingVariables, k30iVariables);
constexpr auto kTurningVariables = merged(kFanucVariables, kFanucTurningVariables, k30iVariables);

constexpr auto kMillingAliases = joined(kFanucMillingAliases, kFanucAxisAliases);
constexpr auto kTurningAliases = joined(kFanucTurningAliases, kFanucAxisAliases);

constexpr auto kFunctions = joined(kBasicFunctions, std::array{
                                                        Function{FunctionKind::Pow, FunctionForm::TwoByComma},
                                                        Function{FunctionKind::Adp},
                                                        Function{FunctionKind::Prm, FunctionForm::ParameterRead},
                                                        Function{FunctionKind::Ax},
                                                        Function{FunctionKind::AxNumber},
                                                    });

constexpr auto kMillingHints = joined(kFanucHints, std::array{
                                                       LanguageHint{TextSignal::FanucSeries30Comment, 10},
                                                       LanguageHint{TextSignal::FanucFolderLine, 8},
                                                       LanguageHint{TextSignal::FanucLargeVariable, 3},
                                                   });
constexpr auto kTurningHints30i = joined(kMillingHints, kTurningHints);

Limits limitsOf30i() {
  Limits limits;
  limits.macroCallDepth = 5;
  limits.subprogramDepth = 10;
  limits.totalCallDepth = 15;
  limits.lastSequenceNumber = 99999999;
  limits.lastProgramNumber = 99999999; // eight digits by parameter, on by default in new machines
  limits.packsRepeats = true;
  limits.literalDigits = 12;
  limits.alarmMessageLength = 31;
  return limits;
}

Dialect make(MachineKind machine) {
  Dialect dialect = makeFanuc(machine);
  dialect.controls = "30i, 31i, 32i, 0i-F";
  dialect.functions = kFunctions;
  dialect.alarms = kAlarms;
  dialect.limits = limitsOf30i();
  dialect.switches.f16 = Switch::Unknown;
  dialect.switches.mca = Switch::Unknown;
  dialect.switches.gmp = Switch::Unknown;
  dialect.switches.ijk = Switch::Unknown;
  return dialect;
}

} // namespace

const Dialect &fanuc30i() {
  static const Dialect kDialect = [] {
    Dialect dialect = make(MachineKind::Milling);
    dialect.id = "fanuc-30i";
    dialect.title = "FANUC Series 30i, milling";
    dialect.variables = kMillingVariables;
    dialect.aliases = kMillingAliases;
    dialect.hints = kMillingHints;
    return dialect;
  }();
  return kDialect;
}

const Dialect &fanuc30iLathe() {
  static const Dialect kDialect = [] {
    Dialect dialect = make(MachineKind::Turning);
    dialect.id = "fanuc-30i-lathe";
    dialect.title = "FANUC Series 30i, turning (G code systems A, B, C)";
    dialect.variables = kTurningVariables;
    dialect.aliases = kTurningAliases;
    dialect.hints = kTurningHints30i;
    return dialect;
  }();
  return kDialect;
}

} // namespace feedhold
