#include "proof/smt/bounds.h"

#include "proof/smt/steps.h"

#include <cmath>

namespace feedhold::smt {
namespace {

constexpr int kRounds = 3;
constexpr int kDeepestBound = 200;     // of a term: of what lies deeper only what is told is known
constexpr std::size_t kMostTerms = 12; // of a comparison that is learnt from

bool isSquare(const Term &product) {
  return product.arguments.size() == 2 && product.arguments[0] == product.arguments[1];
}

} // namespace

Interval around(const Number &value) {
  const double near = value.toDouble();
  if (std::isfinite(near) && Number::fromDouble(near) == value)
    return Interval::constant(near);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return {std::nextafter(near, -kInfinity), std::nextafter(near, kInfinity)};
}

Bounds::Bounds(const TermStore &store, std::span<const TermId> formulas) : store_(store) { learn(formulas); }

void Bounds::learn(std::span<const TermId> formulas) {
  for (int round = 0; round < kRounds; ++round) {
    spend(5 * formulas.size());
    for (const TermId formula : formulas)
      learn(store_[formula]);
  }
}

void Bounds::learn(const Term &term) {
  const bool isComparison =
      term.kind == TermKind::Less || term.kind == TermKind::LessOrEqual || term.kind == TermKind::Equal;
  if (!isComparison || store_.sort(term.arguments[0]) == Sort::Bool)
    return;
  const TermId left = term.arguments[0], right = term.arguments[1];
  const bool isUpper = store_.isNumber(right); // one side is a constant
  const Interval bound = around(store_[isUpper ? right : left].number);
  Interval allowed = isUpper ? Interval::atMost(bound.hi) : Interval::atLeast(bound.lo);
  if (term.kind == TermKind::Equal)
    allowed = bound;
  restrict(isUpper ? left : right, allowed);
  learnSum(store_.linear(isUpper ? left : right), allowed);
}

/// Each term alone, from what the others leave of the sum.
void Bounds::learnSum(const LinearSum &sum, const Interval &allowed) {
  if (sum.terms.size() > kMostTerms)
    return;
  spend(10 * sum.terms.size() * sum.terms.size());
  for (const auto &[term, factor] : sum.terms) {
    Interval rest = subtract(allowed, around(sum.constant));
    for (const auto &[other, times] : sum.terms)
      if (other != term)
        rest = subtract(rest, multiply(around(times), of(other)));
    if (const auto bounds = divide(rest, around(factor)))
      restrict(term, *bounds);
  }
}

void Bounds::restrict(TermId term, const Interval &bounds) {
  const auto [known, isNew] = known_.try_emplace(term, bounds);
  const Interval before = known->second;
  if (!isNew)
    known->second = meet(before, bounds).value_or(before); // the formulas contradict each other
  if (isNew || !(known->second == before))
    computed_.clear();
}

Interval Bounds::of(TermId term) const { return of(term, 0); }

std::optional<bool> Bounds::truthOf(TermId formula) const { return truthOf(formula, 0); }

Interval Bounds::of(TermId term, int depth) const {
  if (const auto computed = computed_.find(term); computed != computed_.end())
    return computed->second;
  spend(5);
  return computed_.emplace(term, found(term, depth + 1)).first->second;
}

Interval Bounds::found(TermId id, int depth) const {
  const Term &term = store_[id];
  const auto known = known_.find(id);
  const Interval told = known == known_.end() ? Interval::all() : known->second;
  if (depth > kDeepestBound)
    return told;
  const auto within = [&](const Interval &found) { return meet(told, found).value_or(found); };
  switch (term.kind) {
  case TermKind::Number: return around(term.number);
  case TermKind::Add: {
    Interval sum = of(term.arguments[0], depth);
    for (std::size_t i = 1; i < term.arguments.size(); ++i)
      sum = add(sum, of(term.arguments[i], depth));
    return within(sum);
  }
  case TermKind::Multiply: {
    Interval product = of(term.arguments[0], depth);
    for (std::size_t i = 1; i < term.arguments.size(); ++i)
      product = multiply(product, of(term.arguments[i], depth));
    return within(isSquare(term) ? absolute(product) : product);
  }
  case TermKind::Ite: {
    const std::optional<bool> condition = truthOf(term.arguments[0], depth);
    if (condition)
      return within(of(term.arguments[*condition ? 1 : 2], depth));
    return within(join(of(term.arguments[1], depth), of(term.arguments[2], depth)));
  }
  case TermKind::Variable:
  case TermKind::Divide:
  case TermKind::Apply:
  case TermKind::True:
  case TermKind::False:
  case TermKind::Less:
  case TermKind::LessOrEqual:
  case TermKind::Equal:
  case TermKind::And:
  case TermKind::Or:
  case TermKind::Not: break;
  }
  return told;
}

std::optional<bool> Bounds::truthOf(TermId formula, int depth) const {
  const Term &term = store_[formula];
  if (depth > kDeepestBound)
    return std::nullopt;
  if (term.kind == TermKind::And || term.kind == TermKind::Or) {
    const bool deciding = term.kind == TermKind::Or;
    bool isKnown = true;
    for (const TermId part : term.arguments) {
      const std::optional<bool> known = truthOf(part, depth + 1);
      if (known == deciding)
        return deciding;
      isKnown = isKnown && known.has_value();
    }
    return isKnown ? std::optional(!deciding) : std::nullopt;
  }
  if (term.kind != TermKind::Less && term.kind != TermKind::LessOrEqual)
    return std::nullopt;
  const Interval left = of(term.arguments[0], depth), right = of(term.arguments[1], depth);
  if (left.hi < right.lo || (term.kind == TermKind::LessOrEqual && left.hi <= right.lo))
    return true;
  if (right.hi < left.lo || (term.kind == TermKind::Less && right.hi <= left.lo))
    return false;
  return std::nullopt;
}

} // namespace feedhold::smt
