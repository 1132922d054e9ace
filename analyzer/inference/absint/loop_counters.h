// LoopCounters: the variables that a loop counts, and how far its conditions let them come.
//
// A counter that goes from one constant of the program to the next costs a round of the loop each time.  Where the loop
// adds a constant to it and compares it with a limit, its last value is known at once: it is proposed, and the rounds
// that follow check it like any other (Gonnord and Halbwachs, "Combining widening and acceleration in linear relation
// analysis", 2006).  Nothing rests on the proposal: one that is wrong costs a round.
#pragma once

#include "inference/absint/abstract_interpretation.h"
#include "meaning/cfg/wto.h"

#include <vector>

namespace feedhold {

class LoopCounters {
public:
  LoopCounters() = default;
  /// Of the loop that begins at `head`, inner ones included.
  LoopCounters(const ProgramFile &file, const Wto &wto, NodeId head);

  /// What the counters hold, in a fixed order; any number for one that has not been written.
  std::vector<AbstractNumber> numbersIn(const AbstractState &state) const;
  /// Counters that have grown beyond `before` grow to their limits.  Not those that reach them in a few rounds: their
  /// values are told one by one.
  void extend(AbstractState &state, const std::vector<AbstractNumber> &before) const;

private:
  /// The loop goes on while `counter op limit`.
  struct Limit {
    OperatorKind op;
    ExpressionId value;
    std::uint32_t position; // of the test in the order
  };
  struct Counter {
    std::uint32_t variable;
    AbstractNumber step;
    std::uint32_t position; // of the assignment
    std::vector<Limit> limits;
  };

  void addSteps(const ProgramFile &file, const Assign &assign, std::uint32_t position);
  void addLimits(ExpressionId condition, std::uint32_t position);
  void addLimit(ExpressionId counter, OperatorKind op, ExpressionId value, std::uint32_t position);
  std::optional<AbstractNumber> limitIn(const AbstractState &state, ExpressionId value) const;
  std::optional<double> lastOf(const AbstractState &state, const Counter &counter, const AbstractNumber &number,
                               bool upwards) const;

  const SyntaxTree *tree_ = nullptr;
  std::vector<Counter> counters_;
};

} // namespace feedhold
