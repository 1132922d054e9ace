#include "inference/absint/refine.h"

#include "inference/absint/abstract_state.h"
#include "inference/absint/comparison_error.h"

#include <cmath>

namespace feedhold {

namespace {

/// Evaluates without telling anybody, and without stopping the run.
class Quiet {
public:
  explicit Quiet(AbstractInterpretation &interpretation)
      : interpretation_(interpretation), observer_(interpretation.observer()), stopped_(interpretation.stopped()) {
    interpretation_.observe(nullptr);
  }
  ~Quiet() {
    interpretation_.observe(observer_);
    interpretation_.start();
    if (stopped_)
      interpretation_.alarm(Truth::True, {});
  }
  Quiet(const Quiet &) = delete;
  Quiet &operator=(const Quiet &) = delete;

private:
  AbstractInterpretation &interpretation_;
  StepObserver *observer_;
  bool stopped_;
};

OperatorKind opposite(OperatorKind op) {
  switch (op) {
  case OperatorKind::Equal: return OperatorKind::NotEqual;
  case OperatorKind::NotEqual: return OperatorKind::Equal;
  case OperatorKind::GreaterThan: return OperatorKind::LessOrEqual;
  case OperatorKind::GreaterOrEqual: return OperatorKind::LessThan;
  case OperatorKind::LessThan: return OperatorKind::GreaterOrEqual;
  case OperatorKind::LessOrEqual: return OperatorKind::GreaterThan;
  case OperatorKind::Add:
  case OperatorKind::Subtract:
  case OperatorKind::Multiply:
  case OperatorKind::Divide:
  case OperatorKind::Modulo:
  case OperatorKind::Power:
  case OperatorKind::And:
  case OperatorKind::Or:
  case OperatorKind::Xor: break;
  }
  return op;
}

/// One rounding of a double more on each side: `x + 1 LE b` in doubles lets x be that much above b - 1.
Interval loosened(const Interval &interval) {
  return {std::nextafter(interval.lo, -INFINITY), std::nextafter(interval.hi, INFINITY)};
}
double finiteSize(const Interval &interval) {
  const double low = std::isfinite(interval.lo) ? std::fabs(interval.lo) : 0;
  return std::max(low, std::isfinite(interval.hi) ? std::fabs(interval.hi) : 0);
}
/// Likewise of a sum with mantissas of 32 bits, one operand of which is known.
Interval loosenedForSum(const Interval &sum, const Interval &operand) {
  const double size = finiteSize(operand); // an end that it does not have says nothing of the other one
  const auto by = [&](double bound) {
    return std::isfinite(bound) ? kErrorOfComparison * (std::fabs(bound) + 2 * size) : 0.0;
  };
  return {sum.lo - by(sum.lo), sum.hi + by(sum.hi)};
}

/// The numbers that stand in the relation to some number of `bound`.
std::optional<AbstractNumber> cut(const AbstractNumber &number, OperatorKind op, const AbstractNumber &bound) {
  if (op == OperatorKind::LessThan)
    return meetLess(number, bound.interval().hi);
  if (op == OperatorKind::LessOrEqual)
    return meetAtMost(number, bound.interval().hi);
  if (op == OperatorKind::GreaterThan)
    return meetGreater(number, bound.interval().lo);
  if (op == OperatorKind::GreaterOrEqual)
    return meetAtLeast(number, bound.interval().lo);
  if (op == OperatorKind::Equal)
    return meet(number, bound);
  const std::optional<double> constant = bound.constantValue();
  return op == OperatorKind::NotEqual && constant ? remove(number, *constant) : std::optional(number);
}

class Refiner {
public:
  explicit Refiner(AbstractContext &context)
      : context_(context), state_(context.state), quiet_(context.interpretation) {}

  bool condition(ExpressionId id, Holds holds) {
    const ExpressionId inner = unwrapped(context_.tree(), id);
    const auto *operation = std::get_if<BinaryOperation>(&context_.tree().expressions[inner].node);
    if (!operation)
      return holds == Holds::Yes || isZero(inner);
    if (isRelation(operation->op))
      return relation(holds == Holds::Yes ? operation->op : opposite(operation->op), operation->left, operation->right);
    if (operation->op == OperatorKind::And && holds == Holds::Yes)
      return conditionOrValue(operation->left, holds) && conditionOrValue(operation->right, holds);
    if (operation->op == OperatorKind::Or && holds == Holds::No)
      return conditionOrValue(operation->left, holds) && conditionOrValue(operation->right, holds);
    if (operation->op == OperatorKind::And || operation->op == OperatorKind::Or)
      return oneOf(*operation, holds);
    return true;
  }

  bool relation(OperatorKind op, ExpressionId left, const AbstractValue &right) {
    return side(left, op, value(left), right);
  }

private:
  /// A vacant value counts as 0 where a number stands for a condition.
  bool isZero(ExpressionId id) {
    const AbstractValue zero = context_.interpretation.number(0);
    return relation(OperatorKind::GreaterOrEqual, id, zero) && relation(OperatorKind::LessOrEqual, id, zero);
  }
  AbstractValue value(ExpressionId id) { return evaluate(context_, id); }

  /// AND of numbers is bitwise: only conditions say something of their parts.
  bool conditionOrValue(ExpressionId id, Holds holds) {
    const auto *operation =
        std::get_if<BinaryOperation>(&context_.tree().expressions[unwrapped(context_.tree(), id)].node);
    return operation && (isRelation(operation->op) || isBitwise(operation->op)) ? condition(id, holds) : true;
  }
  bool oneOf(const BinaryOperation &operation, Holds holds) {
    AbstractState first = state_;
    const bool leftPossible = conditionOrValue(operation.left, holds);
    std::swap(state_, first);
    const bool rightPossible = conditionOrValue(operation.right, holds);
    if (leftPossible && rightPossible)
      joinInto(context_.interpretation, state_, first);
    else if (leftPossible)
      state_ = std::move(first);
    return leftPossible || rightPossible;
  }

  bool relation(OperatorKind op, ExpressionId left, ExpressionId right) {
    const AbstractValue a = value(left);
    const AbstractValue b = value(right);
    return side(left, op, a, b) && side(right, mirrored(op), b, value(left));
  }

  /// `of op other`; vacancy as the relations of conditions take it.
  bool side(ExpressionId id, OperatorKind op, const AbstractValue &of, const AbstractValue &other) {
    if (context_.behaviour().equalTolerance != 0)
      return true; // relations are fuzzy: nothing is learnt
    if (op == OperatorKind::Equal || op == OperatorKind::NotEqual)
      return equality(id, op, of, other);
    const AbstractNumber bound = context_.interpretation.asNumber(other).number();
    const AbstractNumber zero = AbstractNumber::constant(0.0);
    const bool vacantFits = of.mayBeVacant() && cut(zero, op, bound).has_value();
    const auto number = of.mayBeNumber() ? compared(of.number(), op, bound) : std::nullopt;
    if (!number)
      return vacantFits ? push(id, AbstractValue::vacant()) : false;
    return push(id, vacantFits ? AbstractValue::vacantOr(*number) : AbstractValue::number(*number));
  }
  /// Two numbers that are equal have no difference, on any control.
  std::optional<AbstractNumber> compared(const AbstractNumber &number, OperatorKind op, const AbstractNumber &bound) {
    const bool isRounded = context_.interpretation.mayHaveMantissa32() && op != OperatorKind::NotEqual;
    return cut(number, op, isRounded ? loosenedFor(number, bound) : bound);
  }
  bool equality(ExpressionId id, OperatorKind op, const AbstractValue &of, const AbstractValue &other) {
    const bool same = op == OperatorKind::Equal;
    if (other.isVacant()) {
      const bool possible = same ? of.mayBeVacant() : of.mayBeNumber();
      return possible && push(id, same ? AbstractValue::vacant() : AbstractValue::number(of.number()));
    }
    const bool vacantFits = of.mayBeVacant() && (!same || other.mayBeVacant());
    std::optional<AbstractNumber> number;
    if (of.mayBeNumber())
      number = !same && other.mayBeVacant() ? std::optional(of.number()) : compared(of.number(), op, other.number());
    if (!number)
      return vacantFits ? push(id, AbstractValue::vacant()) : false;
    return push(id, vacantFits ? AbstractValue::vacantOr(*number) : AbstractValue::number(*number));
  }

  // ---- down to the variables ----

  /// The expression has a value within `wanted`.
  bool push(ExpressionId id, const AbstractValue &wanted) {
    const Expression &expression = context_.tree().expressions[unwrapped(context_.tree(), id)];
    if (AbstractValue *cell = cellOf(expression))
      return meetCell(*cell, wanted);
    if (!wanted.mayBeNumber())
      return true;
    return pushNumber(expression, loosened(wanted.number().interval()));
  }
  bool pushNumber(const Expression &expression, const Interval &wanted) {
    if (const auto *negation = std::get_if<Negation>(&expression.node))
      return within(negation->operand, negate(wanted));
    if (const auto *call = std::get_if<FunctionCall>(&expression.node))
      return pushFunction(*call, wanted);
    const auto *operation = std::get_if<BinaryOperation>(&expression.node);
    if (!operation)
      return true;
    const auto number = [&](ExpressionId id) {
      return context_.interpretation.asNumber(value(id)).number().interval();
    };
    const auto sum = [&](const Interval &operand) {
      return context_.interpretation.mayHaveMantissa32() ? loosenedForSum(wanted, operand) : wanted;
    };
    if (operation->op == OperatorKind::Add) {
      const Interval right = number(operation->right);
      if (!within(operation->left, subtract(sum(right), right)))
        return false;
      const Interval left = number(operation->left);
      return within(operation->right, subtract(sum(left), left));
    }
    if (operation->op == OperatorKind::Subtract) {
      const Interval right = number(operation->right);
      if (!within(operation->left, add(sum(right), right)))
        return false;
      const Interval left = number(operation->left);
      return within(operation->right, subtract(left, sum(left)));
    }
    return true;
  }
  bool pushFunction(const FunctionCall &call, const Interval &wanted) {
    if (call.function != FunctionKind::Abs || call.arguments().empty())
      return true;
    return wanted.hi < 0 ? false : within(call.arguments()[0], {-wanted.hi, wanted.hi});
  }
  /// A vacant operand counts as 0.
  bool within(ExpressionId id, const Interval &wanted) {
    const AbstractValue present = value(id);
    const auto number =
        present.mayBeNumber() ? meet(present.number(), AbstractNumber::inInterval(loosened(wanted))) : std::nullopt;
    const bool vacantFits = present.mayBeVacant() && loosened(wanted).contains(0.0);
    if (!number)
      return vacantFits ? push(id, AbstractValue::vacant()) : false;
    return push(id, vacantFits ? AbstractValue::vacantOr(*number) : AbstractValue::number(*number));
  }

  /// Where the state keeps the variable; null for what is no variable, or is read anew each time.
  AbstractValue *cellOf(const Expression &expression) {
    std::optional<std::uint32_t> number;
    if (const auto *numbered = std::get_if<NumberedVariable>(&expression.node)) {
      const auto integer = numbered->number.asInteger();
      if (integer && *integer > 0 && *integer < kFirstNamedVariable)
        number = static_cast<std::uint32_t>(*integer);
    } else if (const auto *indirect = std::get_if<IndirectVariable>(&expression.node)) {
      number = variableAt(context_, value(indirect->index), expression.span);
    } else if (const auto *named = std::get_if<NamedVariable>(&expression.node)) {
      number = context_.programs.variableOf(context_.file.file, named->name);
    }
    return number ? cellOf(*number) : nullptr;
  }
  /// Not the coordinate that the state keeps.
  bool readsOther() const {
    const auto always = context_.interpretation.truth(true);
    return context_.behaviour().positionIsOfCutter &&
           !context_.certain(context_.inForce(ModalKind::Compensation, {CodeAction::CompensationOff}, always));
  }
  AbstractValue *cellOf(std::uint32_t number) {
    if (isPredefinedName(number))
      number = feedhold::cellOf(context_.dialect(), number);
    if (context_.programs.isInputName(number))
      return nullptr; // read anew each time
    const VariableRange *range = number >= kFirstNamedVariable ? nullptr : findVariable(context_.dialect(), number);
    if (number < kFirstNamedVariable && !range)
      return nullptr;
    if (range && range->kind == VariableKind::Local && number <= kLocalVariables)
      return &state_.locals[number];
    if (range && (range->role == VariableRole::BlockEndPosition || range->role == VariableRole::WorkPosition))
      return !readsOther() && number - range->first < kAxisCount ? &state_.position[number - range->first] : nullptr;
    if (range && range->role != VariableRole::Plain && range->role != VariableRole::Stored)
      return nullptr;
    if (range && (findBitWord(context_.dialect(), number) || feedhold::cellOf(context_.dialect(), number) != number))
      return nullptr;
    if (!state_.variables.find(number))
      state_.variables.set(number, context_.interpretation.unwritten(state_, number));
    for (auto &[key, cell] : state_.variables.entries())
      if (key == number)
        return &cell;
    return nullptr;
  }

  bool meetCell(AbstractValue &cell, const AbstractValue &wanted) {
    const auto met = meet(cell, wanted);
    if (!met)
      return false;
    const auto origin = cell.origin();
    const bool changed = !(*met == cell);
    cell = met->withOrigin(origin);
    return !changed || !origin || origin->symbol == kZeroSymbol || carryOver(cell, *origin);
  }
  /// To the values at a known distance.  What is known in exact numbers is loosened by what doubles may have drifted.
  bool carryOver(const AbstractValue &from, const Origin &origin) {
    if (!from.isNumber())
      return true;
    bool possible = true;
    const Interval known = from.number().interval();
    forEachValue(state_, [&](AbstractValue &value) {
      if (&value == &from || !value.origin() || value.origin()->symbol != origin.symbol || !value.isNumber())
        return;
      const auto distance = subtract(value.origin()->offset, origin.offset);
      if (!distance)
        return;
      const double apart = distance->toDouble();
      const double slack = 1e-9 * (std::fabs(apart) + finiteSize(known));
      const Interval there{std::nextafter(known.lo + apart - slack, -INFINITY),
                           std::nextafter(known.hi + apart + slack, INFINITY)};
      if (const auto number = meet(value.number(), AbstractNumber::inInterval(there)))
        value = value.withNumber(*number);
      else
        possible = false;
    });
    return possible;
  }

  AbstractContext &context_;
  AbstractState &state_;
  Quiet quiet_;
};

} // namespace

bool assume(AbstractContext &context, ExpressionId condition, Holds holds) {
  return Refiner(context).condition(condition, holds);
}

bool assumeRoundsTo(AbstractContext &context, ExpressionId expression, double number) {
  Refiner refiner(context);
  return refiner.relation(OperatorKind::GreaterOrEqual, expression, context.interpretation.number(number - 0.5)) &&
         refiner.relation(OperatorKind::LessOrEqual, expression, context.interpretation.number(number + 0.5));
}

bool assumeDiffers(AbstractContext &context, ExpressionId expression, double value) {
  return Refiner(context).relation(OperatorKind::NotEqual, expression, context.interpretation.number(value));
}

OperatorKind mirrored(OperatorKind op) {
  if (op == OperatorKind::LessThan)
    return OperatorKind::GreaterThan;
  if (op == OperatorKind::GreaterThan)
    return OperatorKind::LessThan;
  if (op == OperatorKind::LessOrEqual)
    return OperatorKind::GreaterOrEqual;
  if (op == OperatorKind::GreaterOrEqual)
    return OperatorKind::LessOrEqual;
  return op;
}

} // namespace feedhold
