// FANUC Series 16i, 18i, 21i and 0i-A to 0i-D.
#include "dialects/common/fanuc.h"

namespace feedhold {

const Dialect &fanuc0i();
const Dialect &fanuc0iLathe();

namespace {

#include "dialects/common/rows.h"
constexpr std::array kAlarms = {
#include "dialects/fanuc_0i/alarms.def"
};
constexpr auto kMillingVariables = merged(kFanucVariables, kFanucMillingVariables);
constexpr auto kTurningVariables = merged(kFanucVariables, kFanucTurningVariables);

constexpr auto kFunctions = joined(kBasicFunctions, std::array{
                                                        Function{FunctionKind::Adp},
                                                        Function{FunctionKind::Prm, FunctionForm::ParameterRead},
                                                    });

// Series 30i stands first and takes what names no series.
constexpr auto kMillingHints = joined(
    kFanucHints, std::array{LanguageHint{TextSignal::FanucSeries0Comment, 10}, LanguageHint{TextSignal::MacroA, 12}});
constexpr auto kTurningHints0i = joined(kMillingHints, kTurningHints);

Limits limitsOf0i() {
  Limits limits;
  limits.macroCallDepth = 4;
  limits.subprogramDepth = 10; // of 0i-D; 16i allows four
  limits.totalCallDepth = 15;
  limits.lastSequenceNumber = 99999;
  limits.lastProgramNumber = 9999;
  limits.packsRepeats = true;
  limits.literalDigits = 8;
  limits.alarmMessageLength = 26;
  return limits;
}

Dialect make(MachineKind machine) {
  Dialect dialect = makeFanuc(machine);
  dialect.controls = "16i, 18i, 21i, 0i-A to 0i-D";
  dialect.functions = kFunctions;
  dialect.alarms = kAlarms;
  dialect.limits = limitsOf0i();
  dialect.switches.f16 = Switch::On;
  dialect.switches.gmp = Switch::Unknown;
  dialect.switches.ijk = Switch::Unknown;
  return dialect;
}

} // namespace

const Dialect &fanuc0i() {
  static const Dialect kDialect = [] {
    Dialect dialect = make(MachineKind::Milling);
    dialect.id = "fanuc-0i";
    dialect.title = "FANUC Series 0i, 16i, 18i, 21i, milling";
    dialect.variables = kMillingVariables;
    dialect.aliases = kFanucMillingAliases;
    dialect.hints = kMillingHints;
    return dialect;
  }();
  return kDialect;
}

const Dialect &fanuc0iLathe() {
  static const Dialect kDialect = [] {
    Dialect dialect = make(MachineKind::Turning);
    dialect.id = "fanuc-0i-lathe";
    dialect.title = "FANUC Series 0i, 16i, 18i, 21i, turning (G code systems A, B, C)";
    dialect.variables = kTurningVariables;
    dialect.aliases = kFanucTurningAliases;
    dialect.hints = kTurningHints0i;
    return dialect;
  }();
  return kDialect;
}

} // namespace feedhold
