// Expressions followed back along the definitions of their variables.
#include "rules/flow/formula.h"

#include "base/support/match.h"
#include "rules/flow/loop_view.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace feedhold::rules {
namespace {

constexpr int kDeepest = 40;
constexpr std::size_t kMostNodes = 500;

bool isComputable(FunctionKind function) {
  return function == FunctionKind::Abs || function == FunctionKind::Fix || function == FunctionKind::Fup ||
         function == FunctionKind::Round || function == FunctionKind::Sqrt;
}

bool isArithmetic(OperatorKind op) {
  return op == OperatorKind::Add || op == OperatorKind::Subtract || op == OperatorKind::Multiply ||
         op == OperatorKind::Divide;
}

template <typename Number> bool holds(OperatorKind relation, const Number &left, const Number &right, bool areEqual) {
  if (relation == OperatorKind::Equal || relation == OperatorKind::NotEqual)
    return areEqual == (relation == OperatorKind::Equal);
  if (relation == OperatorKind::GreaterThan)
    return left > right;
  if (relation == OperatorKind::GreaterOrEqual)
    return left >= right;
  return relation == OperatorKind::LessThan ? left < right : left <= right;
}

} // namespace

std::optional<FormulaId> Formulas::add(const Node &node) {
  if (nodes_.size() >= kMostNodes)
    return std::nullopt;
  nodes_.push_back(node);
  return FormulaId(nodes_.size() - 1);
}

std::optional<FormulaId> Formulas::of(ExpressionId expression, NodeId at) {
  const SyntaxTree &tree = *facts_.file.tree;
  const ExpressionId id = unwrapped(tree, expression);
  if (const AbstractValue *known = facts_.valueOf(id); known && known->isNumber())
    if (const auto number = RoundedNumber::of(known->number()))
      return add(*number);
  if (const auto literal = literalValue(tree, id)) {
    const auto number = RoundedNumber::of(*literal);
    return number ? add(*number) : std::nullopt;
  }
  if (depth_ >= kDeepest)
    return std::nullopt;
  ++depth_;
  std::optional<FormulaId> found;
  if (const auto *negation = as<Negation>(tree, id)) {
    const auto operand = of(negation->operand, at);
    found = operand ? add(Opposite{*operand}) : std::nullopt;
  } else if (const auto *operation = as<BinaryOperation>(tree, id)) {
    const auto left = isArithmetic(operation->op) ? of(operation->left, at) : std::nullopt;
    const auto right = left ? of(operation->right, at) : std::nullopt;
    found = right ? add(Operation{operation->op, *left, *right}) : std::nullopt;
  } else if (const auto *call = as<FunctionCall>(tree, id)) {
    const bool isKnown = isComputable(call->function) && call->arguments().size() == 1;
    const auto argument = isKnown ? of(call->arguments().front(), at) : std::nullopt;
    found = argument ? add(Function{call->function, *argument}) : std::nullopt;
  } else {
    found = ofVariable(id, at);
  }
  --depth_;
  return found;
}

std::optional<FormulaId> Formulas::ofVariable(ExpressionId expression, NodeId at) {
  const auto variable = variableOf(facts_, expression);
  const auto definitions = variable ? definitionsOf(facts_, *variable, at) : std::nullopt;
  const AbstractValue *bounds = facts_.valueOf(expression);
  return definitions && bounds ? ofDefinitions(*variable, *definitions, *bounds) : std::nullopt;
}

std::optional<FormulaId> Formulas::ofDefinitions(std::uint32_t variable, const Definitions &definitions,
                                                 const AbstractValue &bounds) {
  const auto known = std::ranges::find_if(inputs_, [&](const FormulaInput &input) {
    return input.variable == variable && input.definitions == definitions;
  });
  if (known != inputs_.end()) {
    known->bounds.push_back(bounds);
    return add(FormulaInputId(static_cast<std::size_t>(known - inputs_.begin())));
  }
  if (!definitions.fromEntry && definitions.nodes.size() == 1) {
    const NodeId node = definitions.nodes.front();
    const auto assignment = assignmentTo(facts_, node, variable);
    if (!assignment || std::ranges::find(following_, node) != following_.end())
      return std::nullopt;
    following_.push_back(node);
    const auto value = of(assignment->value, node);
    following_.pop_back();
    return value;
  }
  const bool given = bounds.mayBeNumber() && isGiven(variable, definitions);
  const auto counter = given ? std::nullopt : counterOf(variable, definitions);
  if (!given && !counter)
    return std::nullopt;
  inputs_.push_back({variable, definitions, {bounds}, counter});
  return add(FormulaInputId(inputs_.size() - 1));
}

/// As the caller or the operator has set it, or one of a few literals.
bool Formulas::isGiven(std::uint32_t variable, const Definitions &definitions) const {
  return std::ranges::all_of(definitions.nodes, [&](NodeId node) {
    const auto assignment = assignmentTo(facts_, node, variable);
    return assignment && literalValue(*facts_.file.tree, assignment->value);
  });
}

std::optional<FormulaInput::Counter> Formulas::counterOf(std::uint32_t variable, const Definitions &definitions) {
  for (const NodeId node : definitions.nodes) {
    const auto assignment = assignmentTo(facts_, node, variable);
    const auto step = assignment ? stepOf(facts_, *assignment, variable) : std::nullopt;
    if (!step || definitionsOf(facts_, variable, node) != definitions ||
        std::ranges::find(counting_, node) != counting_.end())
      continue;
    Definitions start = definitions;
    std::erase(start.nodes, node);
    counting_.push_back(node);
    const auto first = ofDefinitions(variable, start, AbstractValue::any());
    const auto size = first ? of(step->size, node) : std::nullopt;
    counting_.pop_back();
    if (!size || countsIn(*first) || countsIn(*size))
      return std::nullopt;
    return FormulaInput::Counter{node, *first, *size, step->isMinus, start.nodes};
  }
  return std::nullopt;
}

std::optional<FormulaInputId> Formulas::asInput(FormulaId id) const {
  const auto *input = std::get_if<FormulaInputId>(&nodes_[id.index()]);
  return input ? std::optional(*input) : std::nullopt;
}

std::vector<FormulaInputId> Formulas::inputsOf(FormulaId id) const {
  std::set<FormulaInputId> found;
  std::vector<FormulaId> open{id};
  while (!open.empty()) {
    const Node &node = nodes_[open.back().index()];
    open.pop_back();
    match(
        node, [](const RoundedNumber &) {},
        [&](const FormulaInputId &leaf) {
          if (found.insert(leaf).second && input(leaf).counter)
            open.insert(open.end(), {input(leaf).counter->start, input(leaf).counter->size});
        },
        [&](const Operation &operation) {
          open.insert(open.end(), {operation.left, operation.right});
        },
        [&](const Function &function) { open.push_back(function.argument); },
        [&](const Opposite &opposite) { open.push_back(opposite.operand); });
  }
  return {found.begin(), found.end()};
}

bool Formulas::countsIn(FormulaId id) const {
  return std::ranges::any_of(inputsOf(id), [&](FormulaInputId leaf) { return input(leaf).counter.has_value(); });
}

std::optional<RoundedNumber> Formulas::value(FormulaId id, const FormulaSetting &setting) const {
  return match(
      nodes_[id.index()], [](const RoundedNumber &number) { return std::optional(number); },
      [&](const FormulaInputId &leaf) { return leaf.index() < setting.size() ? setting[leaf.index()] : std::nullopt; },
      [&](const Operation &operation) { return valueOf(operation, setting); },
      [&](const Function &function) { return valueOf(function, setting); },
      [&](const Opposite &opposite) {
        const auto operand = value(opposite.operand, setting);
        return operand ? negate(*operand) : std::nullopt;
      });
}

std::optional<RoundedNumber> Formulas::valueOf(const Operation &operation, const FormulaSetting &setting) const {
  const auto left = value(operation.left, setting);
  const auto right = left ? value(operation.right, setting) : std::nullopt;
  if (!right)
    return std::nullopt;
  if (operation.op == OperatorKind::Add)
    return feedhold::add(*left, *right);
  if (operation.op == OperatorKind::Subtract)
    return subtract(*left, *right);
  return operation.op == OperatorKind::Multiply ? multiply(*left, *right) : divide(*left, *right);
}

std::optional<RoundedNumber> Formulas::valueOf(const Function &function, const FormulaSetting &setting) const {
  const auto argument = value(function.argument, setting);
  if (!argument)
    return std::nullopt;
  if (function.function == FunctionKind::Abs)
    return absolute(*argument);
  if (function.function == FunctionKind::Sqrt)
    return squareRoot(*argument);
  if (function.function == FunctionKind::Round)
    return round(*argument);
  return wholePart(*argument, function.function, *facts_.file.dialect);
}

std::optional<RoundedNumber> Formulas::stepped(const FormulaInput::Counter &counter, const RoundedNumber &value,
                                               const FormulaSetting &setting) const {
  const auto size = this->value(counter.size, setting);
  if (!size)
    return std::nullopt;
  return counter.isMinus ? subtract(value, *size) : feedhold::add(value, *size);
}

std::optional<RoundedTruth> Formulas::truth(OperatorKind relation, const RoundedNumber &left,
                                            const RoundedNumber &right) const {
  const double tolerance = facts_.file.dialect->behaviour.equalTolerance;
  const auto distance = subtract(left, right);
  if (!isRelation(relation) || !distance)
    return std::nullopt;
  const auto areEqual = [&](double exact) { return tolerance == 0 ? exact == 0 : std::abs(exact) < tolerance; };
  return RoundedTruth{holds(relation, left.exact, right.exact, areEqual(distance->exact.toDouble())),
                      holds(relation, left.computed, right.computed, areEqual(distance->computed))};
}

std::vector<FormulaGuard> Formulas::guardsOf(NodeId at) {
  const SyntaxTree &tree = *facts_.file.tree;
  std::vector<FormulaGuard> guards;
  for (const PassedTest &passed : testsBefore(facts_, at)) {
    const auto &test = std::get<Test>(facts_.node(passed.node).instruction);
    const auto *relation = asInside<BinaryOperation>(tree, *test.condition);
    if (!relation || !isRelation(relation->op))
      continue;
    const auto left = of(relation->left, passed.node);
    const auto right = left ? of(relation->right, passed.node) : std::nullopt;
    if (right)
      guards.push_back({relation->op, *left, *right, passed.isTrue});
  }
  return guards;
}

bool Formulas::pass(const std::vector<FormulaGuard> &guards, const FormulaSetting &setting) const {
  return std::ranges::all_of(guards, [&](const FormulaGuard &guard) {
    const auto left = value(guard.left, setting);
    const auto right = left ? value(guard.right, setting) : std::nullopt;
    const auto outcome = right ? truth(guard.relation, *left, *right) : std::nullopt;
    return !outcome || outcome->computed == guard.isTrue;
  });
}

std::optional<RoundedNumber> wholePart(const RoundedNumber &value, FunctionKind function, const Dialect &dialect) {
  const bool isFix = function == FunctionKind::Fix;
  const bool isTowardZero = dialect.behaviour.integerPart == IntegerPart::TowardZero;
  const bool isBelow = isTowardZero && value.computed < 0 ? !isFix : isFix;
  return isBelow ? floorOf(value) : ceilOf(value);
}

} // namespace feedhold::rules
