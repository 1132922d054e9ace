// Laws of rounding: what is known of rounded numbers is true of the numbers that this machine computes.
#include "proof/smt/model.h"
#include "proof/smt/purify.h"
#include "proof/smt/rounding_facts.h"
#include "proof/smt/square_facts.h"
#include "proof/smt/unit_resolution.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <functional>

namespace feedhold {
namespace {

using smt::Function;
using smt::Number;
using smt::Sort;
using smt::TermId;
using smt::TermStore;

int pick(int low, int high) { return *rc::gen::inRange(low, high + 1); }

/// As they are typed: mostly with up to four decimals, of either sign.
double typed() { return pick(-9999, 9999) * std::pow(10.0, -pick(0, 4)); }

/// A computation over doubles, and the term for it.
struct Computed {
  TermId term;
  double value;
};

class Computations {
public:
  explicit Computations(TermStore &store) : store_(store) {
    for (const char *name : {"x", "y", "z"}) {
      const TermId variable = store.variable(name, Sort::Real);
      store.markAsDouble(variable);
      inputs_.push_back({variable, typed()});
      model.emplace(name, Number::fromDouble(inputs_.back().value));
    }
  }

  Computed computed(int depth) {
    if (depth == 0 || pick(0, 4) == 0)
      return inputs_[static_cast<std::size_t>(pick(0, 2))];
    const Computed a = computed(depth - 1), b = computed(depth - 1);
    switch (pick(0, 7)) {
    case 7: return distance(a, b);
    case 6: return {store_.absolute(a.term), std::abs(a.value)};
    case 5: return fromConstant(a, std::ldexp(1.0, pick(-2, 2)), typed());
    case 0: return rounded(store_.add(a.term, b.term), a.value + b.value);
    case 1:
    case 2: return rounded(store_.subtract(a.term, b.term), a.value - b.value);
    case 3: return rounded(store_.multiply(a.term, b.term), a.value * b.value);
    default: return b.value == 0 ? a : rounded(store_.divide(a.term, b.term), a.value / b.value);
    }
  }

  /// |a - b|, chosen by the exact difference.
  Computed distance(const Computed &a, const Computed &b) {
    const TermId exact = store_.subtract(a.term, b.term);
    const Computed difference = rounded(exact, a.value - b.value);
    return {store_.ite(store_.less(store_.number(Number(0)), exact), difference.term, store_.negate(difference.term)),
            std::abs(difference.value)};
  }
  /// Bounds that the inputs keep, and comparisons that hold.
  std::vector<TermId> truths(const Computed &a, const Computed &b) {
    std::vector<TermId> all;
    for (const Computed &input : inputs_)
      if (pick(0, 3) != 0) {
        all.push_back(store_.lessOrEqual(number(std::floor(input.value) - pick(0, 2)), input.term));
        all.push_back(store_.lessOrEqual(input.term, number(std::ceil(input.value) + pick(0, 2))));
      }
    if (a.value != b.value)
      all.push_back(store_.notEqual(a.term, b.term));
    all.push_back(a.value < b.value ? store_.less(a.term, b.term) : store_.lessOrEqual(b.term, a.term));
    all.push_back(store_.logicalOr(store_.less(a.term, number(-1e12)), store_.lessOrEqual(number(-1e12), a.term)));
    return all;
  }

  smt::Model model;

private:
  TermId number(double value) { return store_.number(Number::fromDouble(value)); }
  Computed fromConstant(const Computed &a, double factor, double constant) {
    const TermId scaled = store_.scale(Number::fromDouble(factor), a.term);
    return rounded(store_.subtract(scaled, number(constant)), factor * a.value - constant);
  }
  Computed rounded(TermId exact, double value) { return {store_.apply(Function::Nearest, exact), value}; }

  TermStore &store_;
  std::vector<Computed> inputs_;
};

/// Folding of constants is the rounding of the machine.
RC_GTEST_PROP(RoundingLaws, TheNearestDoubleIsThatOfTheMachine, ()) {
  TermStore store;
  Computations computations(store);
  const Computed result = computations.computed(4);
  RC_PRE(std::isfinite(result.value));
  const auto value = smt::evaluate(store, result.term, computations.model);
  RC_ASSERT(value.has_value());
  RC_ASSERT(std::get<Number>(*value) == Number::fromDouble(result.value));
}

RC_GTEST_PROP(RoundingLaws, FactsAboutRoundedNumbersAreTrue, ()) {
  TermStore store;
  Computations computations(store);
  const Computed a = computations.computed(4), b = computations.computed(3);
  RC_PRE(std::isfinite(a.value) && std::isfinite(b.value));
  const std::vector<TermId> formulas = computations.truths(a, b);
  smt::Model model = computations.model;
  const auto holds = [&](TermId formula) {
    const auto value = smt::evaluate(store, formula, model);
    return !value || std::get<bool>(*value); // a divisor of a weaker formula may be 0
  };
  for (const TermId formula : formulas)
    RC_ASSERT(holds(formula));
  const std::vector<TermId> resolved = smt::resolveUnits(store, formulas);
  for (const TermId formula : resolved)
    RC_ASSERT(holds(formula));
  const smt::Purified purified = smt::purify(store, resolved, smt::Hold::Together);
  for (const smt::Definition &definition : purified.definitions) {
    const auto value = smt::evaluate(store, definition.application, model);
    RC_ASSERT(value.has_value());
    model.emplace(store[definition.variable].name, *value);
  }
  for (const TermId fact : purified.facts)
    RC_ASSERT(holds(fact));
  for (const TermId formula : purified.formulas)
    RC_ASSERT(holds(formula));
  const auto unrounded = smt::withoutRounding(store, resolved);
  for (const TermId weaker : unrounded.value_or(std::vector<TermId>{}))
    RC_ASSERT(holds(weaker));
}

RC_GTEST_PROP(RoundingLaws, FactsAboutSumsOfSquaresAreTrue, ()) {
  TermStore store;
  const double numbers[] = {typed(), typed(), typed()};
  const TermId x = store.variable("x", Sort::Real), y = store.variable("y", Sort::Real),
               r = store.variable("r", Sort::Real);
  const auto squared = [&](TermId term) { return store.scale(Number(pick(-2, 3)), store.multiply(term, term)); };
  const TermId sum = store.add(std::vector{squared(x), squared(y), squared(r)});
  const TermId bound = store.number(Number::fromDouble(typed()));
  const std::vector<TermId> formulas{store.lessOrEqual(sum, bound),
                                     store.logicalOr(store.less(bound, sum), store.less(x, y))};
  const smt::Model model{{"x", Number::fromDouble(numbers[0])},
                         {"y", Number::fromDouble(numbers[1])},
                         {"r", Number::fromDouble(numbers[2])}};
  for (const TermId fact : smt::squareFacts(store, formulas))
    RC_ASSERT(smt::isTrue(store, fact, model));
}

RC_GTEST_PROP(RoundingLaws, RootsLieBetweenTheirBounds, ()) {
  const Number value = Number::fromDouble(std::abs(typed()) * std::pow(10.0, pick(-20, 20)));
  const auto [low, high] = smt::rootBounds(value);
  RC_ASSERT(low.sign() >= 0 && low * low <= value && value <= high * high);
}

/// A choice bounds what each of its cases does, and a square its root.
RC_GTEST_PROP(RoundingLaws, BoundsHoldWhereTheFormulasDo, ()) {
  TermStore store;
  const double numbers[] = {typed(), typed()};
  const TermId x = store.variable("x", Sort::Real), y = store.variable("y", Sort::Real);
  const TermId squares = store.add(store.multiply(x, x), store.multiply(y, y));
  const auto about = [&](TermId term) {
    const TermId limit = store.number(Number::fromDouble(typed()));
    return pick(0, 1) == 0 ? store.less(term, limit) : store.lessOrEqual(limit, term);
  };
  const auto some = [&] { return about(pick(0, 2) == 0 ? x : pick(0, 1) == 0 ? y : squares); };
  const std::vector<TermId> formulas{store.logicalOr(store.logicalAnd(some(), some()), some()),
                                     store.logicalOr(some(), some()), some()};
  const smt::Model model{{"x", Number::fromDouble(numbers[0])}, {"y", Number::fromDouble(numbers[1])}};
  for (const TermId formula : formulas)
    RC_PRE(smt::isTrue(store, formula, model));
  const smt::Bounds bounds(store, formulas);
  RC_ASSERT(bounds.of(x).contains(numbers[0]) && bounds.of(y).contains(numbers[1]));
}

RC_GTEST_PROP(RoundingLaws, FactsAboutRoundedRootsAreTrue, ()) {
  TermStore store;
  const double x = typed(), y = typed(), square = x * x;
  const Number exact = Number::fromDouble(square) - Number::fromDouble(pick(0, 1) == 0 ? y * y : 0.0);
  RC_PRE(exact.sign() >= 0);
  const auto named = [&](const char *name) { return store.variable(name, Sort::Real); };
  const smt::Model model{{"root", Number::fromDouble(std::sqrt(exact.toDouble()))},
                         {"argument", exact},
                         {"square", Number::fromDouble(square)},
                         {"x", Number::fromDouble(x)}};
  for (const TermId fact : smt::rootFacts(store, named("root"), named("argument"), named("square"), named("x")))
    RC_ASSERT(smt::isTrue(store, fact, model));
  const smt::Model whole{{"root", Number::fromDouble(std::sqrt(square))}, {"x", Number::fromDouble(x)}};
  const TermId product = store.multiply(named("x"), named("x"));
  for (const TermId fact : smt::rootFacts(store, named("root"), product, product, named("x")))
    RC_ASSERT(smt::isTrue(store, fact, whole));
}

} // namespace
} // namespace feedhold
