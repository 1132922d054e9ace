// Tables that the FANUC series share.
#pragma once

#include "dialects/common/cell_aliases.h"
#include "dialects/common/hints.h"
#include "dialects/common/macro_b.h"
#include "dialects/common/tables.h"

namespace feedhold {

#include "dialects/common/rows.h"
inline constexpr std::array kFanucMillingGCodes = {
#include "dialects/common/fanuc_milling_g_codes.def"
};
#include "dialects/common/rows.h"
inline constexpr std::array kFanucTurningGCodes = {
#include "dialects/common/fanuc_turning_g_codes.def"
};
#include "dialects/common/rows.h"
inline constexpr std::array kFanucTurningOfA = {
#include "dialects/common/fanuc_turning_system_a.def"
};
#include "dialects/common/rows.h"
inline constexpr std::array kFanucTurningOfAB = {
#include "dialects/common/fanuc_turning_system_ab.def"
};
#include "dialects/common/rows.h"
inline constexpr std::array kFanucTurningOfB = {
#include "dialects/common/fanuc_turning_system_b.def"
};
#include "dialects/common/rows.h"
inline constexpr std::array kFanucTurningOfBC = {
#include "dialects/common/fanuc_turning_system_bc.def"
};
#include "dialects/common/rows.h"
inline constexpr std::array kFanucTurningOfC = {
#include "dialects/common/fanuc_turning_system_c.def"
};
#include "dialects/common/rows.h"
inline constexpr std::array kFanucMCodes = sorted(std::array{
#include "dialects/common/macro_b_m_codes.def"
});
#include "dialects/common/rows.h"
inline constexpr std::array kFanucVariables = {
#include "dialects/common/fanuc_variables.def"
};
#include "dialects/common/rows.h"
inline constexpr std::array kFanucMillingVariables = {
#include "dialects/common/fanuc_milling_variables.def"
};
#include "dialects/common/rows.h"
inline constexpr std::array kFanucTurningVariables = {
#include "dialects/common/fanuc_turning_variables.def"
};

/// MANUAL GUIDE i writes its cycles and figures as G1000 to G1899, and blanks and display data as G1900 to G1999. Their
/// words are data of the conversational screen, never a movement by themselves.
consteval std::array<Code, 1000> manualGuideCodes() {
  std::array<Code, 1000> codes{};
  for (std::uint16_t i = 0; i < 1000; ++i) {
    const auto tenths = static_cast<std::uint16_t>((1000 + i) * 10);
    codes[i] = Code{tenths, 0, CodeRole::OwnWords, i < 900 ? CodeAction::OtherCycle : CodeAction::Device,
                    i < 900 ? "MANUAL GUIDE i cycle or figure" : "MANUAL GUIDE i blank or display data"};
  }
  codes[900].meaning = "MANUAL GUIDE i blank: cylinder";
  codes[901].meaning = "MANUAL GUIDE i blank: hollow cylinder";
  codes[902].meaning = "MANUAL GUIDE i blank: rectangular block";
  return codes;
}
inline constexpr std::array kManualGuideCodes = manualGuideCodes();

inline constexpr auto kFanucMillingCodes = merged(kFanucMillingGCodes, kManualGuideCodes);
inline constexpr auto kFanucTurningCodesA =
    merged(kFanucTurningGCodes, kFanucTurningOfA, kFanucTurningOfAB, kManualGuideCodes);
inline constexpr auto kFanucTurningCodesB =
    merged(kFanucTurningGCodes, kFanucTurningOfAB, kFanucTurningOfB, kFanucTurningOfBC, kManualGuideCodes);
inline constexpr auto kFanucTurningCodesC =
    merged(kFanucTurningGCodes, kFanucTurningOfBC, kFanucTurningOfC, kManualGuideCodes);

inline constexpr std::array kFanucHints = joined(kMacroBHints, std::array{
                                                                   LanguageHint{TextSignal::FanucComment, 8},
                                                                   LanguageHint{TextSignal::FanucName, 4},
                                                                   LanguageHint{TextSignal::FanucEncryption, 8},
                                                                   LanguageHint{TextSignal::FanucParameterRead, 8},
                                                                   LanguageHint{TextSignal::FanucNamedVariable, 8},
                                                                   LanguageHint{TextSignal::FanucProgramName, 4},
                                                                   LanguageHint{TextSignal::FanucOffsetGroup, 8},
                                                               });

/// What all series have in common; the tables of variables are the caller's.
inline Dialect makeFanuc(MachineKind machine) {
  Dialect dialect;
  dialect.machine = machine;
  dialect.addresses = addressesOf(machine);
  if (machine == MachineKind::Turning)
    dialect.gCodesOfSystem = {kFanucTurningCodesA, kFanucTurningCodesB, kFanucTurningCodesC};
  dialect.gCodes = machine == MachineKind::Turning ? std::span<const Code>(kFanucTurningCodesA)
                                                   : std::span<const Code>(kFanucMillingCodes);
  dialect.mCodes = kFanucMCodes;
  dialect.operators = kOperators;
  dialect.bitWords = kOutputWords;
  dialect.argumentVariables = kArgumentVariables;
  dialect.behaviour.scalesByIncrements = true;
  dialect.behaviour.cutterBlocks = 3; // the fewest that a parameter chooses (19625 of Series 30i)
  if (machine == MachineKind::Milling) {
    dialect.behaviour.cutterOffsets = {{13001, 0}, {12001, 0}, 999};
    dialect.behaviour.lengthOffsets = {{11001, 0}, {10001, 0}, 999};
  } else {
    dialect.behaviour.noseOffsets = {{{2901, 17001}, {2201, 12001}, 99}, {2301, 13001}};
  }
  dialect.hasFanucParameters = true;
  dialect.switches.pointArcStops = Switch::Off; // an arc of 0 degrees
  return dialect;
}

} // namespace feedhold
