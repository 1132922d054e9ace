#include "inference/absint/describe.h"

#include <cmath>
#include <fmt/format.h>

namespace feedhold {

namespace {

std::string text(double value) { return fmt::format("{:.10g}", value); }

std::string bounds(const Interval &interval) {
  if (std::isinf(interval.lo) && std::isinf(interval.hi))
    return "any number";
  if (std::isinf(interval.lo))
    return "at most " + text(interval.hi);
  if (std::isinf(interval.hi))
    return "at least " + text(interval.lo);
  return interval.lo == interval.hi ? text(interval.lo) : text(interval.lo) + " to " + text(interval.hi);
}

constexpr std::size_t kFewValues = 4;

/// `0 to 8 in steps of 2` for values that are no few, and stand at equal distances; otherwise empty.
std::string stepsText(std::span<const double> values) {
  const double step = values.size() > 1 ? values[1] - values[0] : 0;
  for (std::size_t i = 1; i < values.size(); ++i)
    if (values[i] - values[i - 1] != step)
      return {};
  if (values.size() <= kFewValues)
    return {};
  const std::string range = text(values.front()) + " to " + text(values.back());
  return step == 1 && values.front() == std::floor(values.front()) ? range + ", whole"
                                                                   : range + " in steps of " + text(step);
}

std::string numberText(const AbstractNumber &number) {
  if (const auto constant = number.constantValue())
    return text(*constant);
  if (!number.set().isMany()) {
    const auto values = number.set().values();
    if (std::string steps = stepsText(values); !steps.empty())
      return steps;
    std::string all;
    for (std::size_t i = 0; i < values.size(); ++i)
      all += (i == 0 ? "" : i + 1 == values.size() ? " or " : ", ") + text(values[i]);
    return all;
  }
  std::string result = bounds(number.interval());
  const Grid &grid = number.grid();
  if (grid.isAny())
    return result;
  if (grid.step() == Rational(1) && grid.offset().isZero())
    return result + (result == "any number" ? " without a fraction" : ", whole");
  if (std::isinf(number.interval().lo) && std::isinf(number.interval().hi) && !grid.offset().isZero())
    return result + " in steps of " + text(grid.step().toDouble()) + " from " + text(grid.offset().toDouble());
  return result + " in steps of " + text(grid.step().toDouble());
}

} // namespace

std::string describe(const AbstractValue &value) {
  if (value.isVacant())
    return "vacant";
  const std::string number = numberText(value.number());
  return value.mayBeVacant() ? "vacant or " + number : number;
}

} // namespace feedhold
