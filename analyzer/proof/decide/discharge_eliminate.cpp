#include "proof/decide/discharge_eliminate.h"

#include <algorithm>
#include <optional>

namespace feedhold::prove {
namespace {

using smt::LinearSum;
using smt::Number;
using smt::Sort;
using smt::TermId;
using smt::TermKind;

using Definition = std::pair<TermId, TermId>;

/// An integer may only stand for what is an integer.
bool mayDefine(const smt::TermStore &store, TermId variable, TermId value) {
  return store.sort(variable) == Sort::Real || store.sort(value) == Sort::Int;
}

/// x = floor(x): x is an integer, and may as well be a variable of that sort.
std::optional<Definition> integerIn(smt::TermStore &store, const LinearSum &sum) {
  if (sum.terms.size() != 2 || !sum.constant.isZero() || !(sum.terms[0].second + sum.terms[1].second).isZero())
    return std::nullopt;
  for (const std::size_t at : {0U, 1U}) {
    const TermId variable = sum.terms[at].first;
    const smt::Term &other = store[sum.terms[1 - at].first];
    if (store[variable].kind == TermKind::Variable && other.kind == TermKind::Apply &&
        other.function == smt::Function::Floor && other.arguments.front() == variable) {
      const std::string name = store[variable].name + " whole";
      return Definition{variable, store.variable(name, Sort::Int)};
    }
  }
  return std::nullopt;
}

/// x = value from an equality in which x stands alone once.
std::optional<Definition> definitionIn(smt::TermStore &store, TermId formula) {
  if (store[formula].kind != TermKind::Equal)
    return std::nullopt;
  LinearSum sum = store.linear(store[formula].arguments[0]);
  sum.constant -= store[store[formula].arguments[1]].number;
  if (auto integer = integerIn(store, sum))
    return integer;
  for (std::size_t at = 0; at < sum.terms.size(); ++at) {
    const auto [variable, factor] = sum.terms[at];
    if (store[variable].kind != TermKind::Variable)
      continue;
    LinearSum rest = sum;
    rest.terms.erase(rest.terms.begin() + static_cast<std::ptrdiff_t>(at));
    const TermId value = store.scale(Number(-1) / factor, store.fromLinear(rest));
    const std::vector<TermId> inside = smt::variablesOf(store, value);
    if (mayDefine(store, variable, value) && !std::binary_search(inside.begin(), inside.end(), variable))
      return Definition{variable, value};
  }
  return std::nullopt;
}

} // namespace

bool Eliminated::defines(TermId variable) const {
  return std::any_of(definitions.begin(), definitions.end(),
                     [&](const Definition &definition) { return definition.first == variable; });
}

Eliminated eliminate(smt::TermStore &store, std::vector<TermId> formulas) {
  Eliminated result;
  for (;;) {
    std::optional<Definition> definition;
    for (std::size_t index = 0; index < formulas.size() && !definition; ++index)
      definition = definitionIn(store, formulas[index]);
    if (!definition)
      break;
    for (TermId &formula : formulas)
      if (std::ranges::binary_search(store.variablesOf(formula), definition->first))
        formula = smt::substitute(store, formula, {*definition});
    const TermId whole = store.logicalAnd(formulas);
    formulas = store[whole].kind == TermKind::And ? store[whole].arguments : std::vector{whole};
    result.definitions.push_back(*definition);
  }
  result.formulas = std::move(formulas);
  return result;
}

void complete(const smt::TermStore &store, const Eliminated &eliminated, smt::Model &model) {
  for (auto definition = eliminated.definitions.rbegin(); definition != eliminated.definitions.rend(); ++definition)
    if (std::optional<smt::Value> value = smt::evaluate(store, definition->second, model))
      model.insert_or_assign(store[definition->first].name, *value);
}

} // namespace feedhold::prove
