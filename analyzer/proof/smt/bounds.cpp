#include "proof/smt/bounds.h"

#include "proof/smt/steps.h"

#include <algorithm>
#include <cmath>

namespace feedhold::smt {
namespace {

constexpr int kRounds = 3;
constexpr int kDeepestBound = 200;     // of a term: of what lies deeper only what is told is known
constexpr std::size_t kMostTerms = 12; // of a comparison that is learnt from
constexpr std::size_t kMostCases = 4;  // of a choice that is learnt from

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
  if (term.kind == TermKind::And)
    for (const TermId part : term.arguments)
      learn(store_[part]);
  else if (term.kind == TermKind::Or)
    learnChoice(term);
  else if (const auto told = allowedBy(term))
    learnAllowed(told->first, told->second);
}

void Bounds::learnAllowed(TermId sum, const Interval &allowed) {
  restrict(sum, allowed);
  learnSum(store_.linear(sum), allowed);
}

/// What is compared with a constant, and between which numbers it is then.
std::optional<std::pair<TermId, Interval>> Bounds::allowedBy(const Term &term) const {
  const bool isComparison =
      term.kind == TermKind::Less || term.kind == TermKind::LessOrEqual || term.kind == TermKind::Equal;
  if (!isComparison || store_.sort(term.arguments[0]) == Sort::Bool)
    return std::nullopt;
  const TermId left = term.arguments[0], right = term.arguments[1];
  const bool isUpper = store_.isNumber(right); // one side is a constant
  const Interval bound = around(store_[isUpper ? right : left].number);
  if (term.kind == TermKind::Equal)
    return std::pair(isUpper ? left : right, bound);
  return std::pair(isUpper ? left : right, isUpper ? Interval::atMost(bound.hi) : Interval::atLeast(bound.lo));
}

/// Of terms that every one of the cases bounds.
void Bounds::learnChoice(const Term &choice) {
  if (choice.arguments.size() > kMostCases)
    return;
  std::map<TermId, Interval> common = allowedIn(store_[choice.arguments.front()]);
  for (std::size_t i = 1; i < choice.arguments.size() && !common.empty(); ++i) {
    const std::map<TermId, Interval> next = allowedIn(store_[choice.arguments[i]]);
    std::erase_if(common, [&](const auto &each) { return !next.contains(each.first); });
    for (auto &[term, allowed] : common)
      allowed = join(allowed, next.at(term));
  }
  for (const auto &[term, allowed] : common)
    learnAllowed(term, allowed);
}

std::map<TermId, Interval> Bounds::allowedIn(const Term &one) const {
  std::map<TermId, Interval> allowed;
  const auto take = [&](const Term &part) {
    if (const auto told = allowedBy(part)) {
      const auto [known, isNew] = allowed.insert(*told);
      if (!isNew)
        known->second = meet(known->second, told->second).value_or(known->second);
    }
  };
  spend(5 + 5 * one.arguments.size());
  if (one.kind != TermKind::And)
    take(one);
  else
    for (const TermId part : one.arguments)
      take(store_[part]);
  return allowed;
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
    known->second = meet(before, bounds).value_or(bounds.isFinite() ? bounds : before); // they contradict each other
  if (isNew || !(known->second == before))
    computed_.clear();
  const Term &square = store_[term];
  if (square.kind == TermKind::Multiply && isSquare(square))
    if (const auto root = sqrt(Interval{0, std::max(0.0, known->second.hi)}); root && std::isfinite(root->hi))
      restrict(square.arguments[0], {-root->hi, root->hi});
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
