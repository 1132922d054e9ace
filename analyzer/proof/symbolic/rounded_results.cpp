// Results as the control rounds them: to the nearest double, or within the errors of shorter mantissas; words to the
// least increment (docs/arithmetic.md).
#include "base/support/mantissa32.h"
#include "proof/smt/exact_angles.h"
#include "proof/symbolic/literal_cases.h"
#include "proof/symbolic/symbolic_interpretation.h"

#include <cmath>
#include <fmt/format.h>

namespace feedhold::prove {

using smt::Function;
using smt::Number;
using smt::TermId;

namespace {

Number numberOf(Decimal value) {
  Number number(static_cast<std::int64_t>(value.mantissa()));
  for (int i = 0; i < value.scale(); ++i)
    number /= Number(10);
  return number;
}

/// In a mantissa of 31 bits.
bool isShort(const Number &number) {
  int exponent = 0;
  const double value = number.toDouble();
  const double mantissa = std::ldexp(std::frexp(value, &exponent), 31);
  return std::floor(mantissa) == mantissa && Number::fromDouble(value) == number;
}

/// Far above what the cosine is off by.
constexpr double kLeastCosineOfTangent = 1e-6;

} // namespace

SymbolicValue SymbolicInterpretation::literal(Decimal value) {
  return arithmetic_ == Arithmetic::Exact ? of(store_.number(numberOf(value))) : number(value.toDouble());
}

/// What a control with shorter mantissas keeps of a literal in an expression.  Coordinates stay as they are written.
void SymbolicInterpretation::hold(Value &value, const Expression &expression) {
  if (std::holds_alternative<NumberLiteral>(expression.node))
    value = asHeld(value);
}

SymbolicValue SymbolicInterpretation::asHeld(const Value &value) {
  if (!hasShortMantissas())
    return value;
  const bool fits =
      store_.isNumber(value.number) ? isShort(store_[value.number].number) : grids_.of(value.number).value_or(-1) >= 0;
  return fits ? value : Value{value.vacant, inShortMantissa(value.number)};
}

TermId SymbolicInterpretation::inShortMantissa(TermId number) {
  return near(number, shortRounding(store_, sizeOf(number))).number;
}

// ---- results as doubles ----

/// A multiple of 2^k is a double up to 2^(53 + k); what is copied or negated stays one.
SymbolicValue SymbolicInterpretation::result(Operation operation, TermId exact, const Value &a, const Value &b) {
  if (rounds_ == Rounds::No)
    return of(exact);
  for (const TermId operand : {a.number, b.number})
    if (exact == operand || exact == store_.negate(operand))
      return of(exact);
  if (const auto sum = increments_.sumOfWords(exact))
    return of(*sum);
  const auto grid = store_.isNumber(exact) || isRoundedHere() ? std::nullopt : grids_.of(exact);
  if (!grid)
    return hasShortMantissas() ? inShortMantissa(operation, exact, a, b) : of(store_.apply(Function::Nearest, exact));
  constexpr int kBitsOfDouble = 53, kBitsOfShort = 31;
  exact_.push_back({exact, (hasShortMantissas() ? kBitsOfShort : kBitsOfDouble) + std::min(*grid, 0)});
  return of(exact);
}

template <typename Compute>
std::optional<SymbolicValue> SymbolicInterpretation::inEachCase(const Value &a, const Value &b,
                                                                const Compute &compute) {
  const auto cases = literalCases(store_, a.number, b.number);
  if (!cases)
    return std::nullopt;
  const auto in = [&](const std::array<TermId, 2> &numbers) { return compute(of(numbers[0]), of(numbers[1])); };
  const Value ifSo = in(cases->ifSo);
  return select({cases->condition}, ifSo, in(cases->ifNot));
}

SymbolicValue SymbolicInterpretation::add(const Value &a, const Value &b) {
  if (const auto value = inEachCase(a, b, [&](const Value &x, const Value &y) { return add(x, y); }))
    return *value;
  return result(Operation::Sum, store_.add(a.number, b.number), a, b);
}
SymbolicValue SymbolicInterpretation::subtract(const Value &a, const Value &b) {
  if (const auto value = inEachCase(a, b, [&](const Value &x, const Value &y) { return subtract(x, y); }))
    return *value;
  return result(Operation::Sum, store_.subtract(a.number, b.number), a, b);
}
SymbolicValue SymbolicInterpretation::negate(const Value &a) {
  if (const auto value = inEachCase(a, a, [&](const Value &x, const Value &) { return negate(x); }))
    return *value;
  return of(store_.negate(a.number));
}
SymbolicValue SymbolicInterpretation::multiply(const Value &a, const Value &b) {
  if (const auto value = inEachCase(a, b, [&](const Value &x, const Value &y) { return multiply(x, y); }))
    return *value;
  const TermId exact = store_.multiply(a.number, b.number);
  return isMultipleByPowerOfTwo(a) || isMultipleByPowerOfTwo(b) ? of(exact) : result(Operation::Product, exact, a, b);
}
SymbolicValue SymbolicInterpretation::divide(const Value &a, const Value &b) {
  if (const auto value = inEachCase(a, b, [&](const Value &x, const Value &y) { return divide(x, y); }))
    return *value;
  const TermId exact = store_.divide(a.number, b.number);
  return isMultipleByPowerOfTwo(b) ? of(exact) : result(Operation::Quotient, exact, a, b);
}
/// Only the exponent of the other factor changes.
bool SymbolicInterpretation::isMultipleByPowerOfTwo(const Value &factor) const {
  if (!store_.isNumber(factor.number))
    return false;
  int exponent = 0;
  return std::fabs(std::frexp(store_[factor.number].number.toDouble(), &exponent)) == 0.5;
}

SymbolicValue SymbolicInterpretation::near(TermId exact, TermId distance) {
  const std::array arguments{exact, distance};
  return of(store_.apply(Function::Near, arguments));
}

TermId SymbolicInterpretation::sizeOf(TermId number) {
  return isNeverNegative(number) ? number : store_.absolute(number);
}

// ---- results in mantissas of 32 bits ----

/// A control that may compute in doubles as well errs less.
bool SymbolicInterpretation::hasShortMantissas() const {
  return rounds_ == Rounds::AsDialect && numbersOf(*dialect_) != NumberModel::Binary64;
}

/// Within the errors of the manual, which are those of doubles, too.  What fits is exact.
SymbolicValue SymbolicInterpretation::inShortMantissa(Operation operation, TermId exact, const Value &a,
                                                      const Value &b) {
  if (store_.isNumber(exact) && isShort(store_[exact].number))
    return of(exact);
  const auto partOf = [&](double part, TermId size) { return store_.scale(Number::fromTyped(part), size); };
  switch (operation) {
  case Operation::Sum:
    return near(exact, partOf(mantissa32::kErrorOfSum, store_.add(sizeOf(a.number), sizeOf(b.number))));
  case Operation::Product: return near(exact, partOf(mantissa32::kErrorOfProduct.relative, sizeOf(exact)));
  case Operation::Quotient: return near(exact, partOf(mantissa32::kErrorOfQuotient.relative, sizeOf(exact)));
  }
  return anyNumber();
}

/// "TAN performs SIN/COS" (16i operator's manual, 15.3): no error is known where the cosine may be as small as its own.
SymbolicValue SymbolicInterpretation::tangentInShortMantissa(const Value &argument) {
  const TermId angle = argument.number;
  if (!store_.isNumber(angle))
    return anyNumber();
  const smt::Enclosure cosine = smt::encloseSine(Number(90) - store_[angle].number);
  const Number least = Number::fromTyped(kLeastCosineOfTangent);
  if (cosine.low < least && Number(0) - least < cosine.high)
    return anyNumber();
  return divide(function(FunctionKind::Sin, argument), function(FunctionKind::Cos, argument));
}

SymbolicValue SymbolicInterpretation::functionInShortMantissa(FunctionKind kind, TermId exact, const Value &argument) {
  if (kind == FunctionKind::Tan)
    return tangentInShortMantissa(argument);
  const bool isOfAngle = kind == FunctionKind::Sin || kind == FunctionKind::Cos;
  const bool isAngle = kind == FunctionKind::Asin || kind == FunctionKind::Acos || kind == FunctionKind::Atan;
  const mantissa32::Error error = kind == FunctionKind::Sqrt ? mantissa32::kErrorOfRoot
                                  : isOfAngle                ? mantissa32::kErrorOfSine
                                  : isAngle                  ? mantissa32::kErrorOfAngle
                                                             : mantissa32::kErrorOfOthers;
  const TermId distance = store_.add(store_.number(Number::fromTyped(error.absolute)),
                                     store_.scale(Number::fromTyped(error.relative), sizeOf(exact)));
  return store_.isNumber(exact) ? constantNear(kind, exact, distance, argument) : near(exact, distance);
}

/// Roots are rounded to the nearest; of the other functions no control says how near they are.
SymbolicValue SymbolicInterpretation::resultOf(FunctionKind kind, TermId exact, const Value &argument) {
  if (rounds_ == Rounds::No)
    return of(exact);
  if (hasShortMantissas())
    return functionInShortMantissa(kind, exact, argument);
  const TermId error = store_.number(Number(1) / Number(std::int64_t{1} << 36));
  if (kind == FunctionKind::Sqrt)
    return of(store_.apply(Function::Nearest, exact));
  const bool isOfAngle = kind == FunctionKind::Sin || kind == FunctionKind::Cos;
  const bool isAngle = kind == FunctionKind::Asin || kind == FunctionKind::Acos || kind == FunctionKind::Atan;
  if (isOfAngle && store_.isNumber(argument.number) && (store_[argument.number].number / Number(90)).isInteger())
    return of(exact);
  const TermId distance = isOfAngle || isAngle ? error : store_.multiply(error, sizeOf(exact));
  return store_.isNumber(exact) ? constantNear(kind, exact, distance, argument) : near(exact, distance);
}

/// SIN[30] and COS[60] are 1/2, and may be off by different amounts: a number of its own for each.
SymbolicValue SymbolicInterpretation::constantNear(FunctionKind kind, TermId exact, TermId distance,
                                                   const Value &argument) {
  const std::size_t known = named_.size();
  const Value value =
      named(fmt::format("function {} of {} near {}", static_cast<int>(kind), argument.number.index(), exact.index()),
            MayBeVacant::No);
  if (named_.size() != known)
    facts_.push_back(store_.logicalAnd(store_.lessOrEqual(store_.subtract(exact, distance), value.number),
                                       store_.lessOrEqual(value.number, store_.add(exact, distance))));
  return value;
}

/// What the machine makes of a number without variables, if it makes the same of all that the control may have for it:
/// multiplying by the steps and rounding keep the order.
std::optional<double> SymbolicInterpretation::onlyWord(TermId number, Decimal step) {
  const double steps = std::pow(10.0, step.scale()) / static_cast<double>(step.mantissa());
  const auto wordOf = [steps](double value) { return std::round(value * steps) / steps; };
  const auto values = groundTruth_.ofNumber(number);
  return values && wordOf(values->lo) == wordOf(values->hi) ? std::optional(wordOf(values->lo)) : std::nullopt;
}

/// As the machine computes it: half a step; and the rounding of the product and of the quotient, 2^-52 of the value
/// together.  Coordinates are small; where that is not proved, the distance goes by the value.  What is rounded to the
/// nearest keeps its size with the other sign: of a number and its negation one word is made, of which that is the
/// negation.
SymbolicValue SymbolicInterpretation::roundedWord(const Value &value, Decimal step) {
  if (const auto word = inEachCase(value, value, [&](const Value &x, const Value &) { return roundedWord(x, step); }))
    return *word;
  if (const auto word = onlyWord(value.number, step))
    return number(*word);
  if (const auto word = isRoundedHere() ? std::nullopt : increments_.wordOf(value.number, numberOf(step), exact_))
    return of(*word);
  const TermId opposite = store_.negate(value.number);
  const bool isOpposite = opposite < value.number;
  const TermId exact = isOpposite ? opposite : value.number;
  const TermId word = near(exact, distanceOfWord(exact, numberOf(step) / Number(2))).number;
  return of(isOpposite ? store_.negate(word) : word);
}

TermId SymbolicInterpretation::isMultiple(TermId number, const Number &step) {
  if (increments_.isTypedMultiple(number, step))
    return store_.yes();
  const TermId steps =
      store_.floor(store_.add(store_.scale(Number(1) / step, number), store_.number(Number(1) / Number(2))));
  const TermId multiple = store_.scale(step, steps);
  if (store_.isNumber(number) && numbersOf(*dialect_) != NumberModel::Binary64)
    if (const double held = store_[number].number.toDouble();
        held == mantissa32::nearest(store_[multiple].number.toDouble()))
      return store_.yes();
  return store_.equal(number, arithmetic_ == Arithmetic::Exact ? multiple : store_.apply(Function::Nearest, multiple));
}

TermId SymbolicInterpretation::distanceOfWord(TermId exact, const Number &half) {
  if (isRoundedHere())
    return store_.add(store_.number(half * Number(1'000'001) / Number(1'000'000)),
                      store_.scale(Number(1) / Number(std::int64_t{1} << 52), sizeOf(exact)));
  constexpr int kBitsOfWord = 30;
  exact_.push_back({exact, kBitsOfWord});
  return store_.number(half + Number(1) / Number(4'000'000)); // 2^(30 - 52) and a little more
}

} // namespace feedhold::prove
