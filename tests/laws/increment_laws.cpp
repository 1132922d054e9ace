// Laws of increments: what is told of words and comparisons over arguments in steps is what the processor computes.
#include "base/support/mantissa32.h"
#include "proof/smt/model.h"
#include "proof/symbolic/increments.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <fmt/format.h>

namespace feedhold {
namespace {

using prove::Increments;
using smt::Function;
using smt::Number;
using smt::Sort;
using smt::TermId;
using smt::TermStore;

int pick(int low, int high) { return *rc::gen::inRange(low, high + 1); }

struct Computed {
  TermId term;
  double value;
};

/// Computations of a control over arguments that are multiples of a thousandth, and the terms for them.
class Computations {
public:
  Computations(TermStore &store, Increments &increments, bool isShort) : store_(store), isShort_(isShort) {
    for (int i = 0; i < 3; ++i) {
      const std::string name = fmt::format("#{}", i);
      const TermId input = store.variable(name, Sort::Real);
      const double number = pick(-9'999'999, 9'999'999) / 1000.0;
      increments.setStep(input, Number(1) / Number(1000));
      model.emplace(name, Number::fromTyped(number));
      inputs_.push_back(held(input, number));
    }
  }

  Computed computed(int depth) {
    if (depth == 0)
      return pick(0, 2) == 0 ? typed(pick(-99'999, 99'999)) : inputs_[static_cast<std::size_t>(pick(0, 2))];
    const Computed a = computed(depth - 1);
    if (pick(0, 3) == 0) {
      const TermId exact = store_.scale(Number(3), a.term);
      return rounded(exact, 3 * a.value, size(exact));
    }
    const Computed b = computed(depth - 1);
    const int sign = pick(0, 1) == 0 ? 1 : -1;
    return rounded(store_.add(a.term, store_.scale(Number(sign), b.term)), a.value + sign * b.value,
                   store_.add(size(a.term), size(b.term)));
  }
  Computed typed(int thousandths) {
    const double value = thousandths / 1000.0;
    return held(store_.number(Number::fromTyped(value)), value);
  }
  const std::vector<Computed> &inputs() const { return inputs_; }

  smt::Model model;

private:
  double near(double value) const { return isShort_ ? mantissa32::nearest(value) : value; }
  TermId size(TermId term) { return store_.absolute(term); }
  TermId within(TermId exact, double part, TermId of) {
    return store_.apply(Function::Near, std::array{exact, store_.scale(Number::fromDouble(part), of)});
  }
  /// As literals and inputs are held.
  Computed held(TermId exact, double value) {
    if (isShort_)
      return {within(exact, std::ldexp(1.0, -32), size(exact)), near(value)};
    const bool isNumber = store_.isNumber(exact);
    return {isNumber ? store_.number(Number::fromDouble(value)) : store_.apply(Function::Nearest, exact), value};
  }
  Computed rounded(TermId exact, double value, TermId operands) {
    if (isShort_)
      return {within(exact, mantissa32::kErrorOfSum, operands), near(value)};
    return {store_.apply(Function::Nearest, exact), value};
  }

  TermStore &store_;
  bool isShort_;
  std::vector<Computed> inputs_;
};

void wordsAreExact(bool isShort) {
  TermStore store;
  Increments increments(store);
  Computations computations(store, increments, isShort);
  const Computed sum = computations.computed(pick(0, 3));
  std::vector<prove::TakenAsSmall> small;
  const auto word = increments.wordOf(sum.term, Number(1) / Number(1000), small);
  RC_PRE(word.has_value());
  const auto exact = smt::evaluate(store, *word, computations.model);
  RC_ASSERT(exact.has_value());
  const Number thousandths = Number::fromDouble(std::round(sum.value * 1000));
  RC_ASSERT(std::get<Number>(*exact) == thousandths / Number(1000));
}

void comparisonsAreExact(bool isShort) {
  TermStore store;
  Increments increments(store);
  Computations computations(store, increments, isShort);
  const Computed a = computations.inputs()[0];
  const Computed b = pick(0, 1) == 0 ? computations.inputs()[1] : computations.typed(pick(-9'999'999, 9'999'999));
  const auto pair = increments.typedPair(a.term, b.term);
  RC_ASSERT(pair.has_value());
  const auto valueOf = [&](TermId term) { return std::get<Number>(*smt::evaluate(store, term, computations.model)); };
  RC_ASSERT((valueOf(pair->first) < valueOf(pair->second)) == (a.value < b.value));
  RC_ASSERT((valueOf(pair->first) == valueOf(pair->second)) == (a.value == b.value));
}

RC_GTEST_PROP(IncrementLaws, WordsAreExactInDoubles, ()) { wordsAreExact(false); }
RC_GTEST_PROP(IncrementLaws, WordsAreExactInShortMantissas, ()) { wordsAreExact(true); }
RC_GTEST_PROP(IncrementLaws, ComparisonsAreExactInDoubles, ()) { comparisonsAreExact(false); }
RC_GTEST_PROP(IncrementLaws, ComparisonsAreExactInShortMantissas, ()) { comparisonsAreExact(true); }

} // namespace
} // namespace feedhold
