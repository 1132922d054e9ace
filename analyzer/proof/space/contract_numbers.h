// Contract numbers: the expressions and promises of a contract in the numbers of one run.
#pragma once

#include "language/contract/contract.h"
#include "meaning/machine/machine.h"
#include "proof/geometry/shapes.h"

namespace feedhold::prove {

class ContractNumbers {
public:
  ContractNumbers(const ProgramSet &programs, Callee program, const FileContracts &contracts, const RunOptions &run);

  double number(ExpressionId expression);
  bool holds(ExpressionId condition, const geometry::Point<double> &point);
  /// The promise fails in the state behind the run by more than the tolerance.  What is near to it, or of another kind
  /// than relations and modal codes, is left to proofs.
  bool isClearlyBroken(const Ensure &ensure, const RunResult &end, double tolerance);

private:
  using State = MachineState<ConcreteInterpretation>;
  template <typename Result, typename Evaluate> Result within(State &state, Evaluate &&evaluateIt);
  ConcreteValue atStart(std::uint32_t variable) const;
  State behind(const State &end) const;

  const ProgramSet &programs_;
  const ProgramFile &file_;
  const FileContracts &contracts_;
  ModalTable modes_;
  ConcreteInterpretation interpretation_;
  State state_; // at the start
};

} // namespace feedhold::prove
