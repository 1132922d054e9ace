// The steps of readContracts: from the carriers to clauses, from a clause to its part of the contract, and the checks.
// Internal to the library.
#pragma once

#include "language/contract/clause_reader.h"

namespace feedhold {

/// A clause in its text, before it is read.
struct RawClause {
  ContractSourceId source;
  Span span; // from `@` on
  ProgramId program;
  std::optional<BlockId> place;               // of a comment: its block or the next one that does something
  std::optional<Span> number;                 // of `@AT N30`: `N30`
  SidecarScope scope = SidecarScope::Program; // Machine: a clause of the program itself goes before it
};

/// `@PARAM` -> its kind and what follows.
struct ClauseHead {
  Span keyword;
  std::string name; // upper case, with `@`
};

/// Comments of the program, then the lines of its sidecar files.
std::vector<RawClause> findClauses(ContractReading &reading, std::span<const Sidecar> sidecars);
/// The set-up of the machine, for one program.
std::vector<RawClause> findSetUp(std::span<const Sidecar> sidecars, ProgramId program);

/// Whose contract a sidecar file holds; absent: no program of the file has its number.
std::optional<ProgramId> programOf(const ProgramModel &model, const Sidecar &sidecar);

/// Takes out the comments that only happen to begin with `@`: remarks in a program that has no clause, nor a word that
/// may be a mistyped one.
void dropRemarks(const ContractReading &reading, std::vector<RawClause> &clauses);
/// Reads one clause into its contract, or leaves an issue.
void readClause(ContractReading &reading, const RawClause &raw);

/// `FLAT RADIUS #7` and so on.
ContractTool readTool(ClauseReader &reader, MachineKind machine, ClauseId clause);
/// `BOX X..`, `CYLINDER ..` and so on.
decltype(Region::shape) readShape(ClauseReader &reader, MachineKind machine);
Box readBox(ClauseReader &reader, MachineKind machine);
std::vector<AxisValue> readAxisValues(ClauseReader &reader, std::string_view axes);

/// What a variable holds on entry by a clause of the set-up.
struct SetUpValue {
  std::uint32_t variable;
  AllowedValues values;
};
/// Of `@OFFSET G54 X-400..-300 Z-350.`, behind the keyword; `EXT`: of the external offset.
std::vector<SetUpValue> readWorkOffset(ClauseReader &reader, const ContractReading &reading);
/// Of `@LENGTH H1 50..200`
LengthRange readLength(ClauseReader &reader, const ContractReading &reading, ClauseId clause);
/// Behind `BY`; absent: the clause has an issue.
std::optional<Decimal> readStep(ClauseReader &reader, const ContractReading &reading);
/// Of `@CORNER 0.05`; absent: the clause has an issue.
std::optional<CornerRounding> readCorner(ClauseReader &reader, const ContractReading &reading, ClauseId clause);
/// Of `@FIXED A`.
FixedAxes readFixed(ClauseReader &reader, ClauseId clause);
/// Behind HOME: to where G28 returns.  Machine zero, unless the control keeps it in variables.
std::vector<SetUpValue> readHome(ClauseReader &reader, const ContractReading &reading);

/// The clauses that a machine has in common for all programs, and that its sidecar file may hold.
bool isOfSetUp(ClauseKind kind);

/// Blocks to which a jump leads back, in their order.
std::vector<BlockId> jumpHeads(const ProgramModel &model);
/// A DO, the head of a loop of o-words, or a block to which a jump leads back or may lead.
bool isLoopHead(const ContractReading &reading, ProgramId program, BlockId block);

/// What can only be seen in the whole contract.
void checkContracts(ContractReading &reading);

void addIssue(ContractReading &reading, ContractIssue issue);
/// The contract of a program, made at first need.
Contract &contractOf(ContractReading &reading, ProgramId program);

} // namespace feedhold
