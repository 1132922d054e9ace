#include "proof/prove/discharge_products.h"

#include <algorithm>

namespace feedhold::prove {
namespace {

using check::Constraint;
using check::Relation;

constexpr std::size_t kRowsAtOnce = 12;
/// Combinations of more hypotheses than this grow too many; measured: the deep products that proofs need have few.
constexpr std::size_t kMostForTriples = 14;

bool isStrict(const Constraint &constraint) { return constraint.relation == Relation::Positive; }

Relation relationOf(bool strict) { return strict ? Relation::Positive : Relation::NonNegative; }

std::vector<ActiveHypothesis> only(const std::vector<ActiveHypothesis> &hypotheses, bool equalities) {
  std::vector<ActiveHypothesis> found;
  for (const ActiveHypothesis &hypothesis : hypotheses)
    if ((hypothesis.constraint->relation == Relation::Zero) == equalities &&
        !check::isConstant(hypothesis.constraint->polynomial))
      found.push_back(hypothesis);
  return found;
}

/// The monomials of the nonlinear part, and the variables in them: only those can cancel what a product brings in.
std::set<Monomial> multipliers(const std::vector<ActiveHypothesis> &hypotheses, std::size_t degree) {
  std::set<Monomial> found{Monomial()};
  for (const ActiveHypothesis &hypothesis : hypotheses) {
    for (const auto &[monomial, coefficient] : hypothesis.constraint->polynomial) {
      if (monomial.size() <= degree)
        found.insert(monomial);
      for (std::uint32_t index : monomial)
        found.insert(Monomial{index});
    }
  }
  return found;
}

/// A plain fraction near a value: certificates with small numbers are faster and easier to read.
Number plain(const Number &value, const Number &grain) { return smt::floor(value / grain + Number(1) / 2) * grain; }

} // namespace

std::vector<Candidate> Products::violated(const Rows &rows, const std::vector<ActiveHypothesis> &hypotheses,
                                          const ProductLimits &limits) {
  found_.clear();
  equalities(rows, hypotheses, limits);
  pairs(rows, hypotheses, limits);
  squares(rows, hypotheses, limits);
  if (limits.factors > 2)
    triples(rows, hypotheses, limits);
  std::stable_sort(found_.begin(), found_.end(), [](const auto &a, const auto &b) { return a.first < b.first; });
  std::vector<Candidate> chosen;
  std::size_t squares = 0;
  for (auto &[cost, candidate] : found_) {
    if (chosen.size() >= kRowsAtOnce || cost > found_.front().first + 1)
      break;
    if (!candidate.source.squares.empty() && ++squares > strategy_.squares)
      continue;
    chosen.push_back(std::move(candidate));
  }
  return chosen;
}

void Products::offer(const Rows &rows, Candidate candidate) {
  work_ += candidate.polynomial.size();
  if (isViolated(rows, candidate))
    found_.emplace_back(rows.newMonomials(candidate.polynomial), std::move(candidate));
}

std::vector<ActiveHypothesis> Products::inequalities(const std::vector<ActiveHypothesis> &hypotheses) const {
  std::vector<ActiveHypothesis> found = only(hypotheses, false);
  if (strategy_.order == Strategy::Order::NewestFirst)
    std::reverse(found.begin(), found.end());
  return found;
}

const Polynomial &Products::product(const ActiveHypothesis &left, const ActiveHypothesis &right) {
  auto [place, isNew] = known_.try_emplace({left.index, right.index});
  if (isNew) {
    place->second = check::multiply(left.constraint->polynomial, right.constraint->polynomial);
    work_ += left.constraint->polynomial.size() * right.constraint->polynomial.size() * 4;
  }
  return place->second;
}

void Products::pairs(const Rows &rows, const std::vector<ActiveHypothesis> &hypotheses, const ProductLimits &limits) {
  const std::vector<ActiveHypothesis> factors = inequalities(hypotheses);
  const std::size_t first = limits.factors == 1 ? std::min(strategy_.newest, factors.size()) : factors.size();
  for (std::size_t i = 0; i < first; ++i) {
    for (std::size_t j = i; j < factors.size(); ++j) {
      const Constraint &left = *factors[i].constraint, &right = *factors[j].constraint;
      if (check::degree(left.polynomial) + check::degree(right.polynomial) > limits.degree)
        continue;
      offer(rows, {{{factors[i].index, factors[j].index}, {}, {}},
                   product(factors[i], factors[j]),
                   relationOf(isStrict(left) && isStrict(right))});
    }
  }
}

void Products::triples(const Rows &rows, const std::vector<ActiveHypothesis> &hypotheses, const ProductLimits &limits) {
  const std::vector<ActiveHypothesis> factors = inequalities(hypotheses);
  if (factors.size() > kMostForTriples)
    return;
  for (std::size_t i = 0; i < factors.size(); ++i) {
    for (std::size_t j = i; j < factors.size(); ++j) {
      const Polynomial &pair = product(factors[i], factors[j]);
      for (std::size_t k = j; k < factors.size(); ++k) {
        const Polynomial &third = factors[k].constraint->polynomial;
        if (check::degree(pair) + check::degree(third) > limits.degree)
          continue;
        const bool strict =
            isStrict(*factors[i].constraint) && isStrict(*factors[j].constraint) && isStrict(*factors[k].constraint);
        work_ += pair.size() * third.size() * 4;
        offer(rows, {{{factors[i].index, factors[j].index, factors[k].index}, {}, {}},
                     check::multiply(pair, third),
                     relationOf(strict)});
      }
    }
  }
}

void Products::equalities(const Rows &rows, const std::vector<ActiveHypothesis> &hypotheses,
                          const ProductLimits &limits) {
  const std::set<Monomial> factors = multipliers(hypotheses, limits.degree - 1);
  for (const ActiveHypothesis &equality : only(hypotheses, true)) {
    const Polynomial &polynomial = equality.constraint->polynomial;
    for (const Monomial &factor : factors) {
      if (factor.empty() || check::degree(polynomial) + factor.size() > std::max<std::size_t>(limits.degree, 3))
        continue;
      work_ += polynomial.size() * 2;
      offer(rows, {{{equality.index}, {}, factor},
                   check::multiply(polynomial, Polynomial{{factor, Number(1)}}),
                   Relation::Zero});
    }
  }
}

/// Where the point has x*x < 0, or x*x * y*y < (x*y)^2: the square of x - f*y, for the f that is broken most.  With y =
/// 1 this is the tangent of the parabola.  Deeper: the same, times a hypothesis.
void Products::squares(const Rows &rows, const std::vector<ActiveHypothesis> &hypotheses, const ProductLimits &limits) {
  std::set<Monomial> bases{Monomial()};
  for (const Monomial &monomial : rows.quadraticMonomials())
    for (std::uint32_t index : monomial)
      bases.insert(Monomial{index});
  auto square = [&](const Monomial &x, const Monomial &y, const std::vector<std::uint32_t> &by,
                    const Polynomial &factor) {
    auto moment = [&](const Monomial &a, const Monomial &b) {
      Polynomial product = check::multiply(factor, Polynomial{{check::multiply(a, b), Number(1)}});
      work_ += product.size() + 1;
      return rows.value(product).real;
    };
    const Number yy = moment(y, y), xy = moment(x, y), xx = moment(x, x);
    Polynomial base{{x, Number(1)}};
    if (xx.sign() >= 0) {
      if (xy.isZero() || xx * yy >= xy * xy)
        return;
      const Number best = yy.sign() > 0 ? xy / yy : (xx + 1) / (xy * 2);
      Number share;
      bool breaks = false;
      for (const Number &grain : {Number(1), Number(1) / 16, Number(1) / 1024}) {
        share = plain(best, grain);
        breaks = (xx - share * xy * 2 + share * share * yy).sign() < 0;
        if (breaks)
          break;
      }
      if (!breaks)
        return;
      check::addTo(base, Polynomial{{y, Number(1)}}, -share);
    }
    offer(rows, {{by, {base}, {}}, check::multiply(factor, check::multiply(base, base)), Relation::NonNegative});
  };
  std::vector<ActiveHypothesis> factors;
  if (limits.factors > 2)
    factors = inequalities(hypotheses);
  for (const Monomial &x : bases) {
    for (const Monomial &y : bases) {
      if (x == y || x.empty())
        continue;
      square(x, y, {}, check::constant(1));
      for (const ActiveHypothesis &hypothesis : factors)
        if (check::degree(hypothesis.constraint->polynomial) + 2 <= limits.degree && factors.size() <= kMostForTriples)
          square(x, y, {hypothesis.index}, hypothesis.constraint->polynomial);
    }
  }
}

} // namespace feedhold::prove
