#include "inference/absint/loop_counters.h"

#include "inference/absint/refine.h"

#include <cmath>
#include <utility>

namespace feedhold {

namespace {

/// A loop of fewer rounds is gone through: the values of its counter are then known one by one.
constexpr double kFewRounds = 4;

const AbstractValue *valueIn(const AbstractState &state, std::uint32_t variable) {
  return variable <= kLocalVariables ? &state.locals[variable] : state.variables.find(variable);
}
AbstractValue *valueIn(AbstractState &state, std::uint32_t variable) {
  return const_cast<AbstractValue *>(valueIn(std::as_const(state), variable));
}

/// The last of the numbers that begin with `number` and go on in its grid for which `counter op limit` lets the loop go
/// on.  `GE` ends a loop that counts upwards where `LT` lets it go on.
std::optional<AbstractNumber> lastBefore(const AbstractNumber &number, OperatorKind op, const Interval &limit,
                                         bool upwards) {
  const double end = upwards ? limit.hi : limit.lo;
  const Interval way = upwards ? Interval{number.interval().lo, end} : Interval{end, number.interval().hi};
  const auto numbers = AbstractNumber::of(way, number.grid(), FiniteSet::many(), number.parts().exactness);
  if (!numbers || !way.isFinite())
    return std::nullopt;
  if (upwards)
    return op == OperatorKind::LessOrEqual || op == OperatorKind::GreaterThan ? numbers : meetLess(*numbers, end);
  return op == OperatorKind::GreaterOrEqual || op == OperatorKind::LessThan ? numbers : meetGreater(*numbers, end);
}

/// `#1+2`, `2+#1`, `#1-2` for #1.
std::optional<AbstractNumber> stepOf(const SyntaxTree &tree, ExpressionId value, std::uint32_t variable) {
  const auto *operation = std::get_if<BinaryOperation>(&tree.expressions[unwrapped(tree, value)].node);
  if (!operation || (operation->op != OperatorKind::Add && operation->op != OperatorKind::Subtract))
    return std::nullopt;
  const bool isLeft = variableNumber(tree, unwrapped(tree, operation->left)) == variable;
  const bool isRight = variableNumber(tree, unwrapped(tree, operation->right)) == variable;
  const auto step = literalValue(tree, isLeft ? operation->right : operation->left);
  if (isLeft == isRight || !step || step->toDouble() == 0 || (isRight && operation->op == OperatorKind::Subtract))
    return std::nullopt;
  const AbstractNumber number = AbstractNumber::constant(*step);
  return operation->op == OperatorKind::Add ? number : negate(number);
}

} // namespace

LoopCounters::LoopCounters(const ProgramFile &file, const Wto &wto, NodeId head) : tree_(&*file.tree) {
  const std::uint32_t begin = wto.positionOf(head);
  const std::uint32_t end = wto.endOf(head);
  const auto instructionAt = [&](std::uint32_t position) -> const Instruction & {
    return file.cfg.nodes[wto.order()[position]].instruction;
  };
  for (std::uint32_t position = begin; position < end; ++position)
    if (const auto *assign = std::get_if<Assign>(&instructionAt(position)))
      addSteps(file, *assign, position);
  for (std::uint32_t position = begin; position < end && !counters_.empty(); ++position)
    if (const auto *test = std::get_if<Test>(&instructionAt(position)); test && test->condition)
      addLimits(*test->condition, position);
  std::erase_if(counters_, [](const Counter &counter) { return counter.limits.empty(); });
}

void LoopCounters::addSteps(const ProgramFile &file, const Assign &assign, std::uint32_t position) {
  for (std::uint32_t i = 0; i < assign.count; ++i) {
    const auto *assignment = std::get_if<Assignment>(&tree_->statements[StatementId(assign.first.index() + i)].node);
    const auto variable = assignment ? variableNumber(*tree_, assignment->target) : std::nullopt;
    if (!variable || *variable == kVacantVariable || cellOf(*file.dialect, *variable) != *variable)
      continue;
    if (auto step = stepOf(*tree_, assignment->value, *variable))
      counters_.push_back({*variable, std::move(*step), position, {}});
  }
}

void LoopCounters::addLimits(ExpressionId condition, std::uint32_t position) {
  for (const ExpressionId id : subexpressions(*tree_, condition)) {
    const auto *operation = std::get_if<BinaryOperation>(&tree_->expressions[id].node);
    if (!operation || !isRelation(operation->op))
      continue;
    addLimit(operation->left, operation->op, operation->right, position);
    addLimit(operation->right, mirrored(operation->op), operation->left, position);
  }
}

void LoopCounters::addLimit(ExpressionId counter, OperatorKind op, ExpressionId value, std::uint32_t position) {
  const auto variable = variableNumber(*tree_, unwrapped(*tree_, counter));
  for (Counter &known : counters_)
    if (known.variable == variable)
      known.limits.push_back({op, value, position});
}

std::vector<AbstractNumber> LoopCounters::numbersIn(const AbstractState &state) const {
  std::vector<AbstractNumber> numbers;
  numbers.reserve(counters_.size());
  for (const Counter &counter : counters_) {
    const AbstractValue *value = valueIn(state, counter.variable);
    numbers.push_back(value ? value->number() : AbstractNumber::any());
  }
  return numbers;
}

/// A literal, or what a variable holds.
std::optional<AbstractNumber> LoopCounters::limitIn(const AbstractState &state, ExpressionId value) const {
  if (const auto literal = literalValue(*tree_, value))
    return AbstractNumber::constant(*literal);
  const auto variable = variableNumber(*tree_, unwrapped(*tree_, value));
  const AbstractValue *held = variable ? valueIn(state, *variable) : nullptr;
  return held && held->isNumber() ? std::optional(held->number()) : std::nullopt;
}

/// The nearest of the values at which a limit stops the counter.
std::optional<double> LoopCounters::lastOf(const AbstractState &state, const Counter &counter,
                                           const AbstractNumber &number, bool upwards) const {
  const auto endOf = [&](const AbstractNumber &reached) {
    return upwards ? reached.interval().hi : reached.interval().lo;
  };
  std::optional<double> nearest;
  for (const Limit &limit : counter.limits) {
    const auto bound = limitIn(state, limit.value);
    auto last = bound ? lastBefore(number, limit.op, bound->interval(), upwards) : std::nullopt;
    if (!last)
      continue;
    if (limit.position <= counter.position) // tested before it is counted on
      last = add(*last, counter.step);
    const double end = endOf(*last);
    const bool isBeyond = upwards ? end >= endOf(number) : end <= endOf(number);
    if (std::isfinite(end) && isBeyond && (!nearest || (upwards ? end < *nearest : end > *nearest)))
      nearest = end;
  }
  return nearest;
}

void LoopCounters::extend(AbstractState &state, const std::vector<AbstractNumber> &before) const {
  for (std::size_t i = 0; i < counters_.size(); ++i) {
    const Counter &counter = counters_[i];
    AbstractValue *value = valueIn(state, counter.variable);
    if (!value || !value->mayBeNumber())
      continue;
    const bool upwards = counter.step.interval().lo > 0;
    const Interval &old = before[i].interval();
    const Interval &now = value->number().interval();
    if (upwards ? now.hi <= old.hi : now.lo >= old.lo)
      continue;
    const auto last = lastOf(state, counter, value->number(), upwards);
    const double step = std::fabs(counter.step.interval().hi);
    if (!last || std::fabs(*last - (upwards ? old.hi : old.lo)) < kFewRounds * step)
      continue;
    const Interval extended = upwards ? Interval{now.lo, *last} : Interval{*last, now.hi};
    *value = value->withNumber(
        NumberParts{extended, value->number().grid(), FiniteSet::many(), value->number().parts().exactness}.result());
  }
}

} // namespace feedhold
