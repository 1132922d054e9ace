// Values that are tried for the inputs of a formula: what is typed in a workshop.
#include "rules/flow/formula.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules {
namespace {

bool isWithin(const FormulaInput &input, const Rational &value) {
  return std::ranges::all_of(input.bounds, [&](const AbstractValue &bounds) {
    return bounds.mayBeNumber() && bounds.number().containsExactly(value);
  });
}

void addRange(std::vector<Decimal> &values, int first, int last, std::uint8_t scale) {
  for (int i = first; i <= last; ++i)
    values.emplace_back(i, scale);
}

/// Fewer for each of several inputs: all combinations are tried.
std::vector<Decimal> typicalValues(std::size_t inputs) {
  std::vector<Decimal> values;
  addRange(values, 1, inputs == 1 ? 60 : inputs == 2 ? 20 : 8, 0);
  addRange(values, 1, inputs == 1 ? 99 : inputs == 2 ? 69 : 9, 1);
  if (inputs < 3) {
    values.insert(values.end(), {Decimal(25, 0), Decimal(50, 0), Decimal(100, 0), Decimal(90, 0)});
    addRange(values, 1, inputs == 1 ? 99 : 12, 2);
  }
  values.emplace_back(0, 0);
  return values;
}

std::vector<RoundedNumber> valuesFor(const FormulaInput &input, std::size_t inputs) {
  std::vector<RoundedNumber> found;
  const auto addIfWithin = [&](const Decimal &value) {
    const auto number = RoundedNumber::of(value);
    if (number && isWithin(input, number->exact))
      found.push_back(*number);
  };
  const auto values = typicalValues(inputs);
  for (const Decimal &value : values)
    addIfWithin(value);
  if (inputs == 1 || found.empty())
    for (const Decimal &value : values)
      if (!value.isZero())
        addIfWithin(value.negated());
  return found;
}

/// Counts through all combinations, the first input slowest.
bool advance(std::vector<std::size_t> &chosen, const std::vector<std::vector<RoundedNumber>> &values) {
  for (std::size_t i = chosen.size(); i-- > 0;) {
    if (++chosen[i] < values[i].size())
      return true;
    chosen[i] = 0;
  }
  return false;
}

} // namespace

std::optional<FormulaSetting> findSetting(const Formulas &formulas, const std::vector<FormulaInputId> &inputs,
                                          const std::function<bool(FormulaSetting &)> &shows) {
  std::vector<FormulaInputId> free;
  std::ranges::copy_if(inputs, std::back_inserter(free),
                       [&](FormulaInputId id) { return !formulas.input(id).counter; });
  constexpr std::size_t kMostInputs = 3;
  if (free.size() > kMostInputs)
    return std::nullopt;
  std::vector<std::vector<RoundedNumber>> values;
  for (const FormulaInputId id : free) {
    values.push_back(valuesFor(formulas.input(id), free.size()));
    if (values.back().empty())
      return std::nullopt;
  }
  std::vector<std::size_t> chosen(free.size());
  do {
    FormulaSetting setting = formulas.noSetting();
    for (std::size_t i = 0; i < free.size(); ++i)
      setting[free[i].index()] = values[i][chosen[i]];
    if (shows(setting))
      return setting;
  } while (advance(chosen, values));
  return std::nullopt;
}

std::string describeSetting(const Formulas &formulas, const std::vector<FormulaInputId> &inputs,
                            const FormulaSetting &setting) {
  std::string text;
  for (const FormulaInputId id : inputs) {
    if (formulas.input(id).counter || !setting[id.index()])
      continue;
    text += text.empty() ? "with " : " and ";
    text += fmt::format("{} = {}", "`" + formulas.facts().programs.nameOfVariable(formulas.input(id).variable) + "`",
                        exactText(setting[id.index()]->exact));
  }
  return text;
}

std::string describeRounding(std::string_view expression, const RoundedNumber &value) {
  return fmt::format("{} is {} where {} is meant", expression, computedText(value.computed), exactText(value.exact));
}

} // namespace feedhold::rules
