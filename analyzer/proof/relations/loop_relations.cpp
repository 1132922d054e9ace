#include "proof/relations/loop_relations.h"

#include "proof/relations/loop_states.h"
#include "proof/relations/polynomials.h"
#include "proof/smt/steps.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace feedhold::prove {

using smt::Number;
using smt::TermId;
using smt::TermKind;

namespace {

constexpr std::size_t kMostVariables = 9;   // of a loop, between which relations are looked for
constexpr std::size_t kMostEqualities = 12; // the shortest
constexpr std::size_t kLongestEquality = 12;
constexpr std::size_t kMostComparisons = 24;
constexpr std::size_t kMostOfGoals = 40; // for one loop
constexpr std::size_t kFewestStates = 8; // that show an order of two variables

} // namespace

// ---- LoopRelations ----

TermId LoopRelations::placeholder(smt::TermStore &store, std::uint32_t variable) {
  const auto [known, isNew] = placeholders_.try_emplace(variable, store.no());
  if (isNew)
    known->second = store.variable(fmt::format("#{} before an iteration", variable), smt::Sort::Real);
  return known->second;
}

void LoopRelations::add(Place head, TermId relation) {
  std::vector<TermId> &known = relations_[head];
  if (std::ranges::find(known, relation) == known.end())
    known.push_back(relation);
}

std::vector<TermId> LoopRelations::in(smt::TermStore &store, Place head, const SymbolicState &state) const {
  const auto relations = relations_.find(head);
  if (relations == relations_.end())
    return {};
  smt::Substitution present;
  std::set<TermId> absent;
  for (const auto &[variable, placeholder] : placeholders_) {
    const SymbolicValue *value =
        variable < state.locals.size() ? &state.locals[variable] : state.variables.find(variable);
    if (value)
      present.emplace(placeholder, value->number);
    else
      absent.insert(placeholder);
  }
  std::vector<TermId> found;
  for (const TermId relation : relations->second)
    if (std::ranges::none_of(smt::variablesOf(store, relation),
                             [&](TermId variable) { return absent.contains(variable); }))
      found.push_back(smt::substitute(store, relation, present));
  return found;
}

// ---- what runs have shown ----

namespace {

/// What iterations look at and what they leave, without what is known since the arrival.
std::set<TermId> usedIn(const smt::TermStore &store, const LoopInstance &loop) {
  std::set<TermId> used;
  const auto use = [&](TermId term) {
    const auto &variables = smt::variablesOf(store, term);
    used.insert(variables.begin(), variables.end());
  };
  for (const Transition &transition : loop.transitions) {
    for (const TermId condition : transition.conditions)
      if (std::ranges::find(loop.arrival, condition) == loop.arrival.end())
        use(condition);
    for (const auto &[variable, next] : transition.next)
      use(next);
  }
  return used;
}

/// Between which relations are looked for: what stays first, so that equalities are solved for what changes.
std::vector<std::uint32_t> relatedIn(const smt::TermStore &store, const LoopInstance &loop) {
  const std::set<TermId> used = usedIn(store, loop);
  std::vector<std::uint32_t> stay, change;
  for (const LoopInstance::Value &value : loop.values) {
    if (value.generic != value.arrival)
      change.push_back(value.variable);
    else if (std::ranges::any_of(smt::variablesOf(store, value.generic),
                                 [&](TermId variable) { return used.contains(variable); }))
      stay.push_back(value.variable);
  }
  change.resize(std::min(change.size(), kMostVariables));
  stay.resize(std::min(stay.size(), kMostVariables - change.size()));
  stay.insert(stay.end(), change.begin(), change.end());
  return stay;
}

TermId sumOf(smt::TermStore &store, const PolynomialEquality &equality, const std::vector<TermId> &variables) {
  TermId sum = store.number(Number(0));
  for (const auto &[factor, monomial] : equality) {
    TermId product = store.number(Number(1));
    for (const std::size_t variable : monomial)
      product = store.multiply(product, variables[variable]);
    sum = store.add(sum, store.scale(factor, product));
  }
  return sum;
}

/// Pairs of which one is never above the other.
std::vector<std::pair<std::size_t, std::size_t>> ordersIn(const LoopStates &states) {
  std::vector<std::pair<std::size_t, std::size_t>> orders;
  if (states.visits.size() < kFewestStates)
    return orders;
  for (std::size_t i = 0; i < states.variables.size(); ++i)
    for (std::size_t j = 0; j < states.variables.size(); ++j)
      if (i != j && orders.size() < kMostComparisons &&
          std::ranges::all_of(states.visits, [&](const auto &visit) { return visit[i] <= visit[j]; }))
        orders.emplace_back(i, j);
  return orders;
}

} // namespace

void addRelationsOfRuns(const ProofContext &context, LoopRelations &relations) {
  smt::TermStore &store = context.start.store();
  StatesOfLoops states;
  for (const LoopInstance &loop : context.found.loops)
    if (loop.isRecorded && !loop.variables.empty())
      states.try_emplace(loop.head, LoopStates{relatedIn(store, loop)});
  if (states.empty())
    return;
  addStatesOfRuns(context, states);
  for (const auto &[head, loop] : states) {
    std::vector<TermId> variables;
    for (const std::uint32_t variable : loop.variables)
      variables.push_back(relations.placeholder(store, variable));
    std::vector<PolynomialEquality> equalities = equalitiesAt(loop.visits, variables.size());
    std::erase_if(equalities, [](const PolynomialEquality &each) { return each.size() > kLongestEquality; });
    std::ranges::stable_sort(equalities, {}, &PolynomialEquality::size);
    equalities.resize(std::min(equalities.size(), kMostEqualities));
    for (const PolynomialEquality &equality : equalities)
      relations.add(head, store.equal(sumOf(store, equality, variables), store.number(Number(0))));
    for (const auto &[low, high] : ordersIn(loop))
      relations.add(head, store.lessOrEqual(variables[low], variables[high]));
  }
}

// ---- what open claims ask ----

namespace {

/// From what stands for the state before an iteration to the variables of programs that hold it.
smt::Substitution byVariables(smt::TermStore &store, const LoopInstance &loop, LoopRelations &relations) {
  smt::Substitution names;
  for (const LoopInstance::Value &value : loop.values)
    if (store[value.generic].kind == TermKind::Variable)
      names.emplace(value.generic, relations.placeholder(store, value.variable));
  for (const LoopInstance::Value &value : loop.values) { // arrival + iterations * step
    const smt::LinearSum by = store.linear(store.subtract(value.generic, value.arrival));
    if (by.terms.size() == 1 && by.terms.front().first == loop.iterations && by.constant.isZero())
      names.emplace(loop.iterations,
                    store.scale(Number(1) / by.terms.front().second,
                                store.subtract(relations.placeholder(store, value.variable), value.arrival)));
  }
  return names;
}

/// The comparisons in the conditions of the paths.
std::set<TermId> comparisonsIn(const smt::TermStore &store, const std::vector<Question> &open) {
  std::set<TermId> found;
  for (const Question &question : open)
    for (const PathGoal &goal : question.goals) {
      if (question.row.verdict != Verdict::Unknown)
        break;
      std::vector<TermId> terms = *goal.conditions;
      terms.push_back(goal.goal);
      if (goal.stops)
        terms.push_back(*goal.stops);
      smt::spend(20 * terms.size());
      for (const TermId term : smt::reachable(store, terms))
        if (const smt::Term &each = store[term];
            each.kind == TermKind::Less || each.kind == TermKind::LessOrEqual ||
            (each.kind == TermKind::Equal && store.sort(each.arguments[0]) != smt::Sort::Bool))
          found.insert(term);
    }
  return found;
}

/// What may be an invariant because of a comparison that is asked: it, or the opposite.
std::vector<TermId> formsOf(smt::TermStore &store, TermId comparison) {
  const smt::Term term = store[comparison];
  if (term.kind != TermKind::Equal)
    return {comparison, store.logicalNot(comparison)};
  return {comparison, store.lessOrEqual(term.arguments[0], term.arguments[1]),
          store.lessOrEqual(term.arguments[1], term.arguments[0])};
}

} // namespace

void addRelationsOfGoals(const ProofContext &context, const std::vector<Question> &open, LoopRelations &relations) {
  smt::TermStore &store = context.start.store();
  const SymbolicInterpretation &interpretation = context.start.interpretation();
  const std::set<TermId> comparisons = comparisonsIn(store, open);
  for (const LoopInstance &loop : context.found.loops) {
    if (!loop.isRecorded || loop.variables.empty())
      continue;
    const smt::Substitution names = byVariables(store, loop, relations);
    std::set<TermId> placeholders;
    for (const LoopInstance::Value &value : loop.values)
      placeholders.insert(relations.placeholder(store, value.variable));
    std::size_t added = 0;
    for (const TermId comparison : comparisons) {
      const TermId named = smt::substitute(store, comparison, names);
      const auto &variables = smt::variablesOf(store, named);
      const auto isKnown = [&](TermId variable) {
        return placeholders.contains(variable) || interpretation.isFromEntry(variable);
      };
      if (added == kMostOfGoals || !std::ranges::all_of(variables, isKnown) ||
          std::ranges::none_of(variables, [&](TermId variable) { return placeholders.contains(variable); }))
        continue;
      ++added;
      for (const TermId form : formsOf(store, named))
        relations.add(loop.head, form);
    }
  }
}

} // namespace feedhold::prove
