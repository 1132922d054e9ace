#include "proof/smt/model.h"

#include "base/support/check.h"

namespace feedhold::smt {
namespace {

using Known = std::map<TermId, std::optional<Value>>;

std::optional<Value> opposite(const std::optional<Value> &value) {
  return value ? std::optional<Value>(!std::get<bool>(*value)) : std::nullopt;
}

/// Of And (deciding: false) and Or (deciding: true).
std::optional<Value> junction(const Term &term, const Known &known) {
  const bool deciding = term.kind == TermKind::Or;
  bool complete = true;
  for (TermId argument : term.arguments) {
    const std::optional<Value> &value = known.at(argument);
    if (value && std::get<bool>(*value) == deciding)
      return deciding;
    complete = complete && value.has_value();
  }
  return complete ? std::optional<Value>(!deciding) : std::nullopt;
}

std::optional<std::vector<Number>> numbers(const Term &term, const Known &known) {
  std::vector<Number> values;
  for (TermId argument : term.arguments) {
    const std::optional<Value> &value = known.at(argument);
    if (!value)
      return std::nullopt;
    values.push_back(std::get<Number>(*value));
  }
  return values;
}

std::optional<Value> ofFunction(Function function, const std::vector<Number> &arguments) {
  TermStore scratch;
  std::vector<TermId> constants;
  for (const Number &argument : arguments)
    constants.push_back(scratch.number(argument));
  const Term &result = scratch[scratch.apply(function, constants)];
  return result.kind == TermKind::Number ? std::optional<Value>(result.number) : std::nullopt;
}

std::optional<Value> arithmetic(const Term &term, const std::vector<Number> &values) {
  switch (term.kind) {
  case TermKind::Add:
  case TermKind::Multiply: {
    Number result = values[0];
    for (std::size_t i = 1; i < values.size(); ++i)
      term.kind == TermKind::Add ? result += values[i] : result *= values[i];
    return result;
  }
  case TermKind::Divide: return values[1].isZero() ? std::nullopt : std::optional<Value>(values[0] / values[1]);
  case TermKind::Less: return values[0] < values[1];
  case TermKind::LessOrEqual: return values[0] <= values[1];
  case TermKind::Equal: return values[0] == values[1];
  case TermKind::Apply: return ofFunction(term.function, values);
  case TermKind::True:
  case TermKind::False:
  case TermKind::Number:
  case TermKind::Variable:
  case TermKind::And:
  case TermKind::Or:
  case TermKind::Not:
  case TermKind::Ite: break;
  }
  FEEDHOLD_UNREACHABLE("no arithmetic");
}

std::optional<Value> valueOf(const Term &term, const Known &known, const Model &model) {
  switch (term.kind) {
  case TermKind::True: return true;
  case TermKind::False: return false;
  case TermKind::Number: return term.number;
  case TermKind::Variable: {
    auto found = model.find(term.name);
    return found == model.end() ? std::nullopt : std::optional(found->second);
  }
  case TermKind::And:
  case TermKind::Or: return junction(term, known);
  case TermKind::Not: return opposite(known.at(term.arguments[0]));
  case TermKind::Ite: {
    const std::optional<Value> &condition = known.at(term.arguments[0]);
    return condition ? known.at(term.arguments[std::get<bool>(*condition) ? 1 : 2]) : std::nullopt;
  }
  case TermKind::Add:
  case TermKind::Multiply:
  case TermKind::Divide:
  case TermKind::Less:
  case TermKind::LessOrEqual:
  case TermKind::Equal:
  case TermKind::Apply: {
    std::optional<std::vector<Number>> values = numbers(term, known);
    return values ? arithmetic(term, *values) : std::nullopt;
  }
  }
  FEEDHOLD_UNREACHABLE("a new kind of term needs its value");
}

} // namespace

std::optional<Value> evaluate(const TermStore &store, TermId term, const Model &model) {
  Known known;
  for (TermId id : reachable(store, std::span(&term, 1)))
    known.emplace(id, valueOf(store[id], known, model));
  return known.at(term);
}

bool isTrue(const TermStore &store, TermId condition, const Model &model) {
  const std::optional<Value> value = evaluate(store, condition, model);
  return value && std::get<bool>(*value);
}

} // namespace feedhold::smt
