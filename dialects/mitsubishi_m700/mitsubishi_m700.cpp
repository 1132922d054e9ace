// Mitsubishi MELDAS 60/64, M70, M700, M80, M800; MAZATROL controls read EIA programs in nearly the same language.
#include "dialects/common/cell_aliases.h"
#include "dialects/common/hints.h"
#include "dialects/common/macro_b.h"
#include "dialects/common/tables.h"

namespace feedhold {

const Dialect &mitsubishiM700();
const Dialect &mitsubishiM700Lathe();

namespace {

#include "dialects/common/rows.h"
constexpr auto kMillingGCodes = sorted(std::array{
#include "dialects/mitsubishi_m700/milling_g_codes.def"
});
#include "dialects/common/rows.h"
constexpr auto kTurningGCodes = sorted(std::array{
#include "dialects/mitsubishi_m700/turning_g_codes.def"
});
#include "dialects/common/rows.h"
constexpr auto kMCodes = sorted(std::array{
#include "dialects/common/macro_b_m_codes.def"
});
#include "dialects/common/rows.h"
constexpr auto kVariables = sorted(std::array{
#include "dialects/mitsubishi_m700/variables.def"
});
#include "dialects/common/rows.h"
constexpr std::array kAlarms = {
#include "dialects/mitsubishi_m700/alarms.def"
};

constexpr auto kFunctions = joined(kBasicFunctions, std::array{Function{FunctionKind::Pow, FunctionForm::TwoByComma}});

constexpr auto kMillingHints = joined(kMacroBHints, std::array{
                                                        LanguageHint{TextSignal::MitsubishiComment, 8},
                                                        LanguageHint{TextSignal::MitsubishiName, 4},
                                                        LanguageHint{TextSignal::MitsubishiVariable, 6},
                                                        LanguageHint{TextSignal::MitsubishiOffsetGroup, 12},
                                                        LanguageHint{TextSignal::MitsubishiParameterRead, 12},
                                                        // Weak: it is also written for controls without it.
                                                        LanguageHint{TextSignal::BlockIf, 1},
                                                        LanguageHint{TextSignal::EiaFile, 12},
                                                    });
/// On lathes of other makers `#16001` is an offset, too.
constexpr auto kMachiningHints = joined(kMillingHints, std::array{LanguageHint{TextSignal::MitsubishiToolOffset, 12}});
constexpr auto kLatheHints = joined(kMillingHints, kTurningHints);

Dialect make(MachineKind machine) {
  Dialect dialect;
  dialect.controls = "M60, M70, M700, M80, M800";
  dialect.machine = machine;
  dialect.addresses = addressesOf(machine);
  dialect.addresses['P' - 'A'].literalMayHavePoint = true; // P is in the manual's list of addresses with a point
  dialect.mCodes = kMCodes;
  dialect.variables = kVariables;
  dialect.aliases = kMitsubishiAliases;
  dialect.bitWords = kOutputWords;
  dialect.functions = kFunctions;
  dialect.operators = kOperators;
  dialect.alarms = kAlarms;
  dialect.argumentVariables = kArgumentVariables;
  dialect.limits.lastLoopNumber = 127;
  dialect.limits.loopDepth = 27;
  dialect.limits.macroCallDepth = 4;
  dialect.limits.subprogramDepth = 8;
  dialect.limits.totalCallDepth = 8;
  dialect.limits.lastSequenceNumber = 99999999; // 99999 up to M70
  dialect.limits.lastProgramNumber = 99999999;
  dialect.limits.literalDigits = 12;
  dialect.limits.firstAlarmNumber = 1;
  dialect.limits.lastAlarmNumber = 9999;
  dialect.limits.alarmMessageLength = 31;
  dialect.grammar.blockIf = true;
  dialect.grammar.thenMayBeWords = true;
  dialect.grammar.wordMayBeUnbracketed = true;
  dialect.grammar.callStartsAtSequence = true;
  dialect.behaviour.machineMoveByMode = true;
  dialect.behaviour.distanceModeByWord = true;
  dialect.behaviour.scalingIsFollowed = false; // of named axes only, about a centre that counts from G90 or G91
  dialect.behaviour.cutterBlocks = 5;
  if (machine == MachineKind::Milling) {
    dialect.behaviour.cutterOffsets = {{2401, 12001}, {2601, 13001}, 200};
    dialect.behaviour.lengthOffsets = {{2001, 10001}, {2201, 11001}, 200};
  }
  dialect.behaviour.machineIncrement = MachineIncrement::Distance;
  dialect.behaviour.absoluteBehindMappings = true;
  dialect.numbers = NumberModel::Either;
  dialect.switches.centreStays = Switch::On;
  dialect.switches.mca = Switch::On; // the number is shown as it is
  return dialect;
}

} // namespace

const Dialect &mitsubishiM700() {
  static const Dialect kDialect = [] {
    Dialect dialect = make(MachineKind::Milling);
    dialect.id = "mitsubishi-m700";
    dialect.title = "Mitsubishi M700 and its family, milling";
    dialect.gCodes = kMillingGCodes;
    dialect.hints = kMachiningHints;
    return dialect;
  }();
  return kDialect;
}

const Dialect &mitsubishiM700Lathe() {
  static const Dialect kDialect = [] {
    Dialect dialect = make(MachineKind::Turning);
    dialect.id = "mitsubishi-m700-lathe";
    dialect.title = "Mitsubishi M700 and its family, turning (G code list 2)";
    dialect.gCodes = kTurningGCodes;
    dialect.hints = kLatheHints;
    return dialect;
  }();
  return kDialect;
}

} // namespace feedhold
