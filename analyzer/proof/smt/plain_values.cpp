#include "proof/smt/plain_values.h"

#include "base/support/check.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace feedhold::smt {

namespace {

constexpr double kUnclear = 1e-9; // of the size of what is compared

/// Of functions that paths of the tool are made of.
std::optional<double> plainOf(Function function, const std::vector<double> &arguments) {
  switch (function) {
  case Function::Floor: return std::floor(arguments[0]);
  case Function::Sqrt: return arguments[0] >= 0 ? std::optional(std::sqrt(arguments[0])) : std::nullopt;
  case Function::Nearest:
  case Function::Near: return arguments[0];
  case Function::Sin:
  case Function::Cos:
  case Function::Tan:
  case Function::Asin:
  case Function::Acos:
  case Function::Atan2:
  case Function::Ln:
  case Function::Exp:
  case Function::Power:
  case Function::BitAnd:
  case Function::BitOr:
  case Function::BitXor: return std::nullopt;
  }
  FEEDHOLD_UNREACHABLE("a new function may have no value");
}

/// Of a comparison of two numbers; absent: they are as good as equal and not the same.
std::optional<double> compared(TermKind kind, double left, double right) {
  if (left == right)
    return kind == TermKind::Less ? 0 : 1;
  if (std::fabs(left - right) <= kUnclear * std::max({1.0, std::fabs(left), std::fabs(right)}))
    return std::nullopt;
  return kind != TermKind::Equal && left < right ? 1 : 0;
}

} // namespace

PlainValues::PlainValues(const TermStore &store, const Model &model) : store_(store) {
  for (const auto &[name, value] : model) {
    const auto *number = std::get_if<Number>(&value);
    named_.emplace(name, number ? number->toDouble() : std::get<bool>(value) ? 1 : 0);
  }
}

PlainValues::Plain PlainValues::junction(const Term &term) const {
  const bool deciding = term.kind == TermKind::Or;
  bool isComplete = true;
  for (const TermId argument : term.arguments) {
    const Plain value = known(argument);
    if (value && (*value != 0) == deciding)
      return value;
    isComplete = isComplete && value;
  }
  return isComplete ? Plain(deciding ? 0 : 1) : std::nullopt;
}

PlainValues::Plain PlainValues::ofNumbers(const Term &term) const {
  std::vector<double> values;
  for (const TermId argument : term.arguments) {
    const Plain value = known(argument);
    if (!value)
      return std::nullopt;
    values.push_back(*value);
  }
  if (term.kind == TermKind::Apply)
    return plainOf(term.function, values);
  if (term.kind == TermKind::Divide)
    return values[1] != 0 ? Plain(values[0] / values[1]) : std::nullopt;
  if (term.kind == TermKind::Add)
    return std::accumulate(values.begin(), values.end(), 0.0);
  if (term.kind == TermKind::Multiply)
    return std::accumulate(values.begin(), values.end(), 1.0, std::multiplies());
  return compared(term.kind, values[0], values[1]);
}

PlainValues::Plain PlainValues::found(const Term &term) const {
  switch (term.kind) {
  case TermKind::True: return 1;
  case TermKind::False: return 0;
  case TermKind::Number: return term.number.toDouble();
  case TermKind::Variable: {
    const auto named = named_.find(term.name);
    return named != named_.end() ? Plain(named->second) : std::nullopt;
  }
  case TermKind::And:
  case TermKind::Or: return junction(term);
  case TermKind::Not: {
    const Plain value = known(term.arguments[0]);
    return value ? Plain(1 - *value) : std::nullopt;
  }
  case TermKind::Ite: {
    const Plain condition = known(term.arguments[0]);
    return condition ? known(term.arguments[*condition != 0 ? 1 : 2]) : std::nullopt;
  }
  case TermKind::Add:
  case TermKind::Multiply:
  case TermKind::Divide:
  case TermKind::Less:
  case TermKind::LessOrEqual:
  case TermKind::Equal:
  case TermKind::Apply: return ofNumbers(term);
  }
  FEEDHOLD_UNREACHABLE("a new kind of term needs its value");
}

PlainValues::Plain PlainValues::of(TermId whole) {
  std::vector<TermId> open{whole};
  while (!open.empty()) {
    const TermId term = open.back();
    const std::size_t before = open.size();
    if (!known_.contains(term.index())) {
      for (const TermId argument : store_[term].arguments)
        if (!known_.contains(argument.index()))
          open.push_back(argument);
      if (open.size() > before)
        continue;
      known_.emplace(term.index(), found(store_[term]));
    }
    open.pop_back();
  }
  return known(whole);
}

} // namespace feedhold::smt
