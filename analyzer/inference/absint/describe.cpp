#include "inference/absint/describe.h"

#include <cmath>
#include <fmt/format.h>
#include <map>

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

std::string numberText(const AbstractNumber &number) {
  if (const auto constant = number.constantValue())
    return text(*constant);
  if (!number.set().isMany()) {
    std::string all;
    for (const double value : number.set().values())
      all += (all.empty() ? "" : ", ") + text(value);
    return all;
  }
  std::string result = bounds(number.interval());
  const Grid &grid = number.grid();
  if (grid.isAny())
    return result;
  if (grid.step() == Rational(1) && grid.offset().isZero())
    return result + (result == "any number" ? " without a fraction" : ", whole");
  return result + " in steps of " + text(grid.step().toDouble());
}

std::string distance(const std::string &from, const Rational &offset) {
  if (offset.isZero())
    return "= " + from;
  const double value = offset.toDouble();
  return fmt::format("= {} {} {}", from, value < 0 ? '-' : '+', text(std::fabs(value)));
}

class StateWriter {
public:
  StateWriter(const AbstractState &state, const ModalTable &modes, const ProgramSet &programs)
      : state_(state), modes_(modes), programs_(programs) {}

  StateDescription run() {
    for (std::uint32_t local = 1; local <= kLocalVariables; ++local)
      variable(local, state_.locals[local]);
    for (const auto &[number, value] : state_.variables.entries())
      variable(number, value);
    for (const Axis axis : kAllAxes)
      position(axis);
    for (std::size_t group = 1; group < kModalGroups; ++group)
      mode(group);
    return std::move(result_);
  }

private:
  void variable(std::uint32_t number, const AbstractValue &value) {
    const std::string name = programs_.nameOfVariable(number);
    const auto &origin = value.origin();
    const bool asAtEntry = origin && *origin == Origin{symbolOfVariable(number), Rational()};
    const bool known = !(value.mayBeVacant() && value.mayBeNumber() && value.number() == AbstractNumber::any());
    if (known || (origin && !asAtEntry))
      result_.variables.push_back({name, describe(value), asAtEntry ? "as at entry" : relation(name, value)});
  }
  void position(Axis axis) {
    const AbstractValue &value = state_.at(axis);
    const auto &origin = value.origin();
    const bool asAtEntry = origin && *origin == Origin{symbolOfPosition(indexOf(axis)), Rational()};
    const std::string name(1, letterOf(axis));
    if (!asAtEntry)
      result_.positions.push_back({name, describe(value), relation(name, value)});
  }
  /// To the entry, or to the first value of the same symbol.
  std::string relation(const std::string &name, const AbstractValue &value) {
    if (!value.origin() || value.origin()->symbol == kZeroSymbol)
      return {};
    const Origin &origin = *value.origin();
    if (isEntrySymbol(origin.symbol))
      return distance(entryName(origin.symbol), origin.offset);
    const auto [first, isNew] = firstOf_.emplace(origin.symbol, std::pair{name, origin.offset});
    if (isNew)
      return {};
    const auto offset = subtract(origin.offset, first->second.second);
    return offset ? distance(first->second.first, *offset) : std::string();
  }
  std::string entryName(std::uint32_t symbol) const {
    if (symbol >= kWordSymbols)
      return fmt::format("{} at entry", kModalWords[symbol - kWordSymbols]);
    if (symbol >= kModalSymbols)
      return fmt::format("group {} at entry", symbol - kModalSymbols);
    if (symbol >= kPositionSymbols)
      return fmt::format("{} at entry", kAxisLetters[symbol - kPositionSymbols]);
    return programs_.nameOfVariable(symbol) + " at entry";
  }
  void mode(std::size_t group) {
    const CodeSet &codes = state_.codes[group];
    const auto &rows = modes_.group(group).codes;
    if (rows.empty() || codes == CodeSet::atEntry())
      return;
    std::string value;
    std::size_t count = 0;
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (codes.contains(i)) {
        ++count;
        value += (value.empty() ? "G" : ", G") + text(rows[i]->tenths / 10.0);
      }
    if (count == rows.size())
      value = "any code";
    if (codes.mayBeAtEntry())
      value += value.empty() ? "as at entry" : " or as at entry";
    result_.modes.push_back({fmt::format("group {}", group), value, {}});
  }

  const AbstractState &state_;
  const ModalTable &modes_;
  const ProgramSet &programs_;
  std::map<std::uint32_t, std::pair<std::string, Rational>> firstOf_;
  StateDescription result_;
};

} // namespace

std::string describe(const AbstractValue &value) {
  if (value.isVacant())
    return "vacant";
  const std::string number = numberText(value.number());
  return value.mayBeVacant() ? "vacant or " + number : number;
}

StateDescription describe(const AbstractState &state, const ModalTable &modes, const ProgramSet &programs) {
  return StateWriter(state, modes, programs).run();
}

} // namespace feedhold
