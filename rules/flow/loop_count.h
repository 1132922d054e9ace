// How many iterations a loop has that a counter ends: on paper, and on a control that rounds.
#pragma once

#include "rules/flow/formula.h"
#include "rules/flow/loop_view.h"

namespace feedhold::rules {

/// The comparison that ends a loop, with what it compares.
struct LoopEnd {
  const BinaryOperation *relation;
  bool leavesWhenTrue;
  FormulaId left;
  FormulaId right;
  FormulaInputId counter;
  bool countsOnLeft;
  bool testsAfterStep;
  std::vector<FormulaInputId> inputs;
};

struct Iterations {
  std::int64_t exact;
  std::optional<std::int64_t> computed; // absent: the loop goes on for long, and EQ or NE ends it
  ExpressionId rounded;                 // the side of the comparison that is rounded
  RoundedNumber atEnd;                  // its value when the loop ends on paper or on the control
};

/// No iteration comes back to the head without the node.
bool passesAlways(const FlowFacts &facts, const LoopFlow &loop, NodeId node);

/// Absent where the comparison has no counter of the loop, or cannot be followed.
std::optional<LoopEnd> endOf(Formulas &formulas, const LoopFlow &loop, const LoopExit &exit);

bool isEquality(const LoopEnd &end);

/// How often the loop runs with some values of its inputs; absent where it is not known, or takes more than `most`.
std::optional<Iterations> countIterations(const Formulas &formulas, const LoopEnd &end, FormulaSetting setting,
                                          std::int64_t most);

} // namespace feedhold::rules
