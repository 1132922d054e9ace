// What an expression is computed from: followed back, assignment by assignment, to literals, arguments and the counters
// of loops, and evaluated on paper and as a control computes it.
#pragma once

#include "inference/domain/rounded_number.h"
#include "rules/flow/definitions.h"

#include <functional>
#include <optional>
#include <variant>
#include <vector>

namespace feedhold::rules {

using FormulaId = Id<struct FormulaTag>;
using FormulaInputId = Id<struct FormulaInputTag>;

/// A value of which only its bounds are known: an argument, a common variable; or what a loop counts.
struct FormulaInput {
  /// `#1=#1+.1`
  struct Counter {
    NodeId step;
    FormulaId start;
    FormulaId size;
    bool isMinus;
    /// Of the value on the way into the loop, and of the step.
    std::vector<NodeId> startNodes;
  };
  std::uint32_t variable;
  Definitions definitions;
  std::vector<AbstractValue> bounds; // where it is read
  std::optional<Counter> counter = {};
};

/// Values of the inputs, by FormulaInputId; absent: not chosen.
using FormulaSetting = std::vector<std::optional<RoundedNumber>>;

/// A comparison that a run passes with one outcome.
struct FormulaGuard {
  OperatorKind relation;
  FormulaId left;
  FormulaId right;
  bool isTrue;
};

struct RoundedTruth {
  bool exact;
  bool computed;
};

/// FIX or FUP, as the control cuts.
std::optional<RoundedNumber> wholePart(const RoundedNumber &value, FunctionKind function, const Dialect &dialect);

class Formulas {
public:
  explicit Formulas(const FlowFacts &facts) : facts_(facts) {}

  const FlowFacts &facts() const { return facts_; }
  /// The value of an expression that the node evaluates.  Absent where it depends on something that is not followed.
  std::optional<FormulaId> of(ExpressionId expression, NodeId at);
  const FormulaInput &input(FormulaInputId id) const { return inputs_[id.index()]; }
  /// Null: it is computed, or a literal.
  std::optional<FormulaInputId> asInput(FormulaId id) const;
  /// Ascending; of counters also those of which their starts and steps are computed.
  std::vector<FormulaInputId> inputsOf(FormulaId id) const;
  FormulaSetting noSetting() const { return FormulaSetting(inputs_.size()); }

  /// Absent where an input has no value, a function is not defined, or the exact result is no fraction.
  std::optional<RoundedNumber> value(FormulaId id, const FormulaSetting &setting) const;
  /// The next value of a counter.
  std::optional<RoundedNumber> stepped(const FormulaInput::Counter &counter, const RoundedNumber &value,
                                       const FormulaSetting &setting) const;
  /// Of a relation.
  std::optional<RoundedTruth> truth(OperatorKind relation, const RoundedNumber &left, const RoundedNumber &right) const;
  /// The comparisons on all paths to a place that can be followed.
  std::vector<FormulaGuard> guardsOf(NodeId at);
  /// None of them, as far as it can be evaluated, goes the other way.
  bool pass(const std::vector<FormulaGuard> &guards, const FormulaSetting &setting) const;

private:
  struct Operation {
    OperatorKind op;
    FormulaId left;
    FormulaId right;
  };
  struct Function {
    FunctionKind function;
    FormulaId argument;
  };
  struct Opposite {
    FormulaId operand;
  };
  using Node = std::variant<RoundedNumber, FormulaInputId, Operation, Function, Opposite>;

  std::optional<FormulaId> add(const Node &node);
  std::optional<FormulaId> ofVariable(ExpressionId expression, NodeId at);
  std::optional<FormulaId> ofDefinitions(std::uint32_t variable, const Definitions &definitions,
                                         const AbstractValue &bounds);
  std::optional<FormulaInput::Counter> counterOf(std::uint32_t variable, const Definitions &definitions);
  bool isGiven(std::uint32_t variable, const Definitions &definitions) const;
  bool countsIn(FormulaId id) const;
  std::optional<RoundedNumber> valueOf(const Operation &operation, const FormulaSetting &setting) const;
  std::optional<RoundedNumber> valueOf(const Function &function, const FormulaSetting &setting) const;

  const FlowFacts &facts_;
  std::vector<Node> nodes_;
  std::vector<FormulaInput> inputs_;
  std::vector<NodeId> following_; // the assignments that are being followed back
  std::vector<NodeId> counting_;  // the steps of counters, likewise
  int depth_ = 0;
};

/// Chooses values that occur in workshops for some inputs, counters left out, until `shows` is true: whole numbers,
/// tenths, hundredths, within the bounds of each input.  Absent: none showed it.
std::optional<FormulaSetting> findSetting(const Formulas &formulas, const std::vector<FormulaInputId> &inputs,
                                          const std::function<bool(FormulaSetting &)> &shows);

/// "`#1` is 0.30000000000000004 where 0.3 is meant"
std::string describeRounding(std::string_view expression, const RoundedNumber &value);

/// "with `#2` = 7 and `#3` = 0.1"; empty without inputs.
std::string describeSetting(const Formulas &formulas, const std::vector<FormulaInputId> &inputs,
                            const FormulaSetting &setting);

} // namespace feedhold::rules
