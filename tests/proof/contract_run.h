// Contract on a run: whether a run starts as its contract says, and whether it keeps what the contract promises.
#pragma once

#include "language/contract/contract.h"
#include "proof/obligation/obligation.h"
#include "soundness/sample_start.h"

namespace feedhold::proof_tests {

class ContractOnRun {
public:
  /// `contract`: null: none, which allows everything.
  ContractOnRun(const soundness::LoadedSample &machine, const FileContracts &contracts, const Contract *contract)
      : machine_(machine), contracts_(contracts), contract_(contract) {}

  /// Codes and positions that the contract names are set.
  void prepare(soundness::EntryValues &entry) const;
  /// Values from the ranges of the contract, and where they end.
  void draw(soundness::EntryValues &entry, soundness::Random &random) const;
  bool allows(const soundness::EntryValues &entry) const;
  /// An `@ALARM` names the number.
  bool foresees(double alarm) const;
  /// What the run did to a promise; absent when it kept it, or came to no end at which it counts.
  std::optional<std::string> broken(const prove::Obligation &promise, const soundness::EntryValues &entry,
                                    const RunResult &run) const;

private:
  using State = MachineState<ConcreteInterpretation>;
  std::optional<double> number(ExpressionId expression, const soundness::EntryValues &entry) const;
  /// Absent where the condition itself would stop the control.
  std::optional<bool> condition(ExpressionId expression, const soundness::EntryValues &entry, const State &now) const;
  ConcreteValue drawn(const EntryValue &demand, const soundness::EntryValues &entry, soundness::Random &random) const;
  bool isAllowed(const EntryValue &demand, const soundness::EntryValues &entry) const;
  std::optional<bool> keeps(const Ensure &ensure, const soundness::EntryValues &entry, const State &now) const;
  bool keepsModes(const State &before, const State &now) const;
  std::optional<std::uint32_t> written(const soundness::EntryValues &entry, const State &now) const;
  bool keepsAlarm(const AlarmPromise &promise, const soundness::EntryValues &entry, const RunResult &run) const;

  const soundness::LoadedSample &machine_;
  const FileContracts &contracts_;
  const Contract *contract_;
};

} // namespace feedhold::proof_tests
