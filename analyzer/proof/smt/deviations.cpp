#include "proof/smt/deviations.h"

#include "proof/smt/steps.h"

#include <algorithm>
#include <cmath>

namespace feedhold::smt {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::infinity();

/// Sums and products of errors are rounded themselves: this is on the safe side of some hundred operations.
double roundedUp(double error) { return error * (1 + 0x1p-40); }

double sum(double a, double b) { return roundedUp(a + b); }
double product(double a, double b) { return a == 0 || b == 0 ? 0 : roundedUp(a * b); }
/// The least magnitude of a member.
double smallest(const Interval &range) { return range.lo > 0 ? range.lo : range.hi < 0 ? -range.hi : 0; }

} // namespace

double halfUnitOf(const Interval &range) {
  if (!range.isFinite())
    return kUnknown;
  int exponent = 0; // the largest magnitude is at most 2^exponent
  std::frexp(range.largest(), &exponent);
  return std::ldexp(1.0, std::max(exponent, -900) - 54);
}

const Deviation &Deviations::of(TermId term) {
  const auto known = known_.find(term);
  if (known != known_.end())
    return known->second;
  spend(20);
  const Deviation found = find(term);
  return known_.emplace(term, std::isfinite(found.most) ? found : Deviation{term, kUnknown}).first->second;
}

/// A difference of two rounded positions lies near that of the exact ones, however far each of them may be away.
Interval Deviations::rangeOf(TermId term) {
  const Interval told = rangeOf_(term);
  const Deviation from = of(term); // a copy: more are found
  if (from.exact == term || !std::isfinite(from.most))
    return told;
  return meet(told, add(rangeOf_(from.exact), {-from.most, from.most})).value_or(told);
}

Deviation Deviations::find(TermId id) {
  const Term term = store_[id]; // a copy: terms are made
  switch (term.kind) {
  case TermKind::Add: return ofSum(term.arguments);
  case TermKind::Multiply: return ofProduct(term.arguments);
  case TermKind::Divide: return ofQuotient(term.arguments[0], term.arguments[1]);
  case TermKind::Apply: return ofFunction(id);
  case TermKind::Ite: return ofChoice(id);
  case TermKind::Number:
  case TermKind::Variable:
  case TermKind::True:
  case TermKind::False:
  case TermKind::Less:
  case TermKind::LessOrEqual:
  case TermKind::Equal:
  case TermKind::And:
  case TermKind::Or:
  case TermKind::Not: break;
  }
  return {id, 0};
}

Deviation Deviations::ofSum(const std::vector<TermId> &terms) {
  std::vector<TermId> exact;
  double most = 0;
  for (const TermId term : terms) {
    const Deviation &each = of(term);
    exact.push_back(each.exact);
    most = sum(most, each.most);
  }
  return {store_.add(exact), most};
}

/// |ab - a'b'| <= |a| |b - b'| + |b'| |a - a'|
Deviation Deviations::ofProduct(const std::vector<TermId> &factors) {
  Deviation left = of(factors[0]);
  double magnitude = rangeOf(factors[0]).largest();
  for (std::size_t i = 1; i < factors.size(); ++i) {
    const Deviation right = of(factors[i]);
    const double other = rangeOf(factors[i]).largest();
    const double most = sum(product(magnitude, right.most), product(sum(other, right.most), left.most));
    left = {store_.multiply(left.exact, right.exact), most};
    magnitude = product(magnitude, other);
  }
  return left;
}

/// |a/b - a'/b'| <= (|a - a'| + |a/b| |b - b'|) / |b'|
Deviation Deviations::ofQuotient(TermId dividend, TermId divisor) {
  const Deviation above = of(dividend), below = of(divisor);
  const TermId exact = store_.divide(above.exact, below.exact);
  if (above.most == 0 && below.most == 0)
    return {exact, 0};
  const Interval range = rangeOf(divisor);
  const double least = smallest(range) * (1 - 0x1p-40) - below.most;
  if (!(least > 0))
    return {exact, kUnknown};
  const double quotient = roundedUp(rangeOf(dividend).largest() / smallest(range));
  return {exact, roundedUp(sum(above.most, product(quotient, below.most)) / least)};
}

/// `ite(0 < t, x, -x)` or `ite(t < 0, -x, x)`: |x|, where x is t, or t rounded, which has the sign of t.
std::optional<TermId> Deviations::magnitudeIn(TermId choice) {
  const std::vector<TermId> arguments = store_[choice].arguments; // a copy: terms are made
  const TermId zero = store_.number(Number(0));
  for (const bool isFirst : {true, false}) {
    const TermId x = arguments[isFirst ? 1 : 2];
    if (store_.negate(x) != arguments[isFirst ? 2 : 1])
      continue;
    const auto isSignOf = [&](TermId t) {
      const TermId low = isFirst ? zero : t, high = isFirst ? t : zero;
      return arguments[0] == store_.less(low, high) || arguments[0] == store_.lessOrEqual(low, high);
    };
    const Term &term = store_[x];
    const bool isRounded = term.kind == TermKind::Apply && term.function == Function::Nearest;
    const TermId unrounded = isRounded ? term.arguments[0] : x;
    if (isSignOf(x) || isSignOf(unrounded))
      return x;
  }
  return std::nullopt;
}

/// ||x| - |x'|| <= |x - x'|.  Of others, where rounding may decide which of the two is taken, as it is.
Deviation Deviations::ofChoice(TermId id) {
  if (const std::optional<TermId> x = magnitudeIn(id)) {
    const Deviation signedOne = of(*x);
    return {store_.absolute(signedOne.exact), signedOne.most};
  }
  const std::vector<TermId> arguments = store_[id].arguments;
  if (std::ranges::any_of(reachable(store_, std::span(&arguments[0], 1)),
                          [&](TermId part) { return isRounding(store_[part]); }))
    return {id, 0};
  const Deviation first = of(arguments[1]), second = of(arguments[2]);
  return {store_.ite(arguments[0], first.exact, second.exact), std::max(first.most, second.most)};
}

Deviation Deviations::ofFunction(TermId id) {
  const Term term = store_[id];
  const TermId argument = term.arguments[0];
  const Deviation inner = of(argument);
  switch (term.function) {
  case Function::Nearest: return {inner.exact, sum(inner.most, halfUnitOf(rangeOf(argument)))};
  case Function::Near: return {inner.exact, sum(inner.most, rangeOf_(term.arguments[1]).hi)};
  case Function::Sin:
  case Function::Cos: return {store_.apply(term.function, inner.exact), product(0.01746, inner.most)}; // pi / 180
  case Function::Sqrt: {
    // |sqrt(a) - sqrt(a')| = |a - a'| / (sqrt(a) + sqrt(a'))
    const double least = rangeOf(argument).lo;
    if (inner.most == 0 || !(least > inner.most))
      return {id, 0};
    return {store_.apply(term.function, inner.exact), roundedUp(inner.most / (std::sqrt(least) * (1 - 0x1p-40)))};
  }
  case Function::Floor:
  case Function::Tan:
  case Function::Asin:
  case Function::Acos:
  case Function::Atan2:
  case Function::Ln:
  case Function::Exp:
  case Function::Power:
  case Function::BitAnd:
  case Function::BitOr:
  case Function::BitXor: break;
  }
  return {id, 0}; // as it is
}

namespace {

class Weakening {
public:
  Weakening(TermStore &store, std::function<Interval(TermId)> rangeOf)
      : store_(store), deviations_(store, std::move(rangeOf)) {}

  TermId of(TermId formula) {
    const Term term = store_[formula]; // a copy: terms are made
    switch (term.kind) {
    case TermKind::And:
    case TermKind::Or: {
      std::vector<TermId> parts;
      for (const TermId part : term.arguments)
        parts.push_back(of(part));
      return term.kind == TermKind::And ? store_.logicalAnd(parts) : store_.logicalOr(parts);
    }
    case TermKind::Less:
    case TermKind::LessOrEqual: return comparison(formula, term);
    case TermKind::Equal: return store_.sort(term.arguments[0]) == Sort::Bool ? formula : equality(formula, term);
    case TermKind::Not: return denial(formula, term.arguments[0]);
    case TermKind::True:
    case TermKind::False:
    case TermKind::Number:
    case TermKind::Variable:
    case TermKind::Add:
    case TermKind::Multiply:
    case TermKind::Divide:
    case TermKind::Ite:
    case TermKind::Apply: return formula;
    }
    return formula;
  }

private:
  /// Of both sides, of which one is a constant.
  Deviation sides(const Term &term) {
    const Deviation left = deviations_.of(term.arguments[0]), right = deviations_.of(term.arguments[1]);
    return {store_.subtract(left.exact, right.exact), sum(left.most, right.most)};
  }
  /// The number or one just above it, with few digits: proofs over such numbers are much shorter.
  static Number shortAbove(const Number &value) {
    const Number grain = Number(std::int64_t{1} << 30);
    return (value * grain).isInteger() ? value : ceiling(value * grain) / grain;
  }
  /// x <= most, or x < most
  TermId atMost(TermId x, double most, TermKind kind) {
    LinearSum sum = store_.linear(x);
    const Number bound = shortAbove(Number::fromDouble(most) - sum.constant);
    sum.constant = Number(0);
    const TermId left = store_.fromLinear(sum);
    return kind == TermKind::Less ? store_.less(left, store_.number(bound))
                                  : store_.lessOrEqual(left, store_.number(bound));
  }
  TermId comparison(TermId formula, const Term &term) {
    const Deviation apart = sides(term);
    return std::isfinite(apart.most) ? atMost(apart.exact, apart.most, term.kind) : formula;
  }
  TermId equality(TermId formula, const Term &term) {
    const Deviation apart = sides(term);
    if (!std::isfinite(apart.most))
      return formula;
    if (apart.most == 0)
      return store_.equal(apart.exact, store_.number(Number(0)));
    return store_.logicalAnd(atMost(apart.exact, apart.most, TermKind::LessOrEqual),
                             atMost(store_.negate(apart.exact), apart.most, TermKind::LessOrEqual));
  }
  /// Numbers that differ may be equal but for rounding.
  TermId denial(TermId formula, TermId denied) {
    const Term inner = store_[denied]; // a copy: terms are made
    if (inner.kind != TermKind::Equal || store_.sort(inner.arguments[0]) == Sort::Bool)
      return formula;
    const Deviation apart = sides(inner);
    if (!std::isfinite(apart.most))
      return formula;
    return apart.most == 0 ? store_.notEqual(apart.exact, store_.number(Number(0))) : store_.yes();
  }

  TermStore &store_;
  Deviations deviations_;
};

} // namespace

std::vector<TermId> withoutRounding(TermStore &store, std::span<const TermId> formulas,
                                    std::function<Interval(TermId)> rangeOf) {
  Weakening weakening(store, std::move(rangeOf));
  std::vector<TermId> weaker;
  for (const TermId formula : formulas)
    weaker.push_back(weakening.of(formula));
  return weaker;
}

} // namespace feedhold::smt
