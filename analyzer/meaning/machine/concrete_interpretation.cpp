#include "meaning/machine/concrete_interpretation.h"

#include "base/support/mantissa32.h"
#include "meaning/semantics/parts.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace feedhold {

namespace {

constexpr double kLargestInteger = 9.0e15; // beyond it doubles have no fraction, and fewer than all integers

// The order of operations and the places where they are rounded to double are those of LinuxCNC's interpreter, so that
// both agree to the last bit; elsewhere the last bits are the control's own.
constexpr long double kPi = std::numbers::pi_v<long double>;
long double radians(double angle) { return static_cast<long double>(angle) * kPi / 180; }
double degrees(double angle) { return static_cast<double>(static_cast<long double>(angle * 180.0) / kPi); }

/// Exact at the multiples of 90 degrees, where a program compares with 0 and 1.
double sineOfDegrees(double angle) {
  const double quarter = angle / 90;
  if (std::floor(quarter) == quarter && std::fabs(quarter) < kLargestInteger) {
    constexpr std::array kSines = {0.0, 1.0, 0.0, -1.0};
    const double rest = quarter - 4 * std::floor(quarter / 4);
    return kSines[static_cast<std::size_t>(rest)];
  }
  return static_cast<double>(std::sin(radians(angle)));
}

double cosineOfDegrees(double angle) {
  const double quarter = angle / 90;
  if (std::floor(quarter) == quarter && std::fabs(quarter) < kLargestInteger)
    return sineOfDegrees(angle + 90);
  return static_cast<double>(std::cos(radians(angle)));
}

/// BCD: each group of four bits is a decimal digit.
double binaryOfBcd(double value) {
  auto digits = static_cast<std::uint64_t>(std::fabs(value));
  double result = 0;
  for (double weight = 1; digits != 0; digits >>= 4, weight *= 10)
    result += weight * static_cast<double>(digits & 15U);
  return result;
}

double bcdOfBinary(double value) {
  auto rest = static_cast<std::uint64_t>(std::fabs(value));
  double result = 0;
  for (double weight = 1; rest != 0; rest /= 10, weight *= 16)
    result += weight * static_cast<double>(rest % 10);
  return result;
}

double valueOf(FunctionKind kind, double x) {
  switch (kind) {
  case FunctionKind::Sin: return sineOfDegrees(x);
  case FunctionKind::Cos: return cosineOfDegrees(x);
  case FunctionKind::Tan: return static_cast<double>(std::tan(radians(x)));
  case FunctionKind::Asin: return degrees(std::asin(std::clamp(x, -1.0, 1.0)));
  case FunctionKind::Acos: return degrees(std::acos(std::clamp(x, -1.0, 1.0)));
  case FunctionKind::Sqrt: return x < 0 ? 0 : std::sqrt(x);
  case FunctionKind::Abs: return std::fabs(x);
  case FunctionKind::Ln: return x <= 0 ? 0 : std::log(x);
  case FunctionKind::Exp: return std::exp(x);
  case FunctionKind::Bin: return binaryOfBcd(x);
  case FunctionKind::Bcd: return bcdOfBinary(x);
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
  return 0;
}

} // namespace

std::optional<double> ConcreteInterpretation::constantOf(const Value &value) const {
  if (value.vacant || !std::isfinite(value.number))
    return std::nullopt;
  return value.number;
}

ConcreteValue ConcreteInterpretation::remainder(const Value &a, const Value &b) const {
  return Value::of(b.number == 0 ? 0 : std::fmod(a.number, b.number));
}
ConcreteValue ConcreteInterpretation::fix(const Value &a) const { return Value::of(std::trunc(a.number)); }
ConcreteValue ConcreteInterpretation::fup(const Value &a) const {
  return Value::of(a.number < 0 ? std::floor(a.number) : std::ceil(a.number));
}
ConcreteValue ConcreteInterpretation::floor(const Value &a) const { return Value::of(std::floor(a.number)); }
ConcreteValue ConcreteInterpretation::ceiling(const Value &a) const { return Value::of(std::ceil(a.number)); }

ConcreteValue ConcreteInterpretation::roundTo(const Value &value, Decimal step) const {
  if (rounding_ == WordRounding::None && step.scale() != 0) // whole numbers are asked for by name
    return asNumber(value);
  const double size = std::pow(10.0, step.scale()) / static_cast<double>(step.mantissa());
  const double steps = value.number * size;
  if (!(std::fabs(steps) < kLargestInteger))
    return asNumber(value);
  return Value::of(std::round(steps) / size);
}

ConcreteValue ConcreteInterpretation::function(FunctionKind kind, const Value &argument) const {
  return Value::of(valueOf(kind, argument.number));
}
ConcreteValue ConcreteInterpretation::atan2(const Value &y, const Value &x) const {
  return Value::of(degrees(std::atan2(y.number + 0.0, x.number + 0.0))); // no control has a -0
}
ConcreteValue ConcreteInterpretation::power(const Value &base, const Value &exponent) const {
  const double result = std::pow(base.number, exponent.number);
  return Value::of(std::isnan(result) ? 0 : result);
}
ConcreteValue ConcreteInterpretation::bitwise(OperatorKind op, const Value &a, const Value &b) const {
  if (std::fabs(a.number) > kLargestInteger || std::fabs(b.number) > kLargestInteger)
    return Value::of(0);
  const auto left = static_cast<std::int64_t>(a.number);
  const auto right = static_cast<std::int64_t>(b.number);
  if (op == OperatorKind::And)
    return Value::of(static_cast<double>(left & right));
  return Value::of(static_cast<double>(op == OperatorKind::Or ? left | right : left ^ right));
}

bool ConcreteInterpretation::compare(Relation relation, const Value &a, const Value &b) const {
  switch (relation) {
  case Relation::Equal: return a.number == b.number;
  case Relation::NotEqual: return a.number != b.number;
  case Relation::Greater: return a.number > b.number;
  case Relation::GreaterOrEqual: return a.number >= b.number;
  case Relation::Less: return a.number < b.number;
  case Relation::LessOrEqual: return a.number <= b.number;
  }
  return false;
}

ConcreteValue ConcreteInterpretation::numberOfCode(ModalCode code, const ModalTable &modes, std::uint8_t group) {
  const auto &codes = modes.group(group).codes;
  if (code >= codes.size() && !codes.empty()) // one of them is always in force
    notes_.push_back("the G code in force of a modal group of which none was programmed");
  return Value::of(code < codes.size() ? codes[code]->tenths / 10.0 : 0);
}

ConcreteValue ConcreteInterpretation::given(std::uint32_t variable) const {
  if (const Value *value = given_.find(variable))
    return *value;
  if (variable >= kFirstNamedVariable)
    return {};
  const VariableRange *range = findVariable(*dialect_, variable);
  return range && range->kind == VariableKind::System ? Value::of(0) : Value{};
}

GivenVariables ConcreteInterpretation::byCell(const Dialect &dialect, const GivenVariables &given,
                                              NumberModel numbers) {
  const auto held = [&](double number) {
    return numbers == NumberModel::Mantissa32 ? mantissa32::nearest(number) : number;
  };
  GivenVariables cells;
  cells.start.settings = given.start.settings;
  for (const auto &[variable, value] : given.entries())
    cells.set(cellOf(dialect, variable), {value.vacant, held(value.number)});
  for (const auto &[variable, script] : given.readings.entries()) {
    std::vector<double> readings = script;
    std::ranges::transform(readings, readings.begin(), held);
    cells.readings.set(cellOf(dialect, variable), std::move(readings));
  }
  return cells;
}

bool ConcreteInterpretation::isLocal(std::uint32_t variable) const {
  const VariableRange *range = variable <= kLocalVariables ? findVariable(*dialect_, variable) : nullptr;
  return range && range->kind == VariableKind::Local;
}

ConcreteValue ConcreteInterpretation::volatileRead(std::uint32_t variable) {
  sawVolatile_ = true;
  if (source_)
    return Value::of(source_(variable));
  const std::vector<double> *script = given_.readings.find(variable);
  if (!script)
    return asNumber(given(variable));
  const std::size_t *before = reads_.find(variable);
  const std::size_t taken = before ? *before : 0;
  reads_.set(variable, taken + 1);
  return Value::of((*script)[std::min(taken, script->size() - 1)]);
}

/// Without readings no signal comes.
void ConcreteInterpretation::beginSkip() {
  ++skips_;
  skipShare_ = given_.readings.find(kSkipShare) ? volatileRead(kSkipShare).number : 1;
}

ConcreteValue ConcreteInterpretation::notFollowed(std::uint32_t variable) {
  if (isPredefinedName(variable) && isReadFromOutside(variable))
    return volatileRead(variable);
  if (const Value *value = given_.find(variable))
    return asNumber(*value);
  notes_.push_back("a value of the control that is not followed");
  passedUnmodelled_ = passedUnmodelled_ || !stopped_;
  return Value::of(0);
}

void ConcreteInterpretation::holdInMantissa32(Value &result, Span place) {
  if (result.vacant)
    return;
  result.number = mantissa32::nearest(result.number);
  alarm(!mantissa32::isInRange(result.number), {AlarmKind::Overflow, place});
}

void ConcreteInterpretation::alarm(bool truth, AlarmReport report) {
  if (truth && (report.kind == AlarmKind::ArcRadius || report.kind == AlarmKind::ArcTooShort ||
                report.kind == AlarmKind::ArcWithoutLength))
    for (const Axis axis : {Axis::X, Axis::Y, Axis::Z})
      readPosition(axis);
  if (truth && stopped_.kind == Stop::None)
    stopped_ = {Stop::ControlAlarm, report.kind, 0, report.place};
}

void ConcreteInterpretation::userAlarm(const Value &number, Span place) {
  if (stopped_.kind == Stop::None)
    stopped_ = {Stop::UserAlarm, {}, number.number, place};
}

void ConcreteInterpretation::move(const Move<Value> &move) {
  if (stopped_.kind == Stop::None)
    moves_.push_back(move);
}

MachineState<ConcreteInterpretation> startState(const ConcreteInterpretation &interpretation, const ModalTable &modes,
                                                const std::array<double, kAxisCount> &start) {
  const auto asAfterPowerOn = Overloaded{[&](PartId id, ConcreteValue &value) {
                                           setNeutral(interpretation, id, value);
                                           if (id.part == Part::Position)
                                             value = ConcreteValue::of(start[id.key]);
                                         },
                                         [&](PartId id, std::uint8_t &code) {
                                           code = id.part == Part::Spindle
                                                      ? std::uint8_t{0}
                                                      : modes.powerOn(id.key).value_or(ConcreteInterpretation::kNoCode);
                                         },
                                         [&](PartId id, bool &truth) { setNeutral(interpretation, id, truth); }};
  auto state = entryParts<ConcreteInterpretation>(interpretation, asAfterPowerOn, asAfterPowerOn);
  for (const auto &[variable, value] : interpretation.allGiven())
    if (interpretation.isLocal(variable))
      state.locals[variable] = value;
    else
      state.variables.set(variable, value);
  return state;
}

bool ConcreteInterpretation::setting(SwitchId id) const {
  const auto said = std::ranges::find(given_.start.settings, id, [](const auto &each) { return each.first; });
  return said == given_.start.settings.end() ? switchNames()[id].usual : said->second;
}

void putInForce(const GivenStart &start, MachineState<ConcreteInterpretation> &state) {
  for (const auto &[group, code] : start.codes)
    state.codes[group] = code;
  for (const auto &[letter, number] : start.words)
    state.word(letter) = ConcreteValue::of(number);
  for (const auto &[axis, coordinate] : start.place)
    state.at(axis) = ConcreteValue::of(coordinate);
}

} // namespace feedhold
