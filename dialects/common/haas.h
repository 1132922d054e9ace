// Tables that the two generations of Haas controls share.
#pragma once

#include "dialects/common/cell_aliases.h"
#include "dialects/common/hints.h"
#include "dialects/common/macro_b.h"
#include "dialects/common/tables.h"

namespace feedhold {

#include "dialects/common/rows.h"
inline constexpr std::array kHaasMillingGCodes = {
#include "dialects/common/haas_milling_g_codes.def"
};
#include "dialects/common/rows.h"
inline constexpr std::array kHaasTurningGCodes = {
#include "dialects/common/haas_turning_g_codes.def"
};
#include "dialects/common/rows.h"
inline constexpr std::array kHaasMCodes = sorted(std::array{
#include "dialects/common/haas_m_codes.def"
});
#include "dialects/common/rows.h"
inline constexpr std::array kHaasVariables = {
#include "dialects/common/haas_variables.def"
};

/// G110 to G129: twenty more work coordinate systems.
consteval std::array<Code, 20> haasWorkCoordinates() {
  std::array<Code, 20> codes{};
  for (std::uint16_t i = 0; i < 20; ++i)
    codes[i] = {static_cast<std::uint16_t>((110 + i) * 10), 12, CodeRole::Plain, CodeAction::ExtendedWorkOffset,
                "additional work coordinate system"};
  return codes;
}
inline constexpr std::array kHaasWorkCoordinates = haasWorkCoordinates();

/// The lathe uses G112 and G113 otherwise.
consteval std::array<Code, 16> haasLatheWorkCoordinates() {
  std::array<Code, 16> codes{};
  std::copy(kHaasWorkCoordinates.begin() + 4, kHaasWorkCoordinates.end(), codes.begin());
  return codes;
}

inline constexpr auto kHaasHints =
    joined(kMacroBHints,
           std::array{
               LanguageHint{TextSignal::HaasComment, 8}, LanguageHint{TextSignal::HaasName, 4},
               LanguageHint{TextSignal::HaasLocalCall, 6}, LanguageHint{TextSignal::HaasCode, 6},
               LanguageHint{TextSignal::HaasSetting, 8}, LanguageHint{TextSignal::HaasTimer, 12},
               LanguageHint{TextSignal::HaasConditionalReturn, 12}, LanguageHint{TextSignal::HaasProgramNumber, 6},
               LanguageHint{TextSignal::MitsubishiOffsetGroup, 2}, // work offsets are group 12 here too
           });

/// What both generations have in common; the tables of codes and variables are the caller's.
inline Dialect makeHaas(MachineKind machine) {
  Dialect dialect;
  dialect.machine = machine;
  dialect.addresses = addressesOf(machine);
  dialect.addresses['P' - 'A'].literalMayHavePoint = true; // G04 P1.5 is in seconds
  dialect.mCodes = kHaasMCodes;
  dialect.operators = kOperators;
  dialect.aliases = kHaasAliases;
  dialect.argumentVariables = kArgumentVariables;
  dialect.limits.bracketDepth = 255; // no limit is documented
  dialect.limits.macroCallDepth = 9;
  dialect.limits.subprogramDepth = 9;
  dialect.limits.totalCallDepth = 9;
  dialect.limits.lastSequenceNumber = 99999;
  dialect.limits.lastProgramNumber = 99999;
  dialect.limits.literalDigits = 15; // no limit is documented
  dialect.limits.firstAlarmNumber = 1;
  dialect.limits.lastAlarmNumber = 999;
  dialect.limits.alarmMessageLength = 34;
  dialect.limits.mCodes = 1; // "Only one M-code is allowed in each line of a program" (operator's manuals)
  dialect.grammar.conditionMayBeAnyValue = true;
  dialect.grammar.thenMayBeWords = true;
  dialect.grammar.thenMayBeOmitted = true;
  dialect.grammar.conditionalReturn = true;
  dialect.grammar.commentsMayNest = true; // programs that shops saved from the control hold such comments
  dialect.grammar.sequenceZero = true;
  dialect.behaviour.returnTargetIsLocal = true;
  dialect.behaviour.machineMoveByMode = true;
  dialect.behaviour.repeatsByK = false; // K is the smallest peck
  dialect.behaviour.oneBlockCycles = true;
  dialect.behaviour.cyclesNeedXY = true;
  dialect.behaviour.cyclesAreScaled = false;
  dialect.behaviour.feedByIncrements = true;
  dialect.behaviour.localShiftIsVariable = true;
  dialect.behaviour.referenceCancelsLength = true;
  dialect.behaviour.bareReferenceReturn = true; // Mill operator's manual, G28: without an axis code, all axes
  dialect.behaviour.logicOfIntegerParts = true;
  if (machine == MachineKind::Milling) {
    dialect.behaviour.toolChangeReturnsZ = true;
    dialect.behaviour.toolChangeStopsCoolant = true;
    dialect.behaviour.cutterOffsets = {{2401, 0}, {2601, 0}, 200};
    dialect.behaviour.lengthOffsets = {{2001, 0}, {2201, 0}, 200};
  }
  dialect.numbers = NumberModel::Either;
  dialect.switches.mlg = Switch::On; // a relation is a number, so AND and OR join conditions
  dialect.switches.v15 = Switch::On; // geometry stands before wear
  return dialect;
}

} // namespace feedhold
