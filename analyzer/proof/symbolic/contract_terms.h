// Contract terms: what the clauses of a contract say of an entry state and of a state at the return.
#pragma once

#include "language/contract/contract.h"
#include "proof/symbolic/symbolic_interpretation.h"

#include <array>
#include <map>
#include <optional>
#include <set>
#include <vector>

namespace feedhold::prove {

/// Numbers over the inputs; an absent end is no bound.
struct InputEnds {
  std::uint32_t variable;
  std::optional<smt::TermId> low, high;
};

/// The upper end of a range of `@OFFSET`.
struct OffsetEnd {
  std::optional<smt::TermId> number; // of D; absent: of each
  smt::TermId radius;
};

/// What a contract says of the numbers that inputs hold, by variable.
std::map<std::uint32_t, WrittenInput> writtenInputs(const FileContracts &file, const Contract &contract);
/// The variables of whose values on entry some clause speaks: `OLD[#510]`.
std::set<std::uint32_t> oldVariablesIn(const FileContracts &contracts);
/// The variables of programs that clauses of the file name.
std::set<std::uint32_t> variablesIn(const FileContracts &contracts);
/// What a variable of programs holds in the state.
SymbolicValue heldBy(SymbolicInterpretation &interpretation, const Dialect &dialect, std::uint32_t variable,
                     const SymbolicState &state);

class ContractTerms {
public:
  ContractTerms(SymbolicInterpretation &interpretation, const ProgramSet &programs, FileId file,
                const FileContracts &contracts);

  /// The modal codes and the start position of the contract are put into the state; and that no shift of G52 and G92 is
  /// in force, if it speaks of machine coordinates.
  void prepare(const Contract &contract, SymbolicState &entry);
  /// `@PARAM`, `@GLOBAL`, `@REQUIRE` and the clauses of the set-up: what a caller has to see to.
  std::vector<smt::TermId> demands(const Contract &contract, const SymbolicState &entry);
  /// The modal codes and the start position of the contract are those of the state.
  std::vector<smt::TermId> modesOfStart(const Contract &contract, const SymbolicState &started);
  std::vector<smt::TermId> placeOfStart(const Contract &contract, const SymbolicState &started);
  /// All that a proof of the program assumes of the state in which it is started: the same, the modal codes and the
  /// start position.  Whoever calls the program answers for each of them, and a call that breaks one of them is a call
  /// outside of the contract.
  std::vector<smt::TermId> assumptions(const Contract &contract, const SymbolicState &started);
  /// A condition of the contract over a state; ENTRY, OLD and POS stand for what they say.
  /// Of what is measured, as near as the tolerance: positions, and results that the control rounds.
  smt::TermId promise(const Contract &contract, ExpressionId expression, const SymbolicState &entry,
                      const SymbolicState &now);
  smt::TermId condition(ExpressionId expression, const SymbolicState &entry, const SymbolicState &now);
  /// A condition over a point of the space, and the values on entry.
  smt::TermId conditionAt(ExpressionId expression, const SymbolicState &entry, const std::array<smt::TermId, 3> &point);
  /// A number of the contract over a state, as condition().
  smt::TermId number(ExpressionId expression, const SymbolicState &entry, const SymbolicState &now);

  /// Between which ends the contract has the inputs, in its order; those it bounds.
  std::vector<InputEnds> inputEnds(const Contract &contract, const SymbolicState &entry);
  std::vector<OffsetEnd> offsetEnds(const Contract &contract, const SymbolicState &entry);

  /// The length of the tool that is in the spindle, whichever it is: as one of the clauses says.
  smt::TermId lengthInSpindle(const Contract &contract, const SymbolicState &entry);
  /// How far the tip of the longest tool is below the coordinates of the start: its length, where `@MODAL` says that
  /// none is in force.  Absent: some clause has no upper end.
  std::optional<smt::TermId> longestBelow(const Contract &contract, const SymbolicState &entry);
  smt::TermId mostAbove(const Contract &contract, const SymbolicState &entry);
  /// Machine coordinates of the zero point of a state, tool length included.
  std::array<smt::TermId, 3> machineZero(const SymbolicState &entry);

private:
  void demandRegisters(const SymbolicState &entry, std::vector<smt::TermId> &demands);
  void demandLength(const LengthRange &length, const Contract &contract, const SymbolicState &entry,
                    std::vector<smt::TermId> &demands);
  void demandMachine(const MachineRange &machine, const SymbolicState &entry, std::vector<smt::TermId> &demands);
  std::set<std::uint32_t> numbersOfLengths() const;
  bool namesMachineCoordinates(const Contract &contract) const;
  SymbolicValue valueOf(std::uint32_t variable, const SymbolicState &state) const;
  smt::TermId demandOf(const EntryValue &value, const SymbolicState &entry);
  SymbolicValue value(ExpressionId expression, const SymbolicState &state);
  SymbolicState withReserved(const SymbolicState &entry, const SymbolicState &now) const;

  SymbolicInterpretation &interpretation_;
  const ProgramSet &programs_;
  FileId file_;
  const FileContracts &contracts_;
  std::set<std::uint32_t> oldVariables_; // whose values on entry some clause asks for; no locals
};

} // namespace feedhold::prove
