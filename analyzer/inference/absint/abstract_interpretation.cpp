#include "inference/absint/abstract_interpretation.h"

#include "inference/absint/abstract_state.h"
#include "inference/absint/comparison_error.h"

#include <bit>
#include <cmath>

namespace feedhold {

namespace {

// Inside the class the name is another function's.
CodeSet joined(const CodeSet &a, const CodeSet &b) { return join(a, b); }

const AbstractNumber kNoNumber = AbstractNumber::constant(0.0);

/// The number that a value is; semantics asks only where it is one (a vacant one counts as 0).
const AbstractNumber &numberOf(const AbstractValue &value) { return value.mayBeNumber() ? value.number() : kNoNumber; }

AbstractValue valueOf(const AbstractNumber &number) {
  const AbstractValue value = AbstractValue::number(number);
  if (number.grid().isConstant())
    return value.withOrigin(Origin{kZeroSymbol, number.grid().offset()});
  return value;
}
/// Where no case is left the alarm before it has said so.
AbstractNumber orNone(const std::optional<AbstractNumber> &number) { return number.value_or(kNoNumber); }

/// The origin of a value moved by a constant distance.
std::optional<Origin> moved(const AbstractValue &value, const Grid &distance,
                            std::optional<Rational> (*move)(const Rational &, const Rational &)) {
  if (!value.origin() || !distance.isConstant() || !value.isNumber())
    return std::nullopt;
  const std::optional<Rational> offset = move(value.origin()->offset, distance.offset());
  return offset ? std::optional(Origin{value.origin()->symbol, *offset}) : std::nullopt;
}

std::optional<AbstractNumber> functionOf(FunctionKind kind, const AbstractNumber &x) {
  switch (kind) {
  case FunctionKind::Sin: return sin(x);
  case FunctionKind::Cos: return cos(x);
  case FunctionKind::Tan: return tan(x);
  case FunctionKind::Asin: return asin(x);
  case FunctionKind::Acos: return acos(x);
  case FunctionKind::Sqrt: return sqrt(x);
  case FunctionKind::Abs: return absolute(x);
  case FunctionKind::Ln: return ln(x);
  case FunctionKind::Exp: return exp(x);
  case FunctionKind::Bin:
  case FunctionKind::Bcd: return AbstractNumber::integersIn({0, INFINITY});
  case FunctionKind::Atan: // the others are not functions of one number; the semantics has its own words for them
  case FunctionKind::Round:
  case FunctionKind::Fix:
  case FunctionKind::Fup:
  case FunctionKind::Pow:
  case FunctionKind::Adp:
  case FunctionKind::Prm:
  case FunctionKind::Ax:
  case FunctionKind::AxNumber:
  case FunctionKind::Exists: break;
  }
  return AbstractNumber::any();
}

/// In the order in which the machine computes: how many steps there are in 1 is whole, a step seldom a double.
AbstractNumber roundedToStep(const AbstractNumber &number, Decimal step) {
  const auto perUnit = feedhold::divide(AbstractNumber::constant(std::pow(10.0, step.scale())),
                                        AbstractNumber::constant(static_cast<double>(step.mantissa())));
  const auto rounded =
      perUnit ? feedhold::divide(feedhold::round(feedhold::multiply(number, *perUnit)), *perUnit) : std::nullopt;
  return rounded.value_or(number);
}

/// Copies and distances: two values of one symbol whose offsets differ are apart by that much.  The values in exact
/// numbers and in doubles may drift apart by roundings, so a distance below this share of the values decides nothing.
constexpr double kDrift = 1e-9;

std::optional<double> distanceOf(const AbstractValue &a, const AbstractValue &b) {
  if (!a.origin() || !b.origin() || a.origin()->symbol != b.origin()->symbol || !a.isNumber() || !b.isNumber())
    return std::nullopt;
  const std::optional<Rational> distance = subtract(a.origin()->offset, b.origin()->offset);
  if (!distance)
    return std::nullopt;
  const double apart = distance->toDouble();
  const Interval &range = a.number().interval();
  const double size = std::max({std::fabs(range.lo), std::fabs(range.hi), std::fabs(apart)});
  return std::isfinite(size) && std::fabs(apart) > kDrift * size ? std::optional(apart) : std::nullopt;
}

} // namespace

AbstractValue AbstractInterpretation::withSymbol(Value value) {
  return value.origin() ? value : value.withOrigin(Origin{freshSymbol(), Rational()});
}

// ---- values --------------------------------------------------------------------------------------------------------

AbstractValue AbstractInterpretation::literal(Decimal value) const {
  return memo_.constant(static_cast<std::uint64_t>(value.mantissa()), value.scale(),
                        [&] { return valueOf(AbstractNumber::constant(value)); });
}
AbstractValue AbstractInterpretation::number(double value) const {
  constexpr std::uint8_t kDouble = 0xff; // no scale of a decimal
  return memo_.constant(std::bit_cast<std::uint64_t>(value), kDouble,
                        [&] { return valueOf(AbstractNumber::constant(value)); });
}

AbstractValue AbstractInterpretation::asNumber(const Value &value) const {
  if (value.isNumber())
    return value;
  if (value.isVacant())
    return number(0);
  return valueOf(
      memo_.of(NumberOperation::OrZero, value.number(), {}, [&] { return feedhold::join(value.number(), kNoNumber); }));
}

std::optional<double> AbstractInterpretation::constantOf(const Value &value) const {
  return value.isNumber() ? value.number().constantValue() : std::nullopt;
}

AbstractValue AbstractInterpretation::select(Truth truth, const Value &first, const Value &second) const {
  if (truth == Truth::True)
    return first;
  return truth == Truth::False ? second : feedhold::join(first, second);
}
AbstractValue AbstractInterpretation::either(const Value &first, const Value &second) const {
  return feedhold::join(first, second);
}

// ---- arithmetic ----------------------------------------------------------------------------------------------------

AbstractValue AbstractInterpretation::add(const Value &a, const Value &b) const {
  const AbstractNumber &left = numberOf(a);
  const AbstractNumber &right = numberOf(b);
  const AbstractValue sum =
      valueOf(memo_.of(NumberOperation::Add, left, right, [&] { return feedhold::add(left, right); }));
  if (sum.origin())
    return sum;
  if (const auto origin = moved(a, right.grid(), feedhold::add))
    return sum.withOrigin(origin);
  return sum.withOrigin(moved(b, left.grid(), feedhold::add));
}
AbstractValue AbstractInterpretation::subtract(const Value &a, const Value &b) const {
  if (a.origin() && a.origin() == b.origin() && a.isNumber() && b.isNumber())
    return number(0);
  const AbstractValue difference = valueOf(memo_.of(NumberOperation::Subtract, numberOf(a), numberOf(b),
                                                    [&] { return feedhold::subtract(numberOf(a), numberOf(b)); }));
  return difference.origin() ? difference : difference.withOrigin(moved(a, numberOf(b).grid(), feedhold::subtract));
}
AbstractValue AbstractInterpretation::multiply(const Value &a, const Value &b) const {
  return valueOf(memo_.of(NumberOperation::Multiply, numberOf(a), numberOf(b),
                          [&] { return feedhold::multiply(numberOf(a), numberOf(b)); }));
}
AbstractValue AbstractInterpretation::divide(const Value &a, const Value &b) const {
  return valueOf(memo_.of(NumberOperation::Divide, numberOf(a), numberOf(b),
                          [&] { return orNone(feedhold::divide(numberOf(a), numberOf(b))); }));
}
AbstractValue AbstractInterpretation::remainder(const Value &a, const Value &b) const {
  return valueOf(memo_.of(NumberOperation::Remainder, numberOf(a), numberOf(b),
                          [&] { return orNone(remainderTruncated(numberOf(a), numberOf(b))); }));
}
AbstractValue AbstractInterpretation::ofOne(NumberOperation operation, const Value &a,
                                            AbstractNumber (*compute)(const AbstractNumber &)) const {
  return valueOf(memo_.of(operation, numberOf(a), {}, [&] { return compute(numberOf(a)); }));
}
AbstractValue AbstractInterpretation::negate(const Value &a) const {
  return ofOne(NumberOperation::Negate, a, feedhold::negate);
}
AbstractValue AbstractInterpretation::fix(const Value &a) const {
  return ofOne(NumberOperation::Fix, a, feedhold::fix);
}
AbstractValue AbstractInterpretation::fup(const Value &a) const {
  return ofOne(NumberOperation::Fup, a, feedhold::fup);
}
AbstractValue AbstractInterpretation::floor(const Value &a) const { return ofOne(NumberOperation::Floor, a, floorOf); }
AbstractValue AbstractInterpretation::ceiling(const Value &a) const {
  return ofOne(NumberOperation::Ceiling, a, ceilOf);
}

AbstractValue AbstractInterpretation::roundTo(const Value &value, Decimal step) const {
  const AbstractNumber &number = numberOf(value);
  const std::optional<Rational> size = Rational::fromDecimal(step);
  if (!size)
    return valueOf(number);
  if (number.isExact() && leq(number.grid(), Grid::of(*size, Rational())) && value.isNumber())
    return value; // a multiple of the step already
  if (step.scale() == 0 && step.mantissa() == 1)
    return ofOne(NumberOperation::Round, value, feedhold::round);
  return valueOf(
      memo_.of(NumberOperation::RoundTo, number, literal(step).number(), [&] { return roundedToStep(number, step); }));
}

AbstractValue AbstractInterpretation::function(FunctionKind kind, const Value &argument) const {
  const auto operation =
      static_cast<NumberOperation>(static_cast<unsigned>(NumberOperation::FirstFunction) + static_cast<unsigned>(kind));
  return valueOf(
      memo_.of(operation, numberOf(argument), {}, [&] { return orNone(functionOf(kind, numberOf(argument))); }));
}
AbstractValue AbstractInterpretation::atan2(const Value &y, const Value &x) const {
  return valueOf(memo_.of(NumberOperation::Atan2, numberOf(y), numberOf(x),
                          [&] { return atan2Degrees(numberOf(y), numberOf(x)); }));
}
AbstractValue AbstractInterpretation::power(const Value &base, const Value &exponent) const {
  return valueOf(memo_.of(NumberOperation::Power, numberOf(base), numberOf(exponent),
                          [&] { return orNone(pow(numberOf(base), numberOf(exponent))); }));
}

/// AND of non-negative numbers is at most either of them, OR and XOR are below the next power of two.
AbstractValue AbstractInterpretation::bitwise(OperatorKind op, const Value &a, const Value &b) const {
  const Interval left = numberOf(a).interval();
  const Interval right = numberOf(b).interval();
  if (left.lo < 0 || right.lo < 0)
    return valueOf(AbstractNumber::integersIn({-INFINITY, INFINITY}));
  if (op == OperatorKind::And)
    return valueOf(AbstractNumber::integersIn({0, std::min(left.hi, right.hi)}));
  const double most = std::max(left.hi, right.hi);
  return valueOf(AbstractNumber::integersIn(
      {0, std::isfinite(most) ? std::exp2(std::ceil(std::log2(most + 1) + 1e-9)) : INFINITY}));
}

AbstractValue AbstractInterpretation::between(const Value &start, const Value &end) const {
  const Interval from = numberOf(start).interval();
  const Interval to = numberOf(end).interval();
  return valueOf(AbstractNumber::inInterval({std::min(from.lo, to.lo), std::max(from.hi, to.hi)}));
}

Truth AbstractInterpretation::compare(Relation relation, const Value &a, const Value &b) const {
  if (const auto apart = distanceOf(a, b)) {
    const bool above = *apart > 0;
    switch (relation) {
    case Relation::Equal: return Truth::False;
    case Relation::NotEqual: return Truth::True;
    case Relation::Greater:
    case Relation::GreaterOrEqual: return truthOf(above);
    case Relation::Less:
    case Relation::LessOrEqual: return truthOf(!above);
    }
  }
  const bool isRounded = mayHaveMantissa32_ && !isSameDecimal(numberOf(a), numberOf(b));
  const AbstractNumber left = isRounded ? inEveryModel(numberOf(a)) : numberOf(a);
  const AbstractNumber right = isRounded ? loosenedFor(left, numberOf(b)) : numberOf(b);
  switch (relation) {
  case Relation::Equal: return isEqual(left, right);
  case Relation::NotEqual: return feedhold::negate(isEqual(left, right));
  case Relation::Greater: return isLess(right, left);
  case Relation::GreaterOrEqual: return isAtMost(right, left);
  case Relation::Less: return isLess(left, right);
  case Relation::LessOrEqual: return isAtMost(left, right);
  }
  return Truth::Maybe;
}

// ---- modal codes ---------------------------------------------------------------------------------------------------

CodeSet AbstractInterpretation::unknownCode() const {
  static const CodeSet kAny = [] {
    CodeSet any = CodeSet::atEntry();
    for (std::size_t i = 0; i < CodeSet::kMostCodes; ++i)
      any = joined(any, CodeSet::of(i));
    return any;
  }();
  return kAny;
}

Truth AbstractInterpretation::isOneOf(ModalCode code, CodeMask mask) const {
  if (code.mayBeAtEntry())
    return mask == 0 ? Truth::False : Truth::Maybe;
  return truthOfOutcomes((code.codes() & mask) != 0, (code.codes() & ~mask) != 0);
}

std::optional<std::uint8_t> AbstractInterpretation::onlyCode(ModalCode code) const { return code.only(); }

CodeSet AbstractInterpretation::selectCode(Truth truth, ModalCode first, ModalCode second) const {
  if (truth == Truth::True)
    return first;
  return truth == Truth::False ? second : joined(first, second);
}

AbstractValue AbstractInterpretation::numberOfCode(ModalCode code, const ModalTable &modes, std::uint8_t group) const {
  std::optional<AbstractNumber> number;
  const auto &codes = modes.group(group).codes;
  for (std::size_t i = 0; i < codes.size(); ++i)
    if (code.mayBe(i)) {
      const AbstractNumber one = AbstractNumber::constant(Decimal(codes[i]->tenths, 1));
      number = number ? feedhold::join(*number, one) : one;
    }
  const AbstractValue value = valueOf(number.value_or(AbstractNumber::any()));
  const bool atEntry = code == CodeSet::atEntry() && !codes.empty();
  return atEntry ? value.withOrigin(Origin{kModalSymbols + group, Rational()}) : value;
}

std::optional<std::pair<std::uint8_t, CodeSet>> AbstractInterpretation::codeFrom(const Value &value,
                                                                                 const ModalTable &modes) const {
  const auto &origin = value.origin();
  if (origin && origin->offset.isZero() && value.isNumber() && origin->symbol >= kModalSymbols &&
      origin->symbol < kModalSymbols + kModalGroups)
    return std::pair{static_cast<std::uint8_t>(origin->symbol - kModalSymbols), CodeSet::atEntry()};
  std::optional<std::pair<std::uint8_t, CodeSet>> found;
  for (const double number : numberOf(value).set().values()) {
    const Code *code = number < 0 || number > 6000
                           ? nullptr
                           : findGCode(*dialect_, static_cast<std::uint16_t>(std::lround(number * 10)));
    const auto index = code ? modes.indexOf(*code) : std::nullopt;
    if (!index || (found && found->first != code->group))
      return std::nullopt;
    const CodeSet one = CodeSet::of(*index);
    found = std::pair{code->group, found ? joined(found->second, one) : one};
  }
  return value.mayBeVacant() ? std::nullopt : found;
}

std::optional<AbstractValue> AbstractInterpretation::recalled(const ProgramFile &file, const State &state,
                                                              ExpressionId expression) {
  if (observer_) // it is told of all that is evaluated
    return std::nullopt;
  const auto evaluation = evaluations_.recall(*file.tree, *file.dialect, expression, [&](std::uint32_t variable) {
    if (variable <= kLocalVariables)
      return state.locals[variable];
    const AbstractValue *written = state.variables.find(variable);
    return written ? *written : unwritten(state, variable);
  });
  if (!evaluation)
    return std::nullopt;
  mayHaveDividedByZero_ = mayHaveDividedByZero_ || evaluation->mayHaveDividedByZero;
  return evaluation->value;
}

void AbstractInterpretation::remember(const ProgramFile &file, ExpressionId expression, const Value &value) {
  if (!observer_ && !stopped_)
    evaluations_.remember(*file.tree, expression, {value, mayHaveDividedByZero_});
}

// ---- what happens --------------------------------------------------------------------------------------------------

namespace {

/// The text alone tells of it, at the word.
bool isMistakeOfWord(AlarmKind kind) {
  return kind == AlarmKind::ReadProtected || kind == AlarmKind::WriteProtected ||
         kind == AlarmKind::VariableNotAvailable || kind == AlarmKind::NoDataAfterAddress;
}

} // namespace

void AbstractInterpretation::alarm(Truth truth, const AlarmReport &report) {
  if (!mayBeTrue(truth) || stopped_)
    return;
  if (observer_)
    observer_->alarm(truth, report);
  stopped_ = truth == Truth::True && !isMistakeOfWord(report.kind);
  mayHaveDividedByZero_ = mayHaveDividedByZero_ || report.kind == AlarmKind::DivideByZero;
}

void AbstractInterpretation::userAlarm(const Value &number, Span place) {
  if (observer_ && !stopped_)
    observer_->userAlarm(number, place);
  stopped_ = true;
}

void AbstractInterpretation::move(const Move<Value> &move) {
  if (observer_ && !stopped_)
    observer_->move(move.kind);
}

void AbstractInterpretation::unmodelled(std::string_view reason, Span place) {
  if (observer_ && !stopped_)
    observer_->unmodelled(reason, place);
}

} // namespace feedhold
