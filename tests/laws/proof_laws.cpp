// Laws of proofs: what is proved has no counterexample, what is refuted has one, and the facts about functions are
// true.
#include "proof/check/certificate.h"
#include "proof/decide/discharge.h"
#include "proof/smt/exact_angles.h"
#include "proof/smt/purify.h"
#include "proof/smt/simplex.h"
#include "proof/smt/smtlib.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>

namespace feedhold {
namespace {

using smt::Function;
using smt::Number;
using smt::Sort;
using smt::TermId;
using smt::TermKind;
using smt::TermStore;

int pick(int low, int high) { return *rc::gen::inRange(low, high + 1); }

/// Small formulas over two reals, an integer and a Bool.
class Formulas {
public:
  explicit Formulas(TermStore &store) : store_(store) {}

  TermId formula(int depth) {
    switch (depth > 0 ? pick(0, 6) : pick(0, 2)) {
    case 0: return store_.less(number(2), number(1));
    case 1: return store_.lessOrEqual(number(1), number(2));
    case 2: return pick(0, 4) == 0 ? store_.variable("b", Sort::Bool) : store_.equal(number(1), number(1));
    case 3: return store_.logicalNot(formula(depth - 1));
    case 4: return store_.logicalAnd(formula(depth - 1), formula(depth - 1));
    default: return store_.logicalOr(formula(depth - 1), formula(depth - 1));
    }
  }

private:
  TermId number(int depth) {
    switch (depth > 0 ? pick(0, 8) : pick(0, 3)) {
    case 0: return store_.variable("x", Sort::Real);
    case 1: return store_.variable("y", Sort::Real);
    case 2: return store_.variable("n", Sort::Int);
    case 3: return store_.number(Number(pick(-3, 3)));
    case 4: return store_.multiply(number(depth - 1), number(depth - 1));
    case 5: return store_.scale(Number(pick(-2, 2)), number(depth - 1));
    case 6: return store_.ite(formula(0), number(depth - 1), number(depth - 1));
    case 7: return pick(0, 1) == 0 ? store_.floor(number(depth - 1)) : store_.divide(number(depth - 1), number(0));
    default: return store_.add(number(depth - 1), number(depth - 1));
    }
  }

  TermStore &store_;
};

/// No quotient by 0 stands in it: such a one is any number to a model.
bool isDefined(const TermStore &store, TermId formula, const smt::Model &model) {
  const std::vector<TermId> all = smt::reachable(store, std::vector{formula});
  return std::all_of(all.begin(), all.end(), [&](TermId id) {
    return store[id].kind != TermKind::Divide || smt::evaluate(store, id, model).has_value();
  });
}

RC_GTEST_PROP(ProofLaws, ProvedHasNoCounterexampleOnAGrid, ()) {
  TermStore store;
  Formulas formulas(store);
  prove::Query query{{}, store.no()};
  for (int count = pick(1, 5); count > 0; --count)
    query.assumptions.push_back(formulas.formula(2));
  const prove::Outcome outcome = prove::discharge(store, query, {.search = 200'000, .z3 = 0, .cvc5 = 0});
  const TermId whole = store.logicalAnd(query.assumptions);
  const smt::Model *model = outcome.counterexample();
  if (model != nullptr && isDefined(store, whole, *model))
    RC_ASSERT(smt::evaluate(store, whole, *model) != smt::Value(false));
  if (const auto *unknown = std::get_if<prove::Unknown>(&outcome.answer))
    RC_ASSERT(unknown->reason.find("does not hold") == std::string::npos);
  RC_CLASSIFY(outcome.proved(), "proved");
  RC_CLASSIFY(model != nullptr, "refuted");
  if (!outcome.proved())
    return;
  for (int x = -6; x <= 6; ++x)
    for (int y = -6; y <= 6; ++y)
      for (int n = -3; n <= 3; ++n)
        for (bool b : {false, true}) {
          const smt::Model point{{"x", Number(x) / 2}, {"y", Number(y) / 2}, {"n", Number(n)}, {"b", b}};
          RC_ASSERT(smt::evaluate(store, whole, point) != smt::Value(true));
        }
}

RC_GTEST_PROP(ProofLaws, SmtLibSaysTheSame, ()) {
  TermStore store;
  const TermId formula = Formulas(store).formula(3);
  Result<std::vector<TermId>> read = smt::readSmtLib(store, smt::writeSmtLib(store, std::vector{formula}));
  RC_ASSERT(read.ok());
  const smt::Model model{{"x", Number(pick(-6, 6)) / 2},
                         {"y", Number(pick(-6, 6)) / 2},
                         {"n", Number(pick(-3, 3))},
                         {"b", pick(0, 1) == 1}};
  RC_ASSERT(smt::evaluate(store, read.value().at(0), model) == smt::evaluate(store, formula, model));
}

struct LinearConstraint {
  smt::Simplex::Form form;
  Number constant;
  smt::LinearRelation relation;
};

LinearConstraint linearConstraint(std::uint32_t columns) {
  LinearConstraint constraint;
  for (std::uint32_t column = 0; column < columns; ++column)
    if (const int factor = pick(-3, 3); factor != 0)
      constraint.form.emplace_back(column, Number(factor));
  constraint.constant = Number(pick(-4, 4));
  constraint.relation = static_cast<smt::LinearRelation>(pick(0, 2));
  return constraint;
}

void checkPoint(const smt::Simplex &simplex, const std::vector<LinearConstraint> &constraints) {
  const Number delta = simplex.smallDelta();
  for (const LinearConstraint &constraint : constraints) {
    Number value = constraint.constant;
    for (const auto &[column, factor] : constraint.form)
      value += (simplex.value(column).real + simplex.value(column).infinitesimal * delta) * factor;
    const int sign = value.sign();
    const bool holds = constraint.relation == smt::LinearRelation::Zero       ? sign == 0
                       : constraint.relation == smt::LinearRelation::Positive ? sign > 0
                                                                              : sign >= 0;
    RC_ASSERT(holds);
  }
}

void checkConflict(const smt::Simplex &simplex, const std::vector<LinearConstraint> &constraints) {
  std::map<std::uint32_t, Number> sum;
  Number constant;
  bool strict = false;
  for (const auto &[reason, multiplier] : simplex.conflict()) {
    const LinearConstraint &constraint = constraints.at(reason);
    RC_ASSERT(constraint.relation == smt::LinearRelation::Zero || multiplier.sign() > 0);
    strict = strict || constraint.relation == smt::LinearRelation::Positive;
    constant += constraint.constant * multiplier;
    for (const auto &[column, factor] : constraint.form)
      sum[column] += factor * multiplier;
  }
  for (const auto &[column, factor] : sum)
    RC_ASSERT(factor.isZero());
  RC_ASSERT(constant.sign() < 0 || (constant.isZero() && strict));
}

RC_GTEST_PROP(ProofLaws, SimplexShowsAPointOrAConflict, ()) {
  const std::uint32_t columns = static_cast<std::uint32_t>(pick(1, 4));
  smt::Simplex simplex;
  for (std::uint32_t column = 0; column < columns; ++column)
    simplex.addColumn();
  std::vector<LinearConstraint> constraints;
  std::vector<std::pair<smt::Simplex::Mark, std::size_t>> marks;
  for (int step = 0; step < 14; ++step) {
    if (!marks.empty() && pick(0, 3) == 0) {
      simplex.undo(marks.back().first);
      constraints.resize(marks.back().second);
      marks.pop_back();
    } else {
      marks.emplace_back(simplex.mark(), constraints.size());
      constraints.push_back(linearConstraint(columns));
      const LinearConstraint &last = constraints.back();
      simplex.require(static_cast<std::uint32_t>(constraints.size() - 1), last.form, last.constant, last.relation);
    }
    if (simplex.check(1'000'000) == smt::Simplex::Status::Feasible)
      checkPoint(simplex, constraints);
    else
      checkConflict(simplex, constraints);
  }
}

/// What a term is in doubles; NaN where it is undefined.  Bools are 0 and 1; comparisons are generous.
class Doubles {
public:
  Doubles(const TermStore &store, std::map<TermId, double> values) : store_(store), values_(std::move(values)) {}

  void define(TermId variable, double value) { values_[variable] = value; }

  double of(TermId id) const {
    if (auto known = values_.find(id); known != values_.end())
      return known->second;
    const smt::Term &term = store_[id];
    std::vector<double> parts;
    for (TermId argument : term.arguments)
      parts.push_back(of(argument));
    switch (term.kind) {
    case TermKind::True: return 1;
    case TermKind::False: return 0;
    case TermKind::Number: return term.number.toDouble();
    case TermKind::Add: return fold(parts, 0, [](double a, double b) { return a + b; });
    case TermKind::Multiply: return fold(parts, 1, [](double a, double b) { return a * b; });
    case TermKind::Divide: return parts[0] / parts[1];
    case TermKind::Less:
    case TermKind::LessOrEqual: return parts[0] <= parts[1] + slack(parts) ? 1 : 0;
    case TermKind::Equal: return std::abs(parts[0] - parts[1]) <= slack(parts) ? 1 : 0;
    case TermKind::And: return fold(parts, 1, [](double a, double b) { return std::min(a, b); });
    case TermKind::Or: return fold(parts, 0, [](double a, double b) { return std::max(a, b); });
    case TermKind::Not: return 1; // only of an Equal: generous
    case TermKind::Ite: return parts[0] > 0 ? parts[1] : parts[2];
    case TermKind::Apply: return function(term.function, parts);
    case TermKind::Variable: break;
    }
    return std::nan("");
  }

  static double function(Function function, const std::vector<double> &parts) {
    const double degree = std::numbers::pi / 180, x = parts[0];
    switch (function) {
    case Function::Floor: return std::floor(x);
    case Function::Sqrt: return std::sqrt(x);
    case Function::Sin: return std::sin(x * degree);
    case Function::Cos: return std::cos(x * degree);
    case Function::Tan: return std::tan(x * degree);
    case Function::Asin: return std::asin(x) / degree;
    case Function::Acos: return std::acos(x) / degree;
    case Function::Atan2: return std::atan2(x, parts[1]) / degree;
    case Function::Ln: return std::log(x);
    case Function::Exp: return std::exp(x);
    case Function::Power: return std::pow(x, parts[1]);
    case Function::BitAnd:
    case Function::BitOr:
    case Function::BitXor:
    case Function::Nearest: // rounding_laws.cpp, which computes exactly
    case Function::Near: break;
    }
    return std::nan("");
  }

private:
  template <typename Operation>
  static double fold(const std::vector<double> &parts, double start, Operation operation) {
    for (double part : parts)
      start = operation(start, part);
    return start;
  }
  static double slack(const std::vector<double> &parts) { return 1e-7 * (1 + std::abs(parts[0]) + std::abs(parts[1])); }

  const TermStore &store_;
  std::map<TermId, double> values_;
};

RC_GTEST_PROP(ProofLaws, FactsAboutFunctionsAreTrue, ()) {
  TermStore store;
  const TermId x = store.variable("x", Sort::Real), y = store.variable("y", Sort::Real);
  const Function function = static_cast<Function>(pick(0, static_cast<int>(Function::Power)));
  const bool isQuotient = pick(0, 9) == 0;
  const TermId term = isQuotient                  ? store.divide(x, y)
                      : smt::arity(function) == 1 ? store.apply(function, x)
                                                  : store.apply(function, std::vector{x, y});
  const smt::Purified purified =
      smt::purify(store, std::vector{store.less(term, store.number(7))}, smt::Hold::Together);
  Doubles doubles(store, {{x, pick(-4000, 4000) / 1000.0 * pick(1, 80)}, {y, pick(-4000, 4000) / 1000.0}});
  for (const smt::Definition &definition : purified.definitions) {
    const double value = doubles.of(definition.application);
    if (!std::isfinite(value) || std::abs(value) > 1e6)
      return; // undefined, or beyond what doubles can judge
    doubles.define(definition.variable, value);
  }
  for (TermId fact : purified.facts)
    RC_ASSERT(doubles.of(fact) > 0);
}

RC_GTEST_PROP(ProofLaws, EnclosuresHold, ()) {
  const Number degrees = Number(pick(-100'000, 100'000)) / pick(1, 300);
  const smt::Enclosure bounds = smt::encloseSine(degrees);
  const double sine = std::sin(degrees.toDouble() * std::numbers::pi / 180);
  RC_ASSERT(bounds.low.toDouble() <= sine + 1e-9 && sine - 1e-9 <= bounds.high.toDouble());
  RC_ASSERT(bounds.low <= bounds.high);
  if (const std::optional<Number> exact = smt::exactSine(degrees))
    RC_ASSERT(bounds.low <= *exact && *exact <= bounds.high);
}

} // namespace
} // namespace feedhold
