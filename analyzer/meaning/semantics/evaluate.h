// Expressions and conditions: precedence is in the tree; rounding, vacancy and the domains of functions are here.
#pragma once

#include "base/support/match.h"
#include "meaning/semantics/variables.h"

namespace feedhold {

/// Where an expression stands: ROUND rounds to the increment of the address inside a word (FANUC, operator's manual).
struct RoundingUnit {
  Decimal step{1, 0};
};

/// The value, which may be vacant only when the expression is a lone variable.
template <ValueAlgebra R>
typename R::Value evaluate(StepContext<R> &context, ExpressionId expression, RoundingUnit unit = {});

/// The truth of the condition of an IF or WHILE.
template <ValueAlgebra R> typename R::Truth evaluateCondition(StepContext<R> &context, ExpressionId condition);

namespace detail {

template <ValueAlgebra R> class Evaluator {
public:
  using Value = typename R::Value;
  using Truth = typename R::Truth;

  Evaluator(StepContext<R> &context, RoundingUnit unit) : context_(context), reading_(context.reading), unit_(unit) {}

  Value value(ExpressionId id) {
    const Expression &expression = context_.tree().expressions[id];
    const Value result = match(
        expression.node, [&](const NumberLiteral &literal) { return reading_.literal(literal.value); },
        [&](const NumberedVariable &variable) { return numbered(variable, expression.span); },
        [&](const IndirectVariable &variable) { return indirect(variable, expression.span); },
        [&](const NamedVariable &variable) { return named(variable, expression.span); },
        [&](const Negation &negation) { return reading_.negate(number(negation.operand)); },
        [&](const Identity &identity) { return value(identity.operand); },
        [&](const Bracketed &bracketed) { return inBrackets(bracketed); },
        [&](const BinaryOperation &operation) { return binary(id, operation, expression.span); },
        [&](const FunctionCall &call) { return function(call, expression.span); },
        [&](const BrokenExpression &) { return broken(expression.span); });
    reading_.evaluated(id, result);
    return result;
  }

  Truth condition(ExpressionId id) {
    const ExpressionId inner = unwrapped(context_.tree(), id);
    const Expression &expression = context_.tree().expressions[inner];
    if (const auto *operation = std::get_if<BinaryOperation>(&expression.node)) {
      if (isRelation(operation->op))
        return relation(*operation);
      if (isBitwise(operation->op) && isCondition(operation->left) && isCondition(operation->right))
        return joined(*operation);
    }
    return reading_.negation(reading_.compare(Relation::Equal, number(inner), context_.zero()));
  }

private:
  Value number(ExpressionId id) { return reading_.asNumber(value(id)); }

  Value numbered(const NumberedVariable &variable, Span place) {
    const std::optional<std::int64_t> number = variable.number.asInteger();
    if (number && *number < 0 && *number >= -0xffffffffLL) // reserved: no program text gives it (language/contract)
      return storedValue(context_, static_cast<std::uint32_t>(-*number));
    if (!number || *number < 0 || *number >= kFirstNamedVariable)
      return reading_.anything(); // a bit of a setting (#30057.21), or no variable at all
    return readVariable(context_, static_cast<std::uint32_t>(*number), place);
  }
  Value indirect(const IndirectVariable &variable, Span place) {
    const Value index = value(variable.index);
    if (const auto number = variableAt(context_, index, place))
      return readVariable(context_, *number, place);
    return reading_.readAnyOf(context_.state, reading_.asNumber(index), place);
  }
  Value named(const NamedVariable &variable, Span place) {
    if (const auto number = context_.programs.variableOf(context_.file.file, variable.name))
      return readVariable(context_, *number, place);
    return reading_.anything();
  }
  /// Whether `#2=[#1]` copies vacancy is not stated by any manual.
  Value inBrackets(const Bracketed &bracketed) {
    const Value inner = value(bracketed.inner);
    return reading_.mayBe(reading_.isVacant(inner)) ? reading_.either(inner, reading_.asNumber(inner)) : inner;
  }
  Value broken(Span place) {
    reading_.notModelled("an expression that could not be read", place);
    return reading_.anything();
  }
  Value asValue(Truth truth) { return reading_.select(truth, reading_.number(1), context_.zero()); }

  Value binary(ExpressionId id, const BinaryOperation &operation, Span place) {
    if (isRelation(operation.op) ||
        (isBitwise(operation.op) && isCondition(operation.left) && isCondition(operation.right)))
      return asValue(condition(id));
    const Value left = number(operation.left);
    const Value right = number(operation.right);
    switch (operation.op) {
    case OperatorKind::Add: return reading_.add(left, right);
    case OperatorKind::Subtract: return reading_.subtract(left, right);
    case OperatorKind::Multiply: return reading_.multiply(left, right);
    case OperatorKind::Divide: requireNotZero(right, operation.right); return reading_.divide(left, right);
    case OperatorKind::Modulo: return modulo(left, right, operation.right);
    case OperatorKind::Power: return power(left, right, place);
    case OperatorKind::And:
    case OperatorKind::Or:
    case OperatorKind::Xor: return logic(operation.op, left, right);
    case OperatorKind::Equal:
    case OperatorKind::NotEqual:
    case OperatorKind::GreaterThan:
    case OperatorKind::GreaterOrEqual:
    case OperatorKind::LessThan:
    case OperatorKind::LessOrEqual: break; // a relation: seen above
    }
    return broken(place);
  }

  void requireNotZero(const Value &divisor, ExpressionId place) {
    reading_.alarm(reading_.compare(Relation::Equal, divisor, context_.zero()),
                   {AlarmKind::DivideByZero, spanOf(place)});
  }
  Value modulo(const Value &left, const Value &right, ExpressionId rightPlace) {
    if (context_.behaviour().modulo == ModuloMeaning::OfIntegers) {
      const Value divisor = reading_.roundTo(right, Decimal(1, 0));
      requireNotZero(divisor, rightPlace);
      return reading_.remainder(reading_.roundTo(left, Decimal(1, 0)), divisor);
    }
    requireNotZero(right, rightPlace);
    const Value rest = reading_.remainder(left, right);
    const Value size = reading_.function(FunctionKind::Abs, right);
    return reading_.select(reading_.compare(Relation::Less, rest, context_.zero()), reading_.add(rest, size), rest);
  }
  Value logic(OperatorKind op, const Value &left, const Value &right) {
    if (context_.behaviour().logic == LogicMeaning::Bitwise)
      return reading_.bitwise(op, reading_.roundTo(left, Decimal(1, 0)), reading_.roundTo(right, Decimal(1, 0)));
    const auto isTrue = [&](const Value &value) {
      return reading_.negation(reading_.compare(Relation::Equal, value, context_.zero()));
    };
    return asValue(combine(op, isTrue(left), isTrue(right)));
  }
  Truth combine(OperatorKind op, Truth left, Truth right) {
    if (op == OperatorKind::And)
      return reading_.both(left, right);
    if (op == OperatorKind::Or)
      return context_.either(left, right);
    return context_.either(reading_.both(left, reading_.negation(right)),
                           reading_.both(reading_.negation(left), right));
  }

  // ---- conditions ----

  bool isCondition(ExpressionId id) const {
    const Expression &expression = context_.tree().expressions[unwrapped(context_.tree(), id)];
    const auto *operation = std::get_if<BinaryOperation>(&expression.node);
    return operation && (isRelation(operation->op) ||
                         (isBitwise(operation->op) && isCondition(operation->left) && isCondition(operation->right)));
  }
  Truth joined(const BinaryOperation &operation) {
    const Truth left = condition(operation.left);
    return combine(operation.op, left, condition(operation.right)); // both sides are evaluated: no short cut
  }
  /// EQ and NE tell vacant from 0, the other relations take it as 0.
  Truth relation(const BinaryOperation &operation) {
    const Value left = value(operation.left);
    const Value right = value(operation.right);
    switch (operation.op) {
    case OperatorKind::Equal: return equal(left, right);
    case OperatorKind::NotEqual: return reading_.negation(equal(left, right));
    case OperatorKind::GreaterThan:
      return reading_.compare(Relation::Greater, reading_.asNumber(left), reading_.asNumber(right));
    case OperatorKind::GreaterOrEqual:
      return reading_.compare(Relation::GreaterOrEqual, reading_.asNumber(left), reading_.asNumber(right));
    case OperatorKind::LessThan:
      return reading_.compare(Relation::Less, reading_.asNumber(left), reading_.asNumber(right));
    case OperatorKind::LessOrEqual:
      return reading_.compare(Relation::LessOrEqual, reading_.asNumber(left), reading_.asNumber(right));
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
    return reading_.unknownTruth();
  }
  Truth equal(const Value &left, const Value &right) {
    const Truth leftVacant = reading_.isVacant(left);
    const Truth rightVacant = reading_.isVacant(right);
    const Truth numbers = reading_.both(reading_.negation(leftVacant), reading_.negation(rightVacant));
    return context_.either(reading_.both(leftVacant, rightVacant),
                           reading_.both(numbers, near(reading_.asNumber(left), reading_.asNumber(right))));
  }
  Truth near(const Value &left, const Value &right) {
    const double tolerance = context_.behaviour().equalTolerance;
    if (tolerance == 0)
      return reading_.compare(Relation::Equal, left, right);
    const Value distance = reading_.function(FunctionKind::Abs, reading_.subtract(left, right));
    return reading_.compare(Relation::Less, distance, reading_.number(tolerance));
  }
  // ---- functions ----

  Value function(const FunctionCall &call, Span place) {
    if (call.arguments().empty())
      return broken(place);
    switch (call.function) {
    case FunctionKind::Round: return reading_.roundTo(number(call.arguments()[0]), unit_.step);
    case FunctionKind::Fix: return integerPart(number(call.arguments()[0]), IntegerSide::Fix);
    case FunctionKind::Fup: return integerPart(number(call.arguments()[0]), IntegerSide::Fup);
    case FunctionKind::Atan: return arcTangent(call);
    case FunctionKind::Pow:
      return call.arguments().size() < 2 ? broken(place)
                                         : power(number(call.arguments()[0]), number(call.arguments()[1]), place);
    case FunctionKind::Exists: return asValue(reading_.negation(reading_.isVacant(unread(call.arguments()[0]))));
    case FunctionKind::Sin:
    case FunctionKind::Cos:
    case FunctionKind::Abs: return reading_.function(call.function, number(call.arguments()[0]));
    case FunctionKind::Tan:
    case FunctionKind::Asin:
    case FunctionKind::Acos:
    case FunctionKind::Sqrt:
    case FunctionKind::Ln:
    case FunctionKind::Exp:
    case FunctionKind::Bin:
    case FunctionKind::Bcd: return inDomain(call.function, number(call.arguments()[0]), spanOf(call.arguments()[0]));
    case FunctionKind::Adp:
    case FunctionKind::Prm:
    case FunctionKind::Ax:
    case FunctionKind::AxNumber: return reading_.anyNumber(); // parameters of the machine
    }
    return broken(place);
  }

  /// What a variable holds, without the alarm of reading one that does not exist.
  Value unread(ExpressionId id) {
    const auto *name = std::get_if<NamedVariable>(&context_.tree().expressions[unwrapped(context_.tree(), id)].node);
    const auto number = name ? context_.programs.variableOf(context_.file.file, name->name) : std::nullopt;
    return number ? storedValue(context_, *number) : reading_.anything();
  }

  enum class IntegerSide { Fix, Fup };
  Value integerPart(const Value &value, IntegerSide side) {
    if (context_.behaviour().integerPart == IntegerPart::TowardZero)
      return side == IntegerSide::Fix ? reading_.fix(value) : reading_.fup(value);
    return side == IntegerSide::Fix ? reading_.floor(value) : reading_.ceiling(value);
  }

  /// Two arguments: 0 to 360 degrees, or -180 to 180 with parameter NAT.  One: -90 to 90.
  Value arcTangent(const FunctionCall &call) {
    const Value opposite = number(call.arguments()[0]);
    if (call.arguments().size() < 2)
      return reading_.atan2(opposite, reading_.number(1));
    const Value angle = reading_.atan2(opposite, number(call.arguments()[1]));
    return bySwitch(fullTurn(angle), angle);
  }
  Value fullTurn(const Value &angle) {
    const Truth negative = reading_.compare(Relation::Less, angle, context_.zero());
    return reading_.select(negative, reading_.add(angle, reading_.number(360)), angle);
  }
  Value bySwitch(const Value &natOff, const Value &natOn) {
    switch (context_.dialect().switches.nat) {
    case Switch::Off: return natOff;
    case Switch::On: return natOn;
    case Switch::Unknown: return reading_.either(natOff, natOn);
    }
    return natOff;
  }
  Value power(const Value &base, const Value &exponent, Span place) {
    const Truth negativeBase = reading_.compare(Relation::Less, base, context_.zero());
    const Truth whole = reading_.compare(Relation::Equal, exponent, reading_.fix(exponent));
    const Truth zeroBase = reading_.compare(Relation::Equal, base, context_.zero());
    const Truth negativeExponent = reading_.compare(Relation::Less, exponent, context_.zero());
    reading_.alarm(context_.either(reading_.both(negativeBase, reading_.negation(whole)),
                                   reading_.both(zeroBase, negativeExponent)),
                   {AlarmKind::ArgumentOutOfDomain, place});
    return reading_.power(base, exponent);
  }

  /// The alarm comes from the dialect's row of the function, so that a control that takes any argument has none.
  Value inDomain(FunctionKind kind, const Value &argument, Span place) {
    const Function *row = findFunction(context_.dialect(), kind);
    if (row)
      reading_.alarm(
          outside(row->domain, argument),
          {row->domain == FunctionDomain::Exponent ? AlarmKind::Overflow : AlarmKind::ArgumentOutOfDomain, place});
    const Value result = reading_.function(kind, argument);
    if (kind == FunctionKind::Asin)
      return bySwitch(fullTurn(result), result);
    return result;
  }
  Truth outside(FunctionDomain domain, const Value &argument) {
    switch (domain) {
    case FunctionDomain::Any: return reading_.truth(false);
    case FunctionDomain::NotNegative:
    case FunctionDomain::Bcd: return reading_.compare(Relation::Less, argument, context_.zero());
    case FunctionDomain::Positive: return reading_.compare(Relation::LessOrEqual, argument, context_.zero());
    case FunctionDomain::MinusOneToOne:
      return reading_.compare(Relation::Greater, reading_.function(FunctionKind::Abs, argument), reading_.number(1));
    case FunctionDomain::Exponent: return overflows(argument);
    case FunctionDomain::NotPole: {
      const Value cosine = reading_.function(FunctionKind::Cos, argument);
      return reading_.compare(Relation::Less, reading_.function(FunctionKind::Abs, cosine), reading_.number(1e-12));
    }
    }
    return reading_.unknownTruth();
  }
  /// Of EXP: beyond about 1e308, or with the value range of Series 16 (6008#0) beyond 1e47 and below 1e-29.
  Truth overflows(const Value &exponent) {
    const Truth beyond = reading_.compare(Relation::Greater, exponent, reading_.number(709));
    const Truth outside = context_.either(reading_.compare(Relation::Greater, exponent, reading_.number(108)),
                                          reading_.compare(Relation::Less, exponent, reading_.number(-66)));
    return context_.either(beyond, reading_.both(outside, context_.isOn(context_.dialect().switches.f16)));
  }
  Span spanOf(ExpressionId id) const { return context_.tree().expressions[id].span; }

  StepContext<R> &context_;
  R &reading_;
  RoundingUnit unit_;
};

} // namespace detail

template <ValueAlgebra R>
typename R::Value evaluate(StepContext<R> &context, ExpressionId expression, RoundingUnit unit) {
  return detail::Evaluator<R>(context, unit).value(expression);
}

template <ValueAlgebra R> typename R::Truth evaluateCondition(StepContext<R> &context, ExpressionId condition) {
  return detail::Evaluator<R>(context, {}).condition(condition);
}

} // namespace feedhold
