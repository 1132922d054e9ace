// Sums of multiples of numbers that are not known, along a piece of a program without branches: what two places of it
// have in common, whatever the variables hold.
#pragma once

#include "inference/domain/interval.h"
#include "rules/flow/definitions.h"

#include <compare>
#include <functional>
#include <map>
#include <optional>
#include <vector>

namespace feedhold::rules {

/// A number that is the same wherever the piece names it.
struct UnknownNumber {
  enum class Kind : std::uint8_t {
    Symbol,     // of the analysis (decision 0005)
    Variable,   // what a variable holds at the head of the piece
    Expression, // the value of an expression that is no sum of multiples
  };
  Kind kind;
  std::uint32_t id;
  friend auto operator<=>(const UnknownNumber &, const UnknownNumber &) = default;
};

struct LinearForm {
  double constant = 0;
  std::map<UnknownNumber, double> factors = {}; // none is 0

  bool isConstant() const { return factors.empty(); }
};
/// left + factor * right
LinearForm sum(LinearForm left, double factor, const LinearForm &right);

/// Nodes that are executed one after the other.
class StraightPath {
public:
  /// From `last` back, while each node has only one before it and `goesOn` holds of that.
  StraightPath(const FlowFacts &facts, NodeId last, const std::function<bool(NodeId)> &goesOn);

  /// Counted from `last`, which is 0, back.
  std::size_t size() const { return nodes_.size(); }
  NodeId node(std::size_t at) const { return nodes_[at]; }
  /// What an expression of the node is, where it is a number: a vacant variable has no form of its own.
  std::optional<LinearForm> formOf(ExpressionId expression, std::size_t at);
  /// Of all values of the unknown numbers in the form.
  Interval rangeOf(const LinearForm &form) const;

private:
  std::optional<LinearForm> formOf(const BinaryOperation &operation, ExpressionId id, std::size_t at);
  std::optional<LinearForm> formOfVariable(std::uint32_t variable, ExpressionId id, std::size_t at);
  std::optional<LinearForm> unknown(UnknownNumber number, ExpressionId id);

  const FlowFacts &facts_;
  std::vector<NodeId> nodes_;
  std::map<UnknownNumber, Interval> ranges_;
  int steps_ = 0;
};

} // namespace feedhold::rules
