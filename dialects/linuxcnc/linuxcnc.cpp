// LinuxCNC: RS274NGC with o-words and named parameters.
#include "dialects/common/tables.h"

namespace feedhold {

const Dialect &linuxcnc();

namespace {

#include "dialects/common/rows.h"
constexpr auto kGCodes = sorted(std::array{
#include "dialects/linuxcnc/g_codes.def"
});
#include "dialects/common/rows.h"
constexpr auto kOwnMCodes = sorted(std::array{
#include "dialects/linuxcnc/m_codes.def"
});
#include "dialects/common/rows.h"
constexpr auto kVariables = sorted(std::array{
#include "dialects/linuxcnc/variables.def"
});

#include "dialects/common/rows.h"
constexpr auto kPredefinedNames = predefined(std::array{
#include "dialects/linuxcnc/predefined_names.def"
});

/// M100 to M199 run a program of that name beside the control.
consteval std::array<Code, 100> userMCodes() {
  std::array<Code, 100> codes{};
  for (std::uint16_t i = 0; i < 100; ++i)
    codes[i] = Code{static_cast<std::uint16_t>((100 + i) * 10), 0, CodeRole::Plain, CodeAction::Device, "user command"};
  return codes;
}
constexpr auto kMCodes = merged(kOwnMCodes, userMCodes());

constexpr std::array kOperators = {
    Operator{OperatorKind::Power, 5},       Operator{OperatorKind::Multiply, 4},
    Operator{OperatorKind::Divide, 4},      Operator{OperatorKind::Modulo, 4},
    Operator{OperatorKind::Add, 3},         Operator{OperatorKind::Subtract, 3},
    Operator{OperatorKind::Equal, 2},       Operator{OperatorKind::NotEqual, 2},
    Operator{OperatorKind::GreaterThan, 2}, Operator{OperatorKind::GreaterOrEqual, 2},
    Operator{OperatorKind::LessThan, 2},    Operator{OperatorKind::LessOrEqual, 2},
    Operator{OperatorKind::And, 1},         Operator{OperatorKind::Or, 1},
    Operator{OperatorKind::Xor, 1},
};

constexpr std::array kFunctions = {
    Function{FunctionKind::Sin},
    Function{FunctionKind::Cos},
    Function{FunctionKind::Tan},
    Function{FunctionKind::Asin, FunctionForm::OneArgument, FunctionDomain::MinusOneToOne},
    Function{FunctionKind::Acos, FunctionForm::OneArgument, FunctionDomain::MinusOneToOne},
    Function{FunctionKind::Atan, FunctionForm::TwoBySlash},
    Function{FunctionKind::Sqrt, FunctionForm::OneArgument, FunctionDomain::NotNegative},
    Function{FunctionKind::Abs},
    Function{FunctionKind::Round},
    Function{FunctionKind::Fix},
    Function{FunctionKind::Fup},
    Function{FunctionKind::Ln, FunctionForm::OneArgument, FunctionDomain::Positive},
    Function{FunctionKind::Exp},
    Function{FunctionKind::Exists},
};

/// What no Macro B control reads: `o100 sub`, `#<name>`.  G65 and #3000 speak against it.
constexpr std::array kHints = {
    LanguageHint{TextSignal::OWord, 30},        LanguageHint{TextSignal::AngleName, 30},
    LanguageHint{TextSignal::RsComment, 3},     LanguageHint{TextSignal::NgcFile, 10},
    LanguageHint{TextSignal::NgcCode, 8},       LanguageHint{TextSignal::MacroCall, -30},
    LanguageHint{TextSignal::MacroAlarm, -30},  LanguageHint{TextSignal::NumberedLoop, -30},
    LanguageHint{TextSignal::MacroBranch, -60}, LanguageHint{TextSignal::NgcComment, 16},
};

/// Every number may be written with a point: an integer word takes any value within 0.0001 of one.
constexpr std::array<AddressFormat, 26> addresses() {
  std::array<AddressFormat, 26> formats{};
  formats.fill({AddressKind::Flexible, true, 15});
  const auto set = [&formats](std::string_view letters, AddressKind kind) {
    for (const char letter : letters)
      formats[static_cast<std::size_t>(letter - 'A')].kind = kind;
  };
  set("XYZIJKUVW", AddressKind::Length);
  set("ABC", AddressKind::Angle);
  set("F", AddressKind::Rate);
  set("GMNOSTHL", AddressKind::Integer);
  return formats;
}

Limits limits() {
  Limits limits;
  limits.bracketDepth = 255; // sixty were tried
  limits.macroCallDepth = 10;
  limits.subprogramDepth = 10;
  limits.totalCallDepth = 10;
  limits.lastSequenceNumber = 99999999;
  limits.lastProgramNumber = 99999999;
  limits.literalDigits = 255;
  limits.mCodes = 4;
  limits.lineLength = 252; // "Command too long": a line of 253 is refused
  return limits;
}

Grammar grammar() {
  Grammar grammar;
  grammar.conditionMayBeAnyValue = true;
  grammar.sequenceZero = true;
  grammar.sequenceJumps = false;
  grammar.percentEndsProgram = true;
  grammar.macroWithWords = true;
  grammar.oWords = true;
  grammar.namedParameters = true;
  grammar.semicolonComment = true;
  grammar.anyIndex = true;
  grammar.doubleStar = true;
  grammar.smallLetters = true;
  grammar.shortForms = false;
  grammar.valueNeedsBrackets = true;
  grammar.signAddresses = "@^$"; // polar words and the number of a spindle
  return grammar;
}

Behaviour behaviour() {
  Behaviour behaviour;
  behaviour.modulo = ModuloMeaning::NotNegative;
  behaviour.integerPart = IntegerPart::Floor;
  behaviour.logic = LogicMeaning::Logical;
  behaviour.variablesMayBeVacant = false;
  behaviour.roundsWords = false;
  behaviour.assignsAfterReading = true;
  behaviour.arcDistanceModes = true;
  behaviour.cycleClearsFirst = true;
  behaviour.cycleKeepsDepth = true;
  behaviour.boringReturnsAtFeed = true;
  behaviour.oneSetOffset = true;
  behaviour.bareReferenceReturn = true;
  behaviour.dataIsAbsolute = true;
  behaviour.positionByData = true;
  behaviour.writtenOriginWaits = true;
  static constexpr std::array kStart = {CodeAction::CycleOff, CodeAction::ReturnToR};
  behaviour.startsIn = kStart;
  behaviour.endRestoresModes = true;
  behaviour.machineMoveByMode = true;
  behaviour.machineIncrement = MachineIncrement::Alarm;
  behaviour.repeatsByK = false;
  behaviour.cutterCorners = CutterCorners::Arcs;
  behaviour.cutterEntry = CutterEntry::ByItself;
  behaviour.cutterDiameterCodes = {411, 421};
  behaviour.positionIsOfCutter = true;
  behaviour.stopsAtStrayWords = true;
  behaviour.equalTolerance = 1e-4;
  behaviour.arcTolerance = 0.0282843; // interp_internal.hh, as the interpreter measures it
  behaviour.arcToleranceInch = 0.00282843;
  behaviour.arcShare = 0.001;
  return behaviour;
}

} // namespace

const Dialect &linuxcnc() {
  static const Dialect kDialect = [] {
    Dialect dialect;
    dialect.id = "linuxcnc";
    dialect.title = "LinuxCNC, RS274NGC with o-words";
    dialect.controls = "LinuxCNC 2.9, PathPilot";
    dialect.addresses = addresses();
    dialect.gCodes = kGCodes;
    dialect.mCodes = kMCodes;
    dialect.variables = kVariables;
    dialect.functions = kFunctions;
    dialect.operators = kOperators;
    dialect.limits = limits();
    dialect.grammar = grammar();
    dialect.behaviour = behaviour();
    dialect.switches.dpi = Switch::On; // `X10` is ten units
    dialect.switches.nat = Switch::On; // ATAN gives -180 to 180 degrees
    dialect.switches.ad2 = Switch::On; // "Multiple X words on one line"
    dialect.switches.m3b = Switch::On; // four M codes of different groups
    dialect.switches.lrp = Switch::On; // G0 is "coordinated linear motion"
    dialect.switches.fxy = Switch::On; // G18 drills along Y
    dialect.switches.pointArcStops = Switch::On;
    dialect.switches.besideCentreStops = Switch::On; // "K word given for arc in xy plane"
    dialect.switches.bareCycleStops = Switch::On;
    dialect.switches.motionEndsCycle = Switch::Off; // cycles are motion codes: two of them are an error
    dialect.switches.setEndsLocal = Switch::Off;    // G52 and G92 are one offset
    dialect.switches.mlg = Switch::On;              // a relation is a number, so AND and OR join conditions
    dialect.hints = kHints;
    dialect.predefinedNames = kPredefinedNames;
    dialect.inputNames = "_hal[";
    dialect.settingNames = "_ini[";
    return dialect;
  }();
  return kDialect;
}

} // namespace feedhold
