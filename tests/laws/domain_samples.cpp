#include "laws/domain_samples.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace feedhold::laws {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kMostMembers = 12;

template <typename Value> void trim(std::vector<Value> &values) {
  while (values.size() > kMostMembers)
    values.erase(values.begin() + between(0, static_cast<int>(values.size())));
}

Sample constantSample() {
  const Decimal value = anyDecimal();
  Sample sample{AbstractNumber::constant(value), {value.toDouble()}, {}};
  if (const auto real = Rational::fromDecimal(value))
    sample.real.push_back(*real);
  return sample;
}

Sample intervalSample() {
  const Interval interval = anyInterval();
  Sample sample{AbstractNumber::inInterval(interval), membersOf(interval), {}};
  for (const double value : sample.computed) {
    if (const auto real = Rational::fromDouble(value))
      sample.real.push_back(*real);
  }
  return sample;
}

Sample wholeSample() {
  const int lo = between(-20, 20);
  const int hi = lo + between(0, 30);
  Sample sample{AbstractNumber::integersIn({static_cast<double>(lo), static_cast<double>(hi)}), {}, {}};
  for (int i = lo; i <= hi; i += between(1, 5)) {
    sample.computed.push_back(i);
    sample.real.push_back(Rational(i));
  }
  return sample;
}

template <typename Value, typename Function>
std::vector<Value> crossed(const std::vector<Value> &left, const std::vector<Value> &right, Function &&function) {
  std::vector<Value> results;
  for (const Value &a : left) {
    for (const Value &b : right) {
      if (const std::optional<Value> result = function(a, b))
        results.push_back(*result);
    }
  }
  trim(results);
  return results;
}

template <typename Value, typename Function>
std::vector<Value> mapped(const std::vector<Value> &values, Function &&function) {
  std::vector<Value> results;
  for (const Value &value : values) {
    if (const std::optional<Value> result = function(value))
      results.push_back(*result);
  }
  return results;
}

std::optional<double> finite(double value) { return std::isfinite(value) ? std::optional(value) : std::nullopt; }

std::optional<Rational> remainderOf(const Rational &left, const Rational &right) {
  const auto quotient = divide(left, right);
  const auto product = quotient ? multiply(right, Rational(truncate(*quotient))) : std::nullopt;
  return product ? subtract(left, *product) : std::nullopt;
}

std::optional<Rational> roundedReal(const Rational &value) {
  const auto shifted = add(value, *Rational::make(value.isNegative() ? -1 : 1, 2));
  return shifted ? std::optional(Rational(truncate(*shifted))) : std::nullopt;
}

Sample afterBinary(const Sample &left, const Sample &right) {
  using Exact = std::optional<Rational> (*)(const Rational &, const Rational &);
  switch (between(0, 5)) {
  case 0:
    return {add(left.number, right.number),
            crossed(left.computed, right.computed, [](double a, double b) { return finite(a + b); }),
            crossed(left.real, right.real, static_cast<Exact>(add))};
  case 1:
    return {subtract(left.number, right.number),
            crossed(left.computed, right.computed, [](double a, double b) { return finite(a - b); }),
            crossed(left.real, right.real, static_cast<Exact>(subtract))};
  case 2:
    return {multiply(left.number, right.number),
            crossed(left.computed, right.computed, [](double a, double b) { return finite(a * b); }),
            crossed(left.real, right.real, static_cast<Exact>(multiply))};
  case 3:
    return {divide(left.number, right.number).value_or(left.number),
            crossed(left.computed, right.computed,
                    [](double a, double b) { return b == 0 ? std::nullopt : finite(a / b); }),
            crossed(left.real, right.real, static_cast<Exact>(divide))};
  default:
    return {remainderTruncated(left.number, right.number).value_or(left.number),
            crossed(left.computed, right.computed,
                    [](double a, double b) { return b == 0 ? std::nullopt : finite(std::fmod(a, b)); }),
            crossed(left.real, right.real, remainderOf)};
  }
}

Sample afterWhole(const Sample &sample) {
  const auto up = [](const Rational &a) { return Rational(-floor(*negate(a))); };
  switch (between(0, 5)) {
  case 0:
    return {fix(sample.number), mapped(sample.computed, [](double a) { return finite(std::trunc(a)); }),
            mapped(sample.real, [](const Rational &a) { return std::optional(Rational(truncate(a))); })};
  case 1:
    return {floorOf(sample.number), mapped(sample.computed, [](double a) { return finite(std::floor(a)); }),
            mapped(sample.real, [](const Rational &a) { return std::optional(Rational(floor(a))); })};
  case 2:
    return {ceilOf(sample.number), mapped(sample.computed, [](double a) { return finite(std::ceil(a)); }),
            mapped(sample.real, [&](const Rational &a) { return std::optional(up(a)); })};
  case 3:
    return {fup(sample.number),
            mapped(sample.computed, [](double a) { return finite(a < 0 ? std::floor(a) : std::ceil(a)); }),
            mapped(sample.real,
                   [&](const Rational &a) { return std::optional(a.isNegative() ? Rational(floor(a)) : up(a)); })};
  default:
    return {round(sample.number), mapped(sample.computed, [](double a) { return finite(std::round(a)); }),
            mapped(sample.real, roundedReal)};
  }
}

Sample afterUnary(const Sample &sample) {
  switch (between(0, 4)) {
  case 0:
    return {negate(sample.number), mapped(sample.computed, [](double a) { return finite(-a); }),
            mapped(sample.real, [](const Rational &a) { return negate(a); })};
  case 1:
    return {absolute(sample.number), mapped(sample.computed, [](double a) { return finite(std::abs(a)); }),
            mapped(sample.real, [](const Rational &a) { return a.isNegative() ? negate(a) : std::optional(a); })};
  case 2:
    return {sqrt(sample.number).value_or(sample.number),
            mapped(sample.computed, [](double a) { return a < 0 ? std::nullopt : finite(std::sqrt(a)); }),
            {}};
  default: return afterWhole(sample);
  }
}

template <typename Refine, typename Keeps, typename KeepsReal>
Sample refined(const Sample &sample, Refine &&refine, Keeps &&keeps, KeepsReal &&keepsReal) {
  Sample result{sample.number, {}, {}};
  std::ranges::copy_if(sample.computed, std::back_inserter(result.computed), keeps);
  std::ranges::copy_if(sample.real, std::back_inserter(result.real), keepsReal);
  const std::optional<AbstractNumber> number = refine(sample.number);
  RC_ASSERT((number.has_value() || (result.computed.empty() && result.real.empty())));
  if (!number)
    return sample;
  result.number = *number;
  return result;
}

Sample afterComparison(const Sample &sample) {
  const double bound =
      sample.computed.empty() || between(0, 2) == 0
          ? anyDouble()
          : sample.computed[static_cast<std::size_t>(between(0, static_cast<int>(sample.computed.size())))];
  const auto exact = Rational::fromDouble(bound);
  if (!exact)
    return sample;
  const Rational limit = *exact;
  switch (between(0, 5)) {
  case 0:
    return refined(
        sample, [&](const AbstractNumber &n) { return meetAtMost(n, bound); }, [&](double v) { return v <= bound; },
        [&](const Rational &v) { return v <= limit; });
  case 1:
    return refined(
        sample, [&](const AbstractNumber &n) { return meetAtLeast(n, bound); }, [&](double v) { return v >= bound; },
        [&](const Rational &v) { return v >= limit; });
  case 2:
    return refined(
        sample, [&](const AbstractNumber &n) { return meetLess(n, bound); }, [&](double v) { return v < bound; },
        [&](const Rational &v) { return v < limit; });
  case 3:
    return refined(
        sample, [&](const AbstractNumber &n) { return meetGreater(n, bound); }, [&](double v) { return v > bound; },
        [&](const Rational &v) { return v > limit; });
  default:
    return refined(
        sample, [&](const AbstractNumber &n) { return remove(n, bound); }, [&](double v) { return v != bound; },
        [&](const Rational &v) { return v != limit; });
  }
}

} // namespace

int between(int least, int most) { return *rc::gen::resize(100, rc::gen::inRange(least, most)); }

double anyDouble() {
  switch (between(0, 12)) {
  case 0: return *rc::gen::element(1e300, -1e300, 5e-324, -1e-310, 1e17, 4503599627370497.5, 0.0);
  case 1: return std::ldexp(between(-1000000, 1000000), between(-70, 40));
  case 2:
  case 3:
  case 4: return between(-1000, 1000) / 1000.0;
  case 5:
  case 6: return between(-40000, 40000) / 1000.0;
  case 7: return between(-100, 100) / 4.0;
  default: return between(-12, 12);
  }
}

Decimal anyDecimal() {
  switch (between(0, 10)) {
  case 0: return Decimal(*rc::gen::arbitrary<std::int64_t>(), static_cast<std::uint8_t>(between(0, 25)));
  case 1:
  case 2: return Decimal(between(-2000, 2000), 3);
  case 3:
  case 4: return Decimal(25 * between(-40, 40), 2);
  case 5: return Decimal(between(-100, 100), 1);
  default: return Decimal(between(-12, 12), 0);
  }
}

Rational anyRational() {
  static constexpr int kDenominators[] = {1, 1, 1, 2, 4, 10, 1000, 3, 7};
  const auto denominator = kDenominators[between(0, 9)];
  if (between(0, 30) == 0)
    return *Rational::make(between(-1000, 1000) * (std::int64_t{1} << 50) + 1, denominator);
  return *Rational::make(between(-60, 60), denominator);
}

Interval anyInterval() {
  const double first = anyDouble();
  const double second = between(0, 3) == 0 ? first : anyDouble();
  Interval interval{std::min(first, second), std::max(first, second)};
  switch (between(0, 16)) {
  case 0: interval.lo = -kInfinity; break;
  case 1: interval.hi = kInfinity; break;
  case 2: interval = Interval::all(); break;
  default: break;
  }
  return interval;
}

std::vector<double> membersOf(const Interval &interval) {
  std::vector<double> members;
  const double lo = std::max(interval.lo, -1e6);
  const double hi = std::min(interval.hi, 1e6);
  for (const double value : {interval.lo, interval.hi, lo, hi, lo / 2 + hi / 2, std::trunc(lo / 2 + hi / 2), 0.0,
                             std::nextafter(interval.lo, kInfinity), anyDouble(), anyDouble()}) {
    if (std::isfinite(value) && interval.contains(value))
      members.push_back(value);
  }
  return members;
}

Grid anyGrid() {
  switch (between(0, 8)) {
  case 0: return Grid::any();
  case 1: return Grid::integers();
  case 2:
  case 3: return Grid::constant(anyRational());
  default: return Grid::of(anyRational(), anyRational());
  }
}

std::vector<Rational> membersOf(const Grid &grid) {
  std::vector<Rational> members;
  for (int i = 0; i < 5; ++i) {
    if (grid.isAny()) {
      members.push_back(anyRational());
      continue;
    }
    const auto shift = multiply(grid.step(), Rational(between(-20, 20)));
    const auto member = shift ? add(grid.offset(), *shift) : std::nullopt;
    if (member)
      members.push_back(*member);
  }
  return members;
}

Sample simpleSample() {
  switch (between(0, 6)) {
  case 0: return intervalSample();
  case 1: return wholeSample();
  case 2: {
    Sample sample = constantSample();
    for (int i = between(1, 10); i > 0; --i)
      sample = joined(sample, constantSample());
    return sample;
  }
  default: return constantSample();
  }
}

Sample anySample() {
  Sample sample = simpleSample();
  for (int i = between(0, 6); i > 0; --i) {
    switch (between(0, 8)) {
    case 0: sample = afterUnary(sample); break;
    case 1:
    case 2: sample = afterComparison(sample); break;
    case 3: sample = joined(sample, simpleSample()); break;
    default: sample = afterBinary(sample, simpleSample()); break;
    }
    expectSound(sample);
  }
  return sample;
}

Sample joined(const Sample &left, const Sample &right) {
  Sample both{join(left.number, right.number), left.computed, left.real};
  both.computed.insert(both.computed.end(), right.computed.begin(), right.computed.end());
  both.real.insert(both.real.end(), right.real.begin(), right.real.end());
  trim(both.computed);
  trim(both.real);
  return both;
}

void expectSound(const Sample &sample) {
  for (const double value : sample.computed)
    RC_ASSERT(sample.number.contains(value));
  for (const Rational &value : sample.real)
    RC_ASSERT(sample.number.containsExactly(value));
}

} // namespace feedhold::laws
