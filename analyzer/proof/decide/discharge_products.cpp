#include "proof/decide/discharge_products.h"

#include "proof/smt/steps.h"

#include <algorithm>
#include <cmath>

namespace feedhold::prove {
namespace {

using check::Constraint;
using check::Relation;

constexpr std::size_t kRowsAtOnce = 12;
/// Combinations of more hypotheses than this grow too many; measured: the deep products that proofs need have few.
constexpr std::size_t kMostForTriples = 14;
/// What doubles may be off by, of the size of a sum: far more than they are.
constexpr double kRounding = 1e-9;

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
                                          const ProductLimits &limits, std::uint64_t mostWork) {
  mostWork_ = work_ + mostWork;
  found_.clear();
  nearly_.assign(monomials_.size(), std::nullopt);
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

std::uint32_t Products::numberOf(const Monomial &monomial) {
  const auto [known, isNew] = numbers_.try_emplace(monomial, static_cast<std::uint32_t>(monomials_.size()));
  if (isNew) {
    monomials_.push_back(&known->first);
    nearly_.emplace_back();
  }
  return known->second;
}

Products::Known Products::known(Polynomial polynomial) {
  Known known{std::move(polynomial), {}};
  for (const auto &[monomial, coefficient] : known.polynomial)
    known.terms.emplace_back(numberOf(monomial), coefficient.toDouble());
  return known;
}

const Products::Near &Products::near(const Rows &rows, std::uint32_t monomial) {
  std::optional<Near> &value = nearly_[monomial];
  if (!value) {
    const DeltaNumber exact = rows.value(*monomials_[monomial]);
    value = {exact.real.toDouble(), exact.infinitesimal.isZero() ? 0 : exact.infinitesimal.toDouble()};
  }
  return *value;
}

/// By doubles: most rows are far from being broken, and need no exact arithmetic to say so.
Products::Sign Products::sign(const Rows &rows, const Known &known) {
  Near sum{0, 0}, size{0, 0};
  for (const auto &[monomial, coefficient] : known.terms) {
    const Near &value = near(rows, monomial);
    sum.real += coefficient * value.real;
    size.real += std::abs(coefficient * value.real);
    sum.infinitesimal += coefficient * value.infinitesimal;
    size.infinitesimal += std::abs(coefficient * value.infinitesimal);
  }
  const auto signOf = [](double total, double of) {
    if (of == 0)
      return Sign::Zero;
    if (!(std::abs(total) > of * kRounding))
      return Sign::NotClear;
    return total > 0 ? Sign::Positive : Sign::Negative;
  };
  const Sign real = signOf(sum.real, size.real);
  return real == Sign::Zero ? signOf(sum.infinitesimal, size.infinitesimal) : real;
}

bool Products::mayBeViolated(Sign sign, Relation relation) {
  switch (relation) {
  case Relation::NonNegative: return sign == Sign::Negative || sign == Sign::NotClear;
  case Relation::Positive: return sign != Sign::Positive;
  case Relation::Zero: return sign != Sign::Zero;
  }
  return true;
}

void Products::offer(const Rows &rows, RowSource source, const Known &known, Relation relation) {
  work_ += known.polynomial.size();
  smt::spend(5 + 3 * known.polynomial.size());
  const Sign clear = sign(rows, known);
  if (!mayBeViolated(clear, relation))
    return;
  Candidate candidate{std::move(source), known.polynomial, relation};
  if (clear != Sign::NotClear || isViolated(rows, candidate))
    found_.emplace_back(rows.newMonomials(candidate.polynomial), std::move(candidate));
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

const Products::Known &Products::product(const ActiveHypothesis &left, const ActiveHypothesis &right) {
  auto [place, isNew] = pairs_.try_emplace({left.index, right.index});
  if (isNew) {
    place->second = known(check::multiply(left.constraint->polynomial, right.constraint->polynomial));
    work_ += left.constraint->polynomial.size() * right.constraint->polynomial.size() * 4;
  }
  return place->second;
}

const Products::Known &Products::timesMonomial(const ActiveHypothesis &equality, const Monomial &factor) {
  auto [place, isNew] = multiples_.try_emplace({equality.index, factor});
  if (isNew)
    place->second = known(check::multiply(equality.constraint->polynomial, Polynomial{{factor, Number(1)}}));
  work_ += equality.constraint->polynomial.size() * 2;
  return place->second;
}

void Products::pairs(const Rows &rows, const std::vector<ActiveHypothesis> &hypotheses, const ProductLimits &limits) {
  const std::vector<ActiveHypothesis> factors = inequalities(hypotheses);
  const std::size_t first = limits.factors == 1 ? std::min(strategy_.newest, factors.size()) : factors.size();
  for (std::size_t i = 0; i < first; ++i) {
    for (std::size_t j = i; j < factors.size() && !isSpent(); ++j) {
      const Constraint &left = *factors[i].constraint, &right = *factors[j].constraint;
      if (check::degree(left.polynomial) + check::degree(right.polynomial) > limits.degree)
        continue;
      const Known &pair = product(factors[i], factors[j]);
      offer(rows, {{factors[i].index, factors[j].index}, {}, {}}, pair, relationOf(isStrict(left) && isStrict(right)));
    }
  }
}

void Products::triples(const Rows &rows, const std::vector<ActiveHypothesis> &hypotheses, const ProductLimits &limits) {
  const std::vector<ActiveHypothesis> factors = inequalities(hypotheses);
  if (factors.size() > kMostForTriples)
    return;
  for (std::size_t i = 0; i < factors.size(); ++i) {
    for (std::size_t j = i; j < factors.size() && !isSpent(); ++j) {
      const Polynomial &pair = product(factors[i], factors[j]).polynomial;
      for (std::size_t k = j; k < factors.size(); ++k) {
        const Polynomial &third = factors[k].constraint->polynomial;
        if (check::degree(pair) + check::degree(third) > limits.degree)
          continue;
        const bool strict =
            isStrict(*factors[i].constraint) && isStrict(*factors[j].constraint) && isStrict(*factors[k].constraint);
        work_ += pair.size() * third.size() * 4;
        Polynomial product = check::multiply(pair, third);
        offer(
            rows,
            {{{factors[i].index, factors[j].index, factors[k].index}, {}, {}}, std::move(product), relationOf(strict)});
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
      if (isSpent())
        return;
      if (factor.empty() || check::degree(polynomial) + factor.size() > std::max<std::size_t>(limits.degree, 3))
        continue;
      const Known &product = timesMonomial(equality, factor);
      offer(rows, {{equality.index}, {}, factor}, product, Relation::Zero);
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
  std::vector<ActiveHypothesis> factors;
  if (limits.factors > 2)
    factors = inequalities(hypotheses);
  if (factors.size() > kMostForTriples)
    factors.clear();
  for (const Monomial &x : bases) {
    for (const Monomial &y : bases) {
      if (isSpent())
        return;
      if (x == y || x.empty())
        continue;
      if (mayBreakSquare(rows, x, y))
        square(rows, x, y, nullptr);
      for (const ActiveHypothesis &hypothesis : factors)
        if (check::degree(hypothesis.constraint->polynomial) + 2 <= limits.degree)
          square(rows, x, y, &hypothesis);
    }
  }
}

/// By doubles, as above.
bool Products::mayBreakSquare(const Rows &rows, const Monomial &x, const Monomial &y) {
  constexpr std::uint64_t kWork = 6;
  work_ += kWork;
  smt::spend(20 * kWork);
  const auto moment = [&](const Monomial &a, const Monomial &b) { return realOf(rows, check::multiply(a, b)); };
  const double yy = moment(y, y), xy = moment(x, y), xx = moment(x, x);
  const double both = xx * yy, mixed = xy * xy;
  return !(xx > 0 && both - mixed > kRounding * (std::abs(both) + mixed));
}

void Products::square(const Rows &rows, const Monomial &x, const Monomial &y, const ActiveHypothesis *by) {
  const Polynomial factor = by ? by->constraint->polynomial : check::constant(1);
  auto moment = [&](const Monomial &a, const Monomial &b) {
    const Polynomial product = check::multiply(factor, Polynomial{{check::multiply(a, b), Number(1)}});
    work_ += by ? product.size() + 1 : 0;
    smt::spend(20);
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
  const std::vector<std::uint32_t> hypotheses = by ? std::vector{by->index} : std::vector<std::uint32_t>{};
  // Not within the braces: when the steps run out there, GCC 12 destroys what they have made so far twice.
  Polynomial square = check::multiply(factor, check::multiply(base, base));
  offer(rows, {{hypotheses, {base}, {}}, std::move(square), Relation::NonNegative});
}

} // namespace feedhold::prove
