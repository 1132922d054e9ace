// Dialect: what a control is, as plain data.  Every difference between controls is a row or a field here; nothing
// outside dialects/ knows the name of a maker.  Sources of the facts: parity.md of each dialect.
#pragma once

#include "base/support/decimal.h"
#include "language/dialect/code.h"
#include "language/dialect/text_signals.h"
#include "language/dialect/words.h"

#include <array>
#include <compare>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace feedhold {

enum class MachineKind : std::uint8_t { Milling, Turning };

/// What the number after an address is.
enum class AddressKind : std::uint8_t {
  None,     // the address does not exist on this control
  Length,   // mm or inch: scaled by the least input increment when written without a decimal point
  Angle,    // degrees: scaled likewise
  Rate,     // F: feed; scaled by its own increment
  Integer,  // G M S T D H L N O: no decimal point in a literal (S and G take one on some controls)
  Flexible, // P Q E K R and the like: integer or length, as the G code in force decides
};

struct AddressFormat {
  AddressKind kind = AddressKind::None;
  bool literalMayHavePoint = false;
  std::uint8_t integerDigits = 8; // most digits before the point
};

enum class VariableKind : std::uint8_t { Vacant, Local, Common, Retentive, System };
enum class VariableAccess : std::uint8_t { ReadWrite, ReadOnly, WriteOnly };
/// Value when a program starts: what the control guarantees, else Unknown.
enum class VariableStart : std::uint8_t { Vacant, Unknown };
/// Whether every machine has the range, or only one with an option.
enum class VariableOption : std::uint8_t { Always, Optional };

/// What reading and writing a variable means.
enum class VariableRole : std::uint8_t {
  Plain,            // local and common variables: keeps what was written
  Stored,           // a cell of the control that keeps what was written (offsets, #3003)
  Volatile,         // may change between any two reads: positions in motion, states of the control
  Signal,           // the same, and 0 or 1: one input
  SignalWord,       // the same, and a whole number: several inputs as its bits
  Clock,            // the same, and never less than before, unless the program sets it
  Alarm,            // writing stops the program
  MessageStop,      // writing stops until cycle start
  ModalCode,        // first + group - 1: G code in force of a modal group
  ModalWord,        // other modal words (F, S, T ..), by the table of the control
  BlockEndPosition, // first + axis - 1, as the four below: programmed end point of the preceding block
  MachinePosition,
  WorkPosition,
  SkipPosition,
  WorkOffset,           // in steps of 20 from #5201: external, G54 .. G59
  AdditionalWorkOffset, // of G54.1, G154
  SetOffset,            // of G92
  WorkRotation,         // of a coordinate system, in degrees: in force when it is selected next
  Reference,            // machine coordinates to which G28 returns
  SecondReference,
  Pi,
  EulersNumber,
  Predefined, // a name of the control: its PredefinedName says what it shows
};

struct VariableRange {
  std::uint32_t first;
  std::uint32_t last;
  VariableKind kind;
  VariableAccess access = VariableAccess::ReadWrite;
  VariableStart start = VariableStart::Unknown;
  VariableOption option = VariableOption::Always;
  VariableRole role = VariableRole::Plain;
  std::string_view name = {};    // `_ALM` where the control names it
  std::string_view meaning = {}; // "macro alarm"
};

/// What a name of the control shows (`#<_metric>`).
enum class NameSource : std::uint8_t {
  Variable,        // what the variable of this number holds
  MachinePosition, // the machine coordinate of the axis of this index
  CodeInForce,     // 1 while the code is in force, else 0
  CodeTenths,      // ten times the number of the code in force in the group of this one
  CodeWhole,       // ten times the whole part of that number
  Kept,            // the same from read to read, but where the semantics says otherwise
  NotFollowed,     // any number of its range at each read
};
enum class NameRange : std::uint8_t { Any, NotNegative, Flag };

/// Read-only.  The number of the variable is that of its place in the table, from kFirstPredefinedName on.
struct PredefinedName {
  VariableRange row; // with the name, in small letters
  NameSource source;
  std::uint32_t detail; // number of the variable, index of the axis, or ten times the number of the code
  NameRange range;
};
/// No text can write a number as high; names that programs choose begin behind (kFirstNamedVariable).
inline constexpr std::uint32_t kFirstPredefinedName = 0x7f000000, kLastPredefinedName = 0x7fffffff;
constexpr bool isPredefinedName(std::uint32_t variable) {
  return kFirstPredefinedName <= variable && variable <= kLastPredefinedName;
}

/// When two numbers name one cell of the control.
enum class AliasWhen : std::uint8_t {
  Always,
  WithV15,    // parameter 6000#3
  WithoutV15, // with the parameter the numbers are tool offsets
  Perhaps,    // no source decides: both outcomes
};
/// Numbers that name cells which have other numbers too: first + i * period + j, for j below width, is the cell
/// cell + i * rowStep + j * columnStep.
struct CellAlias {
  std::uint32_t first;
  std::uint32_t last;
  std::uint32_t period;
  std::uint32_t width;
  std::uint32_t cell;
  std::uint32_t rowStep;
  std::uint32_t columnStep;
  AliasWhen when;
  /// The other number; absent for a number that the row does not have.
  constexpr std::optional<std::uint32_t> cellOf(std::uint32_t number) const {
    const std::uint32_t place = number - first;
    if (number < first || number > last || place % period >= width)
      return std::nullopt;
    return cell + place / period * rowStep + place % period * columnStep;
  }
};
/// A variable that reads and writes others as the bits of one number.
struct BitWord {
  std::uint32_t word;
  std::uint32_t firstBit; // the variable of bit 0
  std::uint32_t sureBits; // so many have the control for certain ..
  std::uint32_t bits;     // .. and so many perhaps
};

/// Exponent: the result has to be a number that the control can hold.
enum class FunctionDomain : std::uint8_t { Any, NotNegative, Positive, MinusOneToOne, NotPole, Bcd, Exponent };
/// How the arguments are written.
enum class FunctionForm : std::uint8_t {
  OneArgument,   // SIN[a]
  OneOrTwo,      // ATAN[a], ATAN[a]/[b], ATAN[a,b]
  TwoBySlash,    // only ATAN[a]/[b]
  TwoByComma,    // POW[a,b]
  ParameterRead, // PRM[n], PRM[n,bit], PRM[n]/[axis], PRM[n,bit]/[axis]
};

struct Function {
  FunctionKind kind;
  FunctionForm form = FunctionForm::OneArgument;
  FunctionDomain domain = FunctionDomain::Any;
};

struct Operator {
  OperatorKind kind;
  std::uint8_t precedence; // higher binds tighter
};

enum class AlarmKind : std::uint8_t {
#define ALARM(kind, meaning) kind,
#include "language/dialect/alarms.def"
};

/// The control's own number for an alarm: "PS0112".
struct AlarmNumber {
  AlarmKind kind;
  std::string_view number;
};

struct Limits {
  std::uint8_t bracketDepth = 5;   // function brackets included
  std::uint8_t lastLoopNumber = 3; // DO 1 .. lastLoopNumber
  std::uint8_t loopDepth = 3;
  std::uint8_t macroCallDepth = 5;   // G65, G66, macro codes
  std::uint8_t subprogramDepth = 10; // M98
  std::uint8_t totalCallDepth = 15;
  std::uint32_t lastSequenceNumber = 99999;
  std::uint32_t lastProgramNumber = 9999;
  bool packsRepeats = false;          // `M98 P30100`: O0100, three times
  std::uint8_t literalDigits = 8;     // of a number in a macro statement, zeros included
  std::uint32_t firstAlarmNumber = 0; // of `#3000=`
  std::uint32_t lastAlarmNumber = 200;
  std::uint8_t alarmMessageLength = 26;
  std::uint8_t ijkSets = 10;
  std::uint8_t mCodes = 3;             // in a block, where a setting allows several
  std::uint8_t programNameLength = 32; // of `<NAME>`
  std::uint16_t lineLength = 0;        // of a line with its remarks; 0: any
};

/// A switch whose setting on the machine is not known stays Unknown: both outcomes are possible.
enum class Switch : std::uint8_t { Off, On, Unknown };

/// A code that the machine's parameters turn into a call.
struct CodeCall {
  char address;          // 'G', 'M' or 'T'
  std::uint16_t tenths;  // ten times the code's number
  std::uint32_t program; // number of the program that it calls
  bool isMacro;          // true: arguments are passed (as G65); false: subprogram (as M98)
};

/// A G or M code by its name.
struct CodeName {
  char address;
  std::uint16_t tenths; // ten times the code's number
  friend auto operator<=>(const CodeName &, const CodeName &) = default;
};
/// `G68.2`, `M6`
std::string textOf(const CodeName &name);
/// `g68.2`, `M06`, `T1`: the letter as a capital; absent where the text is no such code.
std::optional<CodeName> codeNamed(std::string_view text, std::string_view addresses);

/// How fine the control counts lengths and angles: parameter 1013 (ISA, ISC); one setting for all axes.
enum class IncrementSystem : std::uint8_t { A, B, C };
/// `IS-A`, `IS-B`, `IS-C`.
std::string_view nameOf(IncrementSystem system);
std::span<const std::string_view> incrementSystemNames();
std::optional<IncrementSystem> incrementSystemNamed(std::string_view name);

/// Which codes a FANUC lathe has for cycles, distances and feed modes: parameter 3401#6 and #7 (GSB, GSC).  In A, G90
/// is a cycle and U and W are distances; in B and C, G90 and G91 choose between coordinates and distances.
enum class GCodeSystem : std::uint8_t { A, B, C };
inline constexpr std::size_t kGCodeSystems = 3;
/// `A`, `B`, `C`.
std::string_view nameOf(GCodeSystem system);
std::span<const std::string_view> gCodeSystemNames();
std::optional<GCodeSystem> gCodeSystemNamed(std::string_view name);

/// The machine parameters that change the language.  Names are those of the parameter manual.
struct Switches {
  Switch dpi = Switch::Unknown; // 3401#0: a word without a decimal point is in mm, inch, degree (On) or increments
  Switch ad2 = Switch::Off;     // 3403#6: a repeated address is an alarm
  Switch cir = Switch::Unknown; // 3403#5: an arc without R, I, J, K is an alarm (On) or a straight line (Off)
  Switch lrp = Switch::Unknown; // 1401#1: G00 moves in a straight line (On), or each axis by itself (Off)
  Switch m3b = Switch::Unknown; // 3404#7: up to three M codes in a block
  Switch g67 = Switch::Unknown; // 6000#0: G67 without G66 is no alarm
  Switch v15 = Switch::Off;     // 6000#3: tool offset numbering of Series 15
  Switch nat = Switch::Unknown; // 6004#0: range of ATAN and ASIN
  Switch sqc = Switch::Off;     // 6005#0: M98 Q starts at a sequence number
  Switch mlg = Switch::Unknown; // 6006#0: AND, OR, XOR join conditions
  Switch f16 = Switch::Off;     // 6008#0: value range and precision of Series 16 (numbersOf())
  Switch mca = Switch::Off;     // 6008#1: the number of `#3000=` is shown as it is, up to 4095
  Switch gmp = Switch::Off;     // 6008#6: code calls work inside programs called by a code
  Switch ijk = Switch::Off;     // 6008#7: I, J, K are always argument assignment I
  Switch fxy = Switch::Unknown; // 5101#0: cycles drill along the normal of the plane (On) or along Z
  Switch ax1 = Switch::Unknown; // 11600#5: under G68 an axis without a word counts from its place in the turned system
  Switch sup = Switch::Unknown; // 5003#0: cutter compensation starts and ends by way of its own block's normal (type B)
  Switch odi = Switch::Unknown; // 5004#2: the offset of D is a diameter
  // What controls do differently, or what no manual says (parity.md of each dialect).
  Switch shortArcStops = Switch::Unknown; // R a little below half the distance of the ends: an alarm, or a half circle
  Switch radiiDifferStops = Switch::On;   // an arc whose radii differ by more than the tolerance is an alarm
  Switch pointArcStops = Switch::Unknown; // an arc by R that ends where it starts: an alarm, or no movement
  Switch besideCentreStops = Switch::Unknown; // a centre word on the axis beside the plane of its arc is an alarm
  Switch bareCycleStops = Switch::Unknown;    // a canned cycle that was never given its depth or R level is an alarm
  Switch motionEndsCycle = Switch::Unknown;   // G00 to G03 behind the code of a canned cycle in its block end the cycle
  Switch setEndsLocal = Switch::Unknown;      // G92 takes the offset of G52 away from the axes that it names
  Switch centreStays = Switch::Unknown;       // centres of mappings and levels of cycles stay when the zero point moves
  IncrementSystem incrementSystem = IncrementSystem::B;
  GCodeSystem gCodeSystem = GCodeSystem::A; // of lathes that have several; chooseGCodeSystem() sets it
  std::vector<CodeCall> codeCalls = {};     // 6050-6059, 6080-6089, 6071-6079, ...
  /// Of the machine builder, by number: what they hold is not known, and may change at any time.
  std::vector<VariableRange> buildersVariables = {};
  /// Of the machine builder: what they do is not known.  One that the control has otherwise is replaced.
  std::vector<CodeName> buildersCodes = {};
};
/// A row for Switches::buildersVariables.
VariableRange buildersVariable(std::uint32_t first, std::uint32_t last);

/// What a control accepts beyond, or short of, the common grammar.
struct Grammar {
  bool conditionMayBeAnyValue = false; // `IF [#1] ..`: zero is false
  bool thenMayBeWords = false;         // `IF [..] THEN S900`
  bool thenMayBeOmitted = false;       // `IF [..] #1=2`, `IF [..] M99`
  bool thenMayBeGoto = false;          // `IF [..] THEN GOTO 10`
  bool blockIf = false;                // `IF [..] THEN` / `ELSE` / `ENDIF` on lines of their own
  bool wordMayBeUnbracketed = false;   // `X#1+10`
  bool conditionalReturn = false;      // `[#1 LT 10] M99 P10`
  bool sequenceZero = false;           // N0 is a label
  bool callStartsAtSequence = false;   // `M98 P1000 H20`: at N20 of O1000
  bool sequenceJumps = true;           // N is what jumps look for
  bool percentEndsProgram = false;     // `%` ends a main program as M02 does
  bool macroWithWords = false;         // NC words and macro statements in one block
  bool fractionalVariable = false;     // `#30057.21`: a bit of a setting
  bool doNumberMayRepeatNested = false;
  bool oWords = false;                 // `o100 if [..]`, `o<name> call [1]`; control words without a label do not exist
  bool namedParameters = false;        // `#<name>`
  bool semicolonComment = false;       // `;` begins a comment that ends with the line
  bool commentsMayNest = false;        // the control itself saves `(A (B))`
  bool anyIndex = false;               // `##2`, `#abs[#1]`: any value may stand behind `#`
  bool doubleStar = false;             // `**` raises to a power
  bool smallLetters = false;           // lower case is as good as upper case
  bool shortForms = true;              // `WH`, `GO`: two letters for a control word, a function or an operator
  bool valueNeedsBrackets = false;     // `#1=[#2+1]`: a sum in an assignment needs brackets, as in a word
  std::string_view signAddresses = {}; // signs that begin a word as letters do
};

enum class ModuloMeaning : std::uint8_t {
  OfIntegers, // both operands are rounded to integers first; the sign is that of the dividend
  NotNegative // of reals; the result is never negative
};
/// The numbers that a control computes with (docs/arithmetic.md).
enum class NumberModel : std::uint8_t {
  Binary64,   // doubles, IEEE 754
  Mantissa32, // 32 bits of mantissa, 1e-29 to 1e47; beyond, the control stops
  Either,     // no source says which of the two
};
/// `binary64`, `mantissa32`, `either`.
std::string_view nameOf(NumberModel model);

enum class IntegerPart : std::uint8_t { TowardZero, Floor }; // FIX; FUP goes the other way
enum class LogicMeaning : std::uint8_t { Bitwise, Logical }; // AND, OR, XOR of numbers
/// G53 under G91.
enum class MachineIncrement : std::uint8_t {
  NotFollowed, // does nothing, or moves somehow
  Distance,    // the words are distances
  Alarm
};

/// The path of the tool's centre about an outer corner under cutter compensation.
enum class CutterCorners : std::uint8_t {
  Lines, // to where the offset lines cross; beyond a quarter turn, cut off at the radius
  Arcs   // an arc about the corner
};
/// How cutter compensation begins.
enum class CutterEntry : std::uint8_t {
  ToNext,  // ends beside the start of the next block, square to it
  ByItself // ends beside its own end, square to itself; the corner behind it is one of the contour
};
/// The variables of D1 or H1; several: the numbers of memories of different kinds, of which a control has one.  0:
/// none.
struct OffsetMemory {
  std::array<std::uint32_t, 2> geometry{};
  std::array<std::uint32_t, 2> wear{};
  std::uint32_t count = 0; // of offsets
};

/// The variables of tool offset 1 of a lathe that describe the nose.
struct NoseMemory {
  OffsetMemory radius;
  std::array<std::uint32_t, 2> tip{}; // its direction; as for OffsetMemory
};

/// How the control computes and moves, where controls differ.
struct Behaviour {
  ModuloMeaning modulo = ModuloMeaning::OfIntegers;
  IntegerPart integerPart = IntegerPart::TowardZero;
  LogicMeaning logic = LogicMeaning::Bitwise;
  bool variablesMayBeVacant = true;     // else one that was never written reads as 0
  bool roundsWords = true;              // a word computed from variables is rounded to the least increment
  bool assignsAfterReading = false;     // all assignments of a line take place after the whole line is read
  bool arcDistanceModes = false;        // G90.1 and G91.1 exist
  bool cycleClearsFirst = false;        // a cycle that starts below its R level goes up to it before it goes to X, Y
  bool cycleKeepsDepth = false;         // under G91 a new R level takes the bottom of the hole along
  bool boringReturnsAtFeed = false;     // G89 feeds out up to the level to which it returns, not to the R level
  bool oneSetOffset = false;            // G52 and G92 set one and the same offset
  bool bareReferenceReturn = false;     // G28 without axis words moves all axes
  bool dataIsAbsolute = false;          // G10 L2 sets the offset under G91 too
  bool positionByData = false;          // G10 L20: the axes stand at the given coordinates
  bool returnTargetIsLocal = false;     // `M99 P` jumps within its own program, also in a subprogram
  bool endRestoresModes = false;        // M02 and M30 bring G01, G17, G40, G54, G90 and G94 into force
  bool stopsAtStrayWords = false;       // words that the codes of a block do not take, or lack, are errors (LinuxCNC)
  bool oneBlockCycles = false;          // G71 and its kin take one block; else one more before it has the depth of cut
  bool repeatsByK = true;               // K of a canned cycle repeats it; L does so everywhere
  bool machineMoveByMode = false;       // G53 feeds where G01 is in force; else it is always rapid
  bool cyclesNeedXY = false;            // a canned cycle is executed in blocks with X or Y only, and in G17
  bool scalingIsFollowed = true;        // G51; else nothing is known of positions behind it
  bool cyclesAreScaled = true;          // G51 scales the levels of canned cycles
  bool feedByIncrements = false;        // F without a point counts thousandths, as a setting says
  bool distanceModeByWord = false;      // G90 and G91 in one block hold for the words behind them
  bool localShiftIsVariable = false;    // #5201 and on are the offsets of G52
  bool writtenOriginWaits = false;      // a written origin takes effect when its coordinate system is selected next
  bool toolChangeReturnsZ = false;      // M06 moves Z to the reference position
  bool toolChangeStopsCoolant = false;  // M06 with the spindle running switches the coolant off
  bool referenceCancelsLength = false;  // G28 of any axis may cancel the tool length, not of Z alone
  bool logicOfIntegerParts = false;     // AND, OR, XOR drop fractions; else they round
  std::span<const CodeAction> startsIn; // in force at power-on, where other controls have other codes of these groups
  MachineIncrement machineIncrement = MachineIncrement::NotFollowed;
  bool absoluteBehindMappings = false; // also behind G68, not only behind G69, the first movement has to be absolute
  bool scalesByIncrements = false;     // factors of G51 count thousandths, or hundred-thousandths, as a parameter says
  CutterCorners cutterCorners = CutterCorners::Lines;
  CutterEntry cutterEntry = CutterEntry::ToNext;
  OffsetMemory cutterOffsets, lengthOffsets; // of D and of H; a length is the sum of both, whichever is the wear
  NoseMemory noseOffsets;                    // of T, on lathes
  bool positionIsOfCutter =
      false; // positions that a program reads are those of the compensated path, not the programmed
  std::array<std::uint16_t, 2> cutterDiameterCodes{}; // G41, G42 whose D is the diameter of the cutter itself
  /// Blocks that are read ahead under cutter compensation, the present one included; 0: as many as are needed.
  std::uint8_t cutterBlocks = 0;
  double equalTolerance = 0;  // EQ and NE take values this near as equal
  double arcTolerance = 0.05; // mm: largest difference of the radii at start and end
  /// Where it is above 0, an arc stops the control if its radii differ by more than the tolerance and by more than this
  /// share of the larger one, or by a hundred times the tolerance.
  double arcShare = 0;
  double arcToleranceInch = 0.05 / 25.4;
  double peckClearance = 0.254; // mm: how far above the last depth a peck begins (a parameter of most controls)
};

/// One text feature that speaks for a dialect, or against it.
struct LanguageHint {
  TextSignal signal;
  int weight;
};

/// A language that is recognised and refused.
/// Whether programs of a foreign language may look exactly like ones that are read.
enum class Resemblance : std::uint8_t { None, MacroB };

struct ForeignLanguage {
  std::string_view name; // "Heidenhain Klartext"
  std::string_view way;  // what the reader can do
  std::span<const LanguageHint> hints;
  Resemblance resemblance = Resemblance::None;
};

struct Dialect {
  std::string_view id;       // "fanuc-30i"
  std::string_view title;    // for people
  std::string_view controls; // "30i, 31i, 32i, 0i-F"
  MachineKind machine = MachineKind::Milling;
  std::array<AddressFormat, 26> addresses{}; // A .. Z
  std::span<const Code> gCodes;              // sorted by tenths; of the G code system in force
  /// Of each G code system; empty: the control has but one.
  std::array<std::span<const Code>, kGCodeSystems> gCodesOfSystem{};
  std::span<const Code> mCodes;             // sorted by tenths
  std::span<const VariableRange> variables; // sorted, without overlap
  std::span<const CellAlias> aliases;
  std::span<const BitWord> bitWords;
  std::span<const Function> functions;
  std::span<const Operator> operators;
  std::span<const AlarmNumber> alarms;
  std::array<std::uint8_t, 26>
      argumentVariables{}; // A .. Z -> local variable of argument assignment I; 0: not an argument
  Limits limits;
  Grammar grammar;
  Behaviour behaviour;
  Switches switches;
  NumberModel numbers = NumberModel::Binary64; // unless f16 is on
  bool hasFanucParameters = false; // the numbers beside Switches are those of its manual, so messages name them
  std::span<const LanguageHint> hints;
  std::span<const PredefinedName> predefinedNames = {}; // `#<_x>`: sorted by name
  /// How names begin (`_hal[`, `_ini[`) that the machine gives a value, or does not: one may change at any time, the
  /// other stays as it is.
  std::string_view inputNames = {}, settingNames = {};
};

constexpr std::uint32_t kVacantVariable = 0;
constexpr std::uint32_t kAlarmVariable = 3000;
constexpr std::uint32_t kMessageVariable = 3006;

/// The least input increments.
struct LeastIncrements {
  Decimal metric; // mm and degrees
  Decimal inch;
};
LeastIncrements leastIncrementsOf(const Dialect &dialect);

/// The control has the codes of the system from here on; one that has but one system stays as it is.
void chooseGCodeSystem(Dialect &dialect, GCodeSystem system);

/// The numbers that the control computes with, as its switches say.
NumberModel numbersOf(const Dialect &dialect);
/// Those that a run takes: doubles where no source says what the control has.
NumberModel numbersOfRun(const Dialect &dialect);
const AddressFormat &formatOf(const Dialect &dialect, char address);
/// Null for a code of the machine builder, whatever the control makes of its number.
const Code *findGCode(const Dialect &dialect, std::uint16_t tenths);
const Code *findMCode(const Dialect &dialect, std::uint16_t tenths);
/// Names of the control have rows of their own (`row` of their PredefinedName).
const VariableRange *findVariable(const Dialect &dialect, std::uint32_t number);
/// By the number of its variable; null: it is none.
const PredefinedName *findPredefinedName(const Dialect &dialect, std::uint32_t number);
/// The number of the variable; the name is in small letters.
std::optional<std::uint32_t> predefinedNamed(const Dialect &dialect, std::string_view name);
/// The first range with a role; null where the control has none.
const VariableRange *rangeWithRole(const Dialect &dialect, VariableRole role);
/// #5201 external offset, #5221 G54, #5241 G55 ..: one variable for each axis.
inline constexpr std::uint32_t kFirstWorkOffset = 5201, kWorkOffsetStride = 20;
/// How many work offsets the control lists before the one that a G code chooses: 0 for G54; absent: it chooses none.
std::optional<std::uint32_t> workOffsetsBefore(const Dialect &dialect, std::uint16_t tenths);
/// The code by which P chooses an additional work offset, G54.1 or G154: it stands behind those that choose one by
/// themselves, such as G110 of Haas.  Null where the control has none.
const Code *additionalOffsetCode(const Dialect &dialect);
/// The number of the additional work offset that the code chooses by itself: 1 for G110.  Absent: P tells it.
std::optional<std::uint32_t> additionalOffsetOf(const Dialect &dialect, const Code &code);
/// The cell of X of the additional work offset `number` (from 1); absent: the control has no such one.
std::optional<std::uint32_t> additionalWorkOffset(const Dialect &dialect, std::uint32_t number);
/// The number by which the state keeps the cell that a variable names: one number for all its names.
std::uint32_t cellOf(const Dialect &dialect, std::uint32_t number);
/// Cells that may be the same one as this, or not.
std::vector<std::uint32_t> perhapsSameAs(const Dialect &dialect, std::uint32_t cell);
/// Inputs, clocks and the like: two reads may find two numbers.
bool isVolatile(VariableRole role);
/// Whether reads of a volatile variable may give these numbers, one after another; not asked whether a program sets it.
bool mayRead(const VariableRange &range, std::span<const double> readings);
const BitWord *findBitWord(const Dialect &dialect, std::uint32_t number);
struct VariableSpan {
  std::uint32_t first;
  std::uint32_t last;
};
/// The cells beside those from first to last that a write to one of the numbers may change.
std::vector<VariableSpan> cellsBeside(const Dialect &dialect, std::uint32_t first, std::uint32_t last);
const Function *findFunction(const Dialect &dialect, FunctionKind kind);
/// 0 when the dialect does not have the operator.
int precedenceOf(const Dialect &dialect, OperatorKind op);
/// Whether writing the variable stops the program: #3000, where the control has it.
bool raisesAlarm(const Dialect &dialect, std::uint32_t number);
/// "divided by zero".
std::string_view meaningOf(AlarmKind kind);
/// The control's number for an alarm; absent where it is not known.
std::optional<std::string_view> alarmNumber(const Dialect &dialect, AlarmKind kind);
/// "stops with PS0112 (divided by zero)", or without a number where it is not known.
std::string stopsWith(const Dialect &dialect, AlarmKind kind);
const CodeCall *findCodeCall(const Dialect &dialect, char address, std::uint16_t tenths);
bool isBuildersCode(const Dialect &dialect, char address, std::uint16_t tenths);
/// The control or the machine's settings have it; at another one the control stops.
bool hasGCode(const Dialect &dialect, std::uint16_t tenths);
/// Whether the control has codes that save modes.
bool savesModes(const Dialect &dialect);
/// Whether the control has modal calls (G66) at all; without them nothing can begin one.
bool hasModalCalls(const Dialect &dialect);
/// It may change anything: an unknown G code, or an M code that Switches::buildersCodes lists.  Other unknown M codes
/// are those of switches and valves.
bool mayDoAnything(const Dialect &dialect, char address, std::uint16_t tenths);
/// G65, G66, G66.1, or a code that the machine's parameters make a macro call: the words behind it are arguments.
bool callsMacro(const Dialect &dialect, char address, std::uint16_t tenths);
/// The local variable that an address sets by argument assignment I; 0 where it passes nothing.
std::uint8_t argumentVariable(const Dialect &dialect, char address);

} // namespace feedhold
