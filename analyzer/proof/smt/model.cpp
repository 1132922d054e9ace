#include "proof/smt/model.h"

#include "base/support/check.h"
#include "proof/smt/steps.h"

namespace feedhold::smt {
namespace {

std::optional<Value> opposite(const std::optional<Value> &value) {
  return value ? std::optional<Value>(!std::get<bool>(*value)) : std::nullopt;
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

} // namespace

/// Of And (deciding: false) and Or (deciding: true).
std::optional<Value> Evaluation::junction(const Term &term) const {
  const bool deciding = term.kind == TermKind::Or;
  bool complete = true;
  for (TermId argument : term.arguments) {
    const std::optional<Value> &value = known(argument);
    if (value && std::get<bool>(*value) == deciding)
      return deciding;
    complete = complete && value.has_value();
  }
  return complete ? std::optional<Value>(!deciding) : std::nullopt;
}

std::optional<std::vector<Number>> Evaluation::numbers(const Term &term) const {
  std::vector<Number> values;
  for (TermId argument : term.arguments) {
    const std::optional<Value> &value = known(argument);
    if (!value)
      return std::nullopt;
    values.push_back(std::get<Number>(*value));
  }
  return values;
}

std::optional<Value> Evaluation::ofVariable(const Term &term) const {
  const auto found = model_.find(term.name);
  if (found != model_.end())
    return found->second;
  if (others_ == OtherVariables::Unknown)
    return std::nullopt;
  return term.sort == Sort::Bool ? Value(false) : Value(Number());
}

std::optional<Value> Evaluation::found(const Term &term) const {
  switch (term.kind) {
  case TermKind::True: return true;
  case TermKind::False: return false;
  case TermKind::Number: return term.number;
  case TermKind::Variable: return ofVariable(term);
  case TermKind::And:
  case TermKind::Or: return junction(term);
  case TermKind::Not: return opposite(known(term.arguments[0]));
  case TermKind::Ite: {
    const std::optional<Value> &condition = known(term.arguments[0]);
    return condition ? known(term.arguments[std::get<bool>(*condition) ? 1 : 2]) : std::nullopt;
  }
  case TermKind::Add:
  case TermKind::Multiply:
  case TermKind::Divide:
  case TermKind::Less:
  case TermKind::LessOrEqual:
  case TermKind::Equal:
  case TermKind::Apply: {
    const std::optional<std::vector<Number>> values = numbers(term);
    return values ? arithmetic(term, *values) : std::nullopt;
  }
  }
  FEEDHOLD_UNREACHABLE("a new kind of term needs its value");
}

const std::optional<Value> &Evaluation::of(TermId whole) {
  constexpr std::uint64_t kStepsOfTerm = 20;
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
      spend(kStepsOfTerm);
      known_.emplace(term.index(), found(store_[term]));
    }
    open.pop_back();
  }
  return known(whole);
}

bool Evaluation::is(TermId condition, bool truth) {
  const std::optional<Value> &value = of(condition);
  return value && std::get<bool>(*value) == truth;
}

std::optional<Value> evaluate(const TermStore &store, TermId term, const Model &model) {
  return Evaluation(store, model, OtherVariables::Unknown).of(term);
}

bool isTrue(const TermStore &store, TermId condition, const Model &model) {
  return Evaluation(store, model, OtherVariables::Unknown).is(condition, true);
}

} // namespace feedhold::smt
