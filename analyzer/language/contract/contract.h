// Contract: what a program may assume and what it promises, as plain data (docs/contracts.md tells the language).
//
// Clauses stand in comments of the program, `(@PARAM #21 DEPTH 0.5..50. MM)`, and in sidecar files beside it.  All
// expressions of a file's contracts are in FileContracts::tree, parsed as those of the program are; reserved.h says how
// they name positions and values on entry.  A clause that could not be read is an issue and no part of any contract:
// who proves with a contract asks Contract::isSound first.
#pragma once

#include "base/source/source_file.h"
#include "language/contract/reserved.h"
#include "language/model/model.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace feedhold {

using ClauseId = Id<struct ClauseTag>;
/// Which text a span of a contract lies in: the program itself, or one of its sidecar files in their order.
using ContractSourceId = Id<struct ContractSourceTag>;
inline constexpr ContractSourceId kProgramText{0};

enum class ClauseKind : std::uint8_t {
#define CLAUSE(kind, name) kind,
#include "language/contract/clauses.def"
};
/// "@PARAM"
std::string_view nameOf(ClauseKind kind);

/// One clause as it stands in its text.
struct Clause {
  ClauseKind kind;
  ContractSourceId source;
  Span span;        // from `@` to its last sign
  std::string text; // of `span`, decoded: for messages
  ProgramId program;
};

/// Both ends belong to it; an absent end is no bound.
struct Range {
  std::optional<ExpressionId> low;
  std::optional<ExpressionId> high;
};
struct ValueList {
  std::vector<ExpressionId> values;
};
struct AnyNumber {};
using AllowedValues = std::variant<AnyNumber, Range, ValueList>;

enum class Unit : std::uint8_t {
#define UNIT(unit, name) unit,
#include "language/contract/units.def"
};
/// "MM/MIN"; empty for Unit::None.
std::string_view nameOf(Unit unit);

/// Whether a variable may be vacant on entry.
enum class Vacancy : std::uint8_t { Never, Possible };

/// `@PARAM`, `@GLOBAL`, and the variables that `@OFFSET G54` and HOME of `@MACHINE` stand for: what one holds on entry.
/// A unit of Unit::Integer says that it is a whole number.
struct EntryValue {
  ClauseId clause;
  std::uint32_t variable;
  Span variableSpan;
  std::string name; // may be empty
  AllowedValues values;
  Unit unit = Unit::None;
  Span unitSpan = {};
  Vacancy vacancy = Vacancy::Never;
  std::optional<Decimal> step = {}; // of `BY 0.001`: it is a multiple of that, of at most 8 digits
};

/// `@REQUIRE`; the conditions of `@ENSURE` and `@INVARIANT`.
struct ContractCondition {
  ClauseId clause;
  ExpressionId condition;
};

struct ModalCode {
  ClauseId clause;
  char address; // G or M
  std::uint16_t tenths;
  std::uint8_t group; // of the dialect; never 0
  Span span;
};

/// `X0`, `Z-[#18+1]`
struct AxisValue {
  char axis;
  ExpressionId value;
};
/// `X-400..400`
struct AxisRange {
  char axis;
  Range range;
};

/// `@START`; an axis that is not named is anywhere.
struct StartPosition {
  ClauseId clause;
  std::vector<AxisValue> axes;
};

/// Tip: of a lathe, the rest of milling.
enum class ToolShape : std::uint8_t { Flat, Ball, Bull, Drill, Tip };
struct ContractTool {
  ClauseId clause;
  ToolShape shape;
  ExpressionId radius;
  std::optional<ExpressionId> corner = {}; // of Bull
  std::uint8_t direction = 0;              // of Tip, as controls number it: where the programmed point lies, 0 to 9
};

/// `@OFFSET D1 RADIUS 5`, `@OFFSET D#20 RADIUS 4.9..5.1`: what the register of cutter compensation holds, in the units
/// of the start.
struct RadiusOffset {
  ClauseId clause;
  std::optional<ExpressionId> number; // of D; absent: any, `D*`
  Range radius;                       // both ends are the same: a single value
};

/// `@LENGTH H1 50..200`: the tool length of this H, geometry and wear together, in the units of the start.
struct LengthRange {
  ClauseId clause;
  std::optional<std::uint32_t> number; // of H; absent: any, `H*`
  Range length;
};

/// A side that is not named is unbounded.
struct Box {
  std::vector<AxisRange> sides;
};
struct Cylinder {
  char axis;                     // X, Y or Z
  std::vector<AxisValue> centre; // the two other axes
  ExpressionId radius;
  Range along; // the axis
};
struct Sphere {
  std::vector<AxisValue> centre; // X, Y and Z
  ExpressionId radius;
};
struct Polygon {
  struct Corner {
    ExpressionId first;  // X
    ExpressionId second; // Y; of a lathe Z
  };
  std::vector<Corner> corners; // at least three
  Range height;                // Z; of a lathe without ends
};
/// A condition over the point X, Y, Z (reserved.h).
struct Where {
  ExpressionId condition;
};
struct Region {
  ClauseId clause;
  std::string name;
  std::variant<Box, Cylinder, Sphere, Polygon, Where> shape;
};

/// `@CLEARANCE Z2.`
struct Clearance {
  ClauseId clause;
  AxisValue height;
};
/// `@TRAVEL`
struct Travel {
  ClauseId clause;
  Box box;
};
/// `@MACHINE X-762..0`: between which machine coordinates the axes can move, in the units of the start.  At the start
/// they stand between them.
struct MachineRange {
  ClauseId clause;
  Box box;
};
/// `@CORNER 0.05`: how far the tool leaves the programmed path where the machine rounds corners, in the units of the
/// start.
struct CornerRounding {
  ClauseId clause;
  Decimal most; // 0 or more
};
/// `@FIXED A`: regions and tool are the same at every angle of these axes.
struct FixedAxes {
  ClauseId clause;
  std::string axes; // letters, in the order of the clause
};
/// `@LIMIT F 1..5000`
struct WordLimit {
  ClauseId clause;
  char address; // F or S
  Range range;
};

/// What "modal state" contains is told in docs/contracts.md.
struct ModalPreserved {
  std::string except = {}; // addresses whose words may be others: `F`
};
/// `@GUARDED`: calls outside of the contract raise an alarm, but for those that break only what is excepted.
struct Guarded {
  ClauseId clause;
  bool exceptModal = false; // `@MODAL`
  bool exceptStart = false; // `@START`
};
/// `@ENSURE`: a condition, the modal state of entry, or codes in force.
struct Ensure {
  ClauseId clause;
  std::variant<ExpressionId, ModalPreserved, std::vector<ModalCode>> promise;
};

/// `@TOLERANCE 0.01`: how near numbers are that `@ENSURE` calls equal.  Below 1, so that whole numbers are equal only
/// if they are the same.
struct EqualTolerance {
  ClauseId clause;
  Decimal most;
};

/// `@ASSIGNS`: the only common variables that are written; no ranges: none.
struct Assigns {
  struct Variables {
    std::uint32_t first;
    std::uint32_t last;
  };
  ClauseId clause;
  std::vector<Variables> variables;
};

enum class AlarmClaim : std::uint8_t { If, IfAndOnlyIf };
/// `@ALARM 120 IFF #1 EQ 0`.  If: every such call raises it.
struct AlarmPromise {
  ClauseId clause;
  std::uint32_t number;
  AlarmClaim claim;
  ExpressionId condition; // over the values on entry
};

/// `@EVENTUALLY #1000 EQ 1`: a read that the program makes again and again at one place gives such a value in the end.
struct AwaitedInput {
  ClauseId clause;
  std::uint32_t variable; // one that the machine changes
  OperatorKind relation;
  Decimal value;
};

/// `@INVARIANT`, `@VARIANT` at a loop head.
struct LoopHint {
  ClauseId clause;
  BlockId block; // of the loop head
  ExpressionId expression;
};

/// All clauses of one program, each kind in the order in which they stand.
struct Contract {
  ProgramId program{0};
  std::vector<EntryValue> params;  // each variable once
  std::vector<EntryValue> globals; // each variable once
  std::vector<ContractCondition> requirements;
  std::vector<ModalCode> modal; // each group once
  std::optional<StartPosition> start;
  std::optional<ContractTool> tool;
  std::vector<RadiusOffset> offsets; // one with `D*` at most
  std::vector<LengthRange> lengths;  // each H once
  std::vector<Region> keepIn;        // each name is the union of its regions
  std::vector<Region> keepOut;
  std::optional<Clearance> clearance;
  std::optional<Travel> travel;
  std::optional<MachineRange> machine;
  std::optional<CornerRounding> corner;
  std::optional<FixedAxes> fixed;
  std::vector<WordLimit> limits;
  std::vector<Ensure> ensures;
  std::optional<EqualTolerance> tolerance;
  std::vector<Assigns> assigns; // together: the union
  std::optional<Guarded> guarded;
  std::vector<AlarmPromise> alarms;
  std::vector<AwaitedInput> awaited;
  std::vector<LoopHint> invariants;
  std::vector<LoopHint> variants;
  std::optional<ClauseId> cyclic;
  bool isSound = true; // no clause of it was left out for an issue

  const EntryValue *param(std::uint32_t variable) const;
};

/// Inch or Metric, where `@MODAL` says which.
std::optional<CodeAction> unitsOf(const Contract &contract, const Dialect &dialect);
/// Of `@TOLERANCE`, or one least input increment.
Decimal toleranceOf(const Contract &contract, const Dialect &dialect);

/// Of `@CORNER`: how far from the programmed path the tool may be, on any side of it.  Without the clause it is on the
/// path.
Decimal cornerOf(const Contract &contract);

enum class ContractIssueKind : std::uint8_t {
#define CONTRACT_ISSUE(kind) kind,
#include "language/contract/issues.def"
};
std::string_view nameOf(ContractIssueKind kind);

struct ContractIssue {
  ContractIssueKind kind;
  ContractSourceId source;
  Span span;
  std::string detail = {};               // what issues.def says for the kind
  std::optional<ClauseId> other = {};    // the clause that it conflicts with
  std::optional<ProgramId> program = {}; // whose contract it is in
};

/// `@ALLOW rule reason` in a sidecar file: no part of the contract; who suppresses findings reads the text.
struct SidecarAllowance {
  ContractSourceId source;
  Span span; // from `@` to its last sign
  ProgramId program;
};

/// The contracts of one file.
struct FileContracts {
  SyntaxTree tree;                 // expressions only; spans are in the text of their clause
  std::vector<SourceFile> sources; // by ContractSourceId
  Store<Clause, ClauseId> clauses;
  std::vector<Contract> contracts;   // of programs with at least one clause, in order of the programs
  std::vector<ContractIssue> issues; // by source, then by place
  std::vector<SidecarAllowance> allowances = {};

  /// Null: the program has no clause.
  const Contract *of(ProgramId program) const;
  const SourceFile &source(ContractSourceId id) const { return sources[id.index()]; }
};

/// Whose clauses a sidecar file holds: those of one program, or the set-up of a machine, for each program that has a
/// contract of its own.
enum class SidecarScope : std::uint8_t { Program, Machine };

/// A file beside the program, one clause a line.
struct Sidecar {
  SourceFile source;
  std::optional<std::uint32_t> program;    // of `O9100.contract`; absent: the first program of the file
  std::optional<std::string> problem = {}; // why it could not be read; its text is empty then
  SidecarScope scope = SidecarScope::Program;
};

FileContracts readContracts(const SourceFile &source, const SyntaxTree &tree, const ProgramModel &model,
                            const Dialect &dialect, std::span<const Sidecar> sidecars = {});

/// The contracts as text: what golden cases compare.
std::string dump(const FileContracts &contracts, const ProgramModel &model, const SyntaxTree &tree);

} // namespace feedhold
