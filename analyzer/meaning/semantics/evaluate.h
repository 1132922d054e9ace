// Expressions and conditions: precedence is in the tree; rounding, vacancy and the domains of functions are here.
#pragma once

#include "base/support/match.h"
#include "meaning/semantics/increments.h"
#include "meaning/semantics/variables.h"

namespace feedhold {

/// Where an expression stands: ROUND rounds to the increment of the address inside a word (FANUC, operator's manual).
struct RoundingUnit {
  AddressKind address = AddressKind::None; // of the word; None: to whole numbers
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

  Evaluator(StepContext<R> &context, RoundingUnit unit)
      : context_(context), interpretation_(context.interpretation), unit_(unit) {}

  Value value(ExpressionId id) {
    const Expression &expression = context_.tree().expressions[id];
    Value result = valueOf(id, expression);
    interpretation_.hold(result, expression);
    interpretation_.evaluated(id, result);
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
    return interpretation_.negation(interpretation_.compare(Relation::Equal, number(inner), context_.zero()));
  }

private:
  /// Before it is rounded to the numbers of the control.
  Value valueOf(ExpressionId id, const Expression &expression) {
    return match(
        expression.node, [&](const NumberLiteral &literal) { return interpretation_.literal(literal.value); },
        [&](const NumberedVariable &variable) { return numbered(variable, expression.span); },
        [&](const IndirectVariable &variable) { return indirect(variable, expression.span); },
        [&](const NamedVariable &variable) { return named(variable, expression.span); },
        [&](const Negation &negation) { return interpretation_.negate(number(negation.operand)); },
        [&](const Identity &identity) { return value(identity.operand); },
        [&](const Bracketed &bracketed) { return inBrackets(bracketed); },
        [&](const BinaryOperation &operation) { return binary(id, operation, expression.span); },
        [&](const FunctionCall &call) { return function(call, expression.span); },
        [&](const BrokenExpression &) { return broken(expression.span); });
  }

  Value number(ExpressionId id) { return interpretation_.asNumber(value(id)); }

  Value numbered(const NumberedVariable &variable, Span place) {
    const std::optional<std::int64_t> number = variable.number.asInteger();
    if (number && *number < 0 && *number >= -0xffffffffLL) // reserved: no program text gives it (language/contract)
      return storedValue(context_, static_cast<std::uint32_t>(-*number));
    if (!number || *number < 0 || *number >= kFirstPredefinedName)
      return interpretation_.anything(); // a bit of a setting (#30057.21), or no variable at all
    return readVariable(context_, static_cast<std::uint32_t>(*number), place);
  }
  Value indirect(const IndirectVariable &variable, Span place) {
    const Value index = value(variable.index);
    if (const auto number = variableAt(context_, index, place))
      return readVariable(context_, *number, place);
    const Value any = interpretation_.readAnyOf(context_.state, interpretation_.asNumber(index), place);
    return context_.behaviour().variablesMayBeVacant ? any : interpretation_.asNumber(any);
  }
  Value named(const NamedVariable &variable, Span place) {
    if (const auto number = context_.programs.variableOf(context_.file.file, variable.name))
      return readVariable(context_, *number, place);
    return interpretation_.anything();
  }
  /// Whether `#2=[#1]` copies vacancy is not stated by any manual.
  Value inBrackets(const Bracketed &bracketed) {
    const Value inner = value(bracketed.inner);
    return interpretation_.mayBe(interpretation_.isVacant(inner))
               ? interpretation_.either(inner, interpretation_.asNumber(inner))
               : inner;
  }
  Value broken(Span place) {
    interpretation_.unmodelled("an expression that could not be read", place);
    return interpretation_.anything();
  }
  Value asValue(Truth truth) { return interpretation_.select(truth, interpretation_.number(1), context_.zero()); }

  Value binary(ExpressionId id, const BinaryOperation &operation, Span place) {
    if (isRelation(operation.op) ||
        (isBitwise(operation.op) && isCondition(operation.left) && isCondition(operation.right)))
      return asValue(condition(id));
    const Value left = number(operation.left);
    const Value right = number(operation.right);
    switch (operation.op) {
    case OperatorKind::Add: return sum(interpretation_.add(left, right), operation.op, left, right);
    case OperatorKind::Subtract: return sum(interpretation_.subtract(left, right), operation.op, left, right);
    case OperatorKind::Multiply: return interpretation_.multiply(left, right);
    case OperatorKind::Divide: requireNotZero(right, operation.right); return interpretation_.divide(left, right);
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

  Value sum(Value result, OperatorKind op, const Value &left, const Value &right) {
    interpretation_.holdSum(result, op, left, right);
    return result;
  }
  void requireNotZero(const Value &divisor, ExpressionId place) {
    interpretation_.alarm(interpretation_.compare(Relation::Equal, divisor, context_.zero()),
                          {AlarmKind::DivideByZero, spanOf(place)});
  }
  Value modulo(const Value &left, const Value &right, ExpressionId rightPlace) {
    if (context_.behaviour().modulo == ModuloMeaning::OfIntegers) {
      const Value divisor = interpretation_.roundTo(right, Decimal(1, 0));
      requireNotZero(divisor, rightPlace);
      return interpretation_.remainder(interpretation_.roundTo(left, Decimal(1, 0)), divisor);
    }
    requireNotZero(right, rightPlace);
    const Value rest = interpretation_.remainder(left, right);
    const Value size = interpretation_.function(FunctionKind::Abs, right);
    return interpretation_.select(interpretation_.compare(Relation::Less, rest, context_.zero()),
                                  interpretation_.add(rest, size), rest);
  }
  Value logic(OperatorKind op, const Value &left, const Value &right) {
    const auto integerOf = [&](const Value &value) {
      return context_.behaviour().logicOfIntegerParts ? integerPart(value, IntegerSide::Fix)
                                                      : interpretation_.roundTo(value, Decimal(1, 0));
    };
    if (context_.behaviour().logic == LogicMeaning::Bitwise)
      return interpretation_.bitwise(op, integerOf(left), integerOf(right));
    const auto isTrue = [&](const Value &value) {
      return interpretation_.negation(interpretation_.compare(Relation::Equal, value, context_.zero()));
    };
    return asValue(combine(op, isTrue(left), isTrue(right)));
  }
  Truth combine(OperatorKind op, Truth left, Truth right) {
    if (op == OperatorKind::And)
      return interpretation_.both(left, right);
    if (op == OperatorKind::Or)
      return context_.either(left, right);
    return context_.either(interpretation_.both(left, interpretation_.negation(right)),
                           interpretation_.both(interpretation_.negation(left), right));
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
    case OperatorKind::NotEqual: return interpretation_.negation(equal(left, right));
    case OperatorKind::GreaterThan:
      return interpretation_.compare(Relation::Greater, interpretation_.asNumber(left),
                                     interpretation_.asNumber(right));
    case OperatorKind::GreaterOrEqual:
      return interpretation_.compare(Relation::GreaterOrEqual, interpretation_.asNumber(left),
                                     interpretation_.asNumber(right));
    case OperatorKind::LessThan:
      return interpretation_.compare(Relation::Less, interpretation_.asNumber(left), interpretation_.asNumber(right));
    case OperatorKind::LessOrEqual:
      return interpretation_.compare(Relation::LessOrEqual, interpretation_.asNumber(left),
                                     interpretation_.asNumber(right));
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
    return interpretation_.unknownTruth();
  }
  Truth equal(const Value &left, const Value &right) {
    const Truth leftVacant = interpretation_.isVacant(left);
    const Truth rightVacant = interpretation_.isVacant(right);
    const Truth numbers =
        interpretation_.both(interpretation_.negation(leftVacant), interpretation_.negation(rightVacant));
    return context_.either(
        interpretation_.both(leftVacant, rightVacant),
        interpretation_.both(numbers, near(interpretation_.asNumber(left), interpretation_.asNumber(right))));
  }
  Truth near(const Value &left, const Value &right) {
    const double tolerance = context_.behaviour().equalTolerance;
    if (tolerance == 0)
      return interpretation_.compare(Relation::Equal, left, right);
    const Value distance = interpretation_.function(FunctionKind::Abs, interpretation_.subtract(left, right));
    return interpretation_.compare(Relation::Less, distance, interpretation_.number(tolerance));
  }
  // ---- functions ----

  Value function(const FunctionCall &call, Span place) {
    if (call.arguments().empty())
      return broken(place);
    switch (call.function) {
    case FunctionKind::Round: return rounded(number(call.arguments()[0]));
    case FunctionKind::Fix: return integerPart(number(call.arguments()[0]), IntegerSide::Fix);
    case FunctionKind::Fup: return integerPart(number(call.arguments()[0]), IntegerSide::Fup);
    case FunctionKind::Atan: return arcTangent(call);
    case FunctionKind::Pow:
      return call.arguments().size() < 2 ? broken(place)
                                         : power(number(call.arguments()[0]), number(call.arguments()[1]), place);
    case FunctionKind::Exists:
      return asValue(interpretation_.negation(interpretation_.isVacant(unread(call.arguments()[0]))));
    case FunctionKind::Sin:
    case FunctionKind::Cos:
    case FunctionKind::Abs: return interpretation_.function(call.function, number(call.arguments()[0]));
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
    case FunctionKind::AxNumber: return interpretation_.anyNumber(); // parameters of the machine
    }
    return broken(place);
  }

  /// What a variable holds, without the alarm of reading one that does not exist.
  Value unread(ExpressionId id) {
    const auto *name = std::get_if<NamedVariable>(&context_.tree().expressions[unwrapped(context_.tree(), id)].node);
    const auto number = name ? context_.programs.variableOf(context_.file.file, name->name) : std::nullopt;
    return number ? storedValue(context_, *number) : interpretation_.anything();
  }

  Value rounded(const Value &value) {
    const auto to = [&](Decimal step) { return interpretation_.roundTo(value, step); };
    return unit_.address == AddressKind::None ? to(Decimal(1, 0)) : byIncrement(context_, unit_.address, to);
  }

  enum class IntegerSide { Fix, Fup };
  Value integerPart(const Value &value, IntegerSide side) {
    if (context_.behaviour().integerPart == IntegerPart::TowardZero)
      return side == IntegerSide::Fix ? interpretation_.fix(value) : interpretation_.fup(value);
    return side == IntegerSide::Fix ? interpretation_.floor(value) : interpretation_.ceiling(value);
  }

  /// Two arguments: 0 to 360 degrees, or -180 to 180 with parameter NAT.  One: -90 to 90.
  Value arcTangent(const FunctionCall &call) {
    const Value opposite = number(call.arguments()[0]);
    if (call.arguments().size() < 2)
      return interpretation_.atan2(opposite, interpretation_.number(1));
    const Value angle = interpretation_.atan2(opposite, number(call.arguments()[1]));
    return bySwitch(fullTurn(angle), angle);
  }
  Value fullTurn(const Value &angle) {
    const Truth negative = interpretation_.compare(Relation::Less, angle, context_.zero());
    return interpretation_.select(negative, interpretation_.add(angle, interpretation_.number(360)), angle);
  }
  Value bySwitch(const Value &natOff, const Value &natOn) {
    switch (context_.dialect().switches.nat) {
    case Switch::Off: return natOff;
    case Switch::On: return natOn;
    case Switch::Unknown: return interpretation_.either(natOff, natOn);
    }
    return natOff;
  }
  Value power(const Value &base, const Value &exponent, Span place) {
    const Truth negativeBase = interpretation_.compare(Relation::Less, base, context_.zero());
    const Truth whole = interpretation_.compare(Relation::Equal, exponent, interpretation_.fix(exponent));
    const Truth zeroBase = interpretation_.compare(Relation::Equal, base, context_.zero());
    const Truth negativeExponent = interpretation_.compare(Relation::Less, exponent, context_.zero());
    interpretation_.alarm(context_.either(interpretation_.both(negativeBase, interpretation_.negation(whole)),
                                          interpretation_.both(zeroBase, negativeExponent)),
                          {AlarmKind::ArgumentOutOfDomain, place});
    return interpretation_.power(base, exponent);
  }

  /// The alarm comes from the dialect's row of the function, so that a control that takes any argument has none.
  Value inDomain(FunctionKind kind, const Value &argument, Span place) {
    const Function *row = findFunction(context_.dialect(), kind);
    if (row)
      interpretation_.alarm(
          outside(row->domain, argument),
          {row->domain == FunctionDomain::Exponent ? AlarmKind::Overflow : AlarmKind::ArgumentOutOfDomain, place});
    const Value result = interpretation_.function(kind, argument);
    if (kind == FunctionKind::Asin)
      return bySwitch(fullTurn(result), result);
    return result;
  }
  Truth outside(FunctionDomain domain, const Value &argument) {
    switch (domain) {
    case FunctionDomain::Any: return interpretation_.truth(false);
    case FunctionDomain::NotNegative:
    case FunctionDomain::Bcd: return interpretation_.compare(Relation::Less, argument, context_.zero());
    case FunctionDomain::Positive: return interpretation_.compare(Relation::LessOrEqual, argument, context_.zero());
    case FunctionDomain::MinusOneToOne:
      return interpretation_.compare(Relation::Greater, interpretation_.function(FunctionKind::Abs, argument),
                                     interpretation_.number(1));
    case FunctionDomain::Exponent: return overflows(argument);
    case FunctionDomain::NotPole: {
      const Value cosine = interpretation_.function(FunctionKind::Cos, argument);
      return interpretation_.compare(Relation::Less, interpretation_.function(FunctionKind::Abs, cosine),
                                     interpretation_.number(1e-12));
    }
    }
    return interpretation_.unknownTruth();
  }
  /// Of EXP: beyond about 1e308, or with the value range of Series 16 (6008#0) beyond 1e47 and below 1e-29.
  Truth overflows(const Value &exponent) {
    const Truth beyond = interpretation_.compare(Relation::Greater, exponent, interpretation_.number(709));
    const Truth outside =
        context_.either(interpretation_.compare(Relation::Greater, exponent, interpretation_.number(108)),
                        interpretation_.compare(Relation::Less, exponent, interpretation_.number(-66)));
    return context_.either(beyond, interpretation_.both(outside, context_.isOn(&Switches::f16)));
  }
  Span spanOf(ExpressionId id) const { return context_.tree().expressions[id].span; }

  StepContext<R> &context_;
  R &interpretation_;
  RoundingUnit unit_;
};

} // namespace detail

template <ValueAlgebra R>
typename R::Value evaluate(StepContext<R> &context, ExpressionId expression, RoundingUnit unit) {
  [[maybe_unused]] const auto scope = context.interpretation.inExpression();
  return detail::Evaluator<R>(context, unit).value(expression);
}

template <ValueAlgebra R> typename R::Truth evaluateCondition(StepContext<R> &context, ExpressionId condition) {
  [[maybe_unused]] const auto scope = context.interpretation.inExpression();
  return detail::Evaluator<R>(context, {}).condition(condition);
}

} // namespace feedhold
