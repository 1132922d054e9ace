// The solver-free checker.  What it accepts counts as proved, so it is short and exact.
#include "base/support/match.h"
#include "proof/check/certificate.h"

#include <algorithm>

namespace feedhold::check {
namespace {

class Verifier {
public:
  explicit Verifier(const UnsatProblem &claim) : claim_(claim) {}

  std::optional<Error> verify(const Certificate &certificate) { return under(claim_.conjunction, certificate); }

private:
  using Failure = std::optional<Error>;

  Failure step(const Certificate &certificate) {
    const std::vector<Certificate> &branches = certificate.branches;
    return match(
        certificate.step, [&](const Combination &use) { return combination(use, branches); },
        [&](const ClauseSplit &split) { return clauseSplit(split, branches); },
        [&](const IntegerSplit &split) { return integerSplit(split, branches); },
        [&](const SignSplit &split) { return signSplit(split, branches); },
        [&](const Tighten &use) { return tighten(use, branches); });
  }

  /// The certificate with more hypotheses and clauses, which are forgotten afterwards.
  Failure under(const Conjunction &more, const Certificate &certificate) {
    const std::size_t hypotheses = hypotheses_.size(), clauses = clauses_.size();
    for (const Constraint &constraint : more.constraints)
      hypotheses_.push_back(constraint);
    for (const Clause &clause : more.clauses)
      clauses_.push_back(&clause);
    Failure failure = step(certificate);
    hypotheses_.resize(hypotheses);
    clauses_.resize(clauses);
    return failure;
  }

  Failure combination(const Combination &use, const std::vector<Certificate> &branches) {
    if (!branches.empty())
      return Error{"a combination has branches"};
    Polynomial sum;
    bool strict = false;
    for (const Product &product : use.products) {
      if (product.multiplier.sign() < 0)
        return Error{"a multiplier is negative"};
      Polynomial factors = constant(product.multiplier);
      bool productIsStrict = product.multiplier.sign() > 0 && product.squares.empty();
      for (std::uint32_t index : product.hypotheses) {
        if (index >= hypotheses_.size())
          return Error{"no such hypothesis"};
        if (hypotheses_[index].relation == Relation::Zero)
          return Error{"an equality stands in a product"};
        productIsStrict = productIsStrict && hypotheses_[index].relation == Relation::Positive;
        factors = multiply(factors, hypotheses_[index].polynomial);
      }
      for (const Polynomial &square : product.squares)
        factors = multiply(factors, multiply(square, square));
      addTo(sum, factors);
      strict = strict || productIsStrict;
    }
    for (const EqualityUse &equality : use.equalities) {
      if (equality.hypothesis >= hypotheses_.size())
        return Error{"no such hypothesis"};
      if (hypotheses_[equality.hypothesis].relation != Relation::Zero)
        return Error{"a free multiplier at an inequality"};
      addTo(sum, multiply(equality.multiplier, hypotheses_[equality.hypothesis].polynomial));
    }
    if (!isConstant(sum))
      return Error{"a combination does not cancel"};
    const int sign = constantOf(sum).sign();
    if (sign < 0 || (sign == 0 && strict))
      return std::nullopt;
    return Error{"a combination is no contradiction"};
  }

  Failure clauseSplit(const ClauseSplit &split, const std::vector<Certificate> &branches) {
    if (split.clause >= clauses_.size())
      return Error{"no such clause"};
    const Clause &clause = *clauses_[split.clause];
    if (branches.size() != clause.alternatives.size())
      return Error{"not one branch for each alternative"};
    for (std::size_t i = 0; i < branches.size(); ++i)
      if (Failure failure = under(clause.alternatives[i], branches[i]))
        return failure;
    return std::nullopt;
  }

  Failure integerSplit(const IntegerSplit &split, const std::vector<Certificate> &branches) {
    if (!split.bound.isInteger())
      return Error{"an integer split at a fraction"};
    for (const auto &[monomial, coefficient] : split.polynomial)
      if (!coefficient.isInteger() || !isInteger(claim_, monomial))
        return Error{"an integer split of what is no integer"};
    return twoBranches({atMost(split.polynomial, split.bound)}, {atLeast(split.polynomial, split.bound + 1)}, branches);
  }

  Failure signSplit(const SignSplit &split, const std::vector<Certificate> &branches) {
    return twoBranches({split.polynomial, Relation::NonNegative}, {scaled(split.polynomial, -1), Relation::Positive},
                       branches);
  }

  Failure tighten(const Tighten &use, const std::vector<Certificate> &branches) {
    if (use.hypothesis >= hypotheses_.size() || branches.size() != 1)
      return Error{"a tightening without its hypothesis or branch"};
    std::optional<Constraint> stronger = tightened(claim_, hypotheses_[use.hypothesis]);
    if (!stronger)
      return Error{"a tightening of what is no integer"};
    return under({{std::move(*stronger)}, {}}, branches[0]);
  }

  Failure twoBranches(Constraint first, Constraint second, const std::vector<Certificate> &branches) {
    if (branches.size() != 2)
      return Error{"a split without two branches"};
    if (Failure failure = under({{std::move(first)}, {}}, branches[0]))
      return failure;
    return under({{std::move(second)}, {}}, branches[1]);
  }

public:
  static bool isInteger(const UnsatProblem &claim, const Monomial &monomial) {
    return std::all_of(monomial.begin(), monomial.end(), [&](std::uint32_t index) {
      return index < claim.variables.size() && claim.variables[index].range == Range::Integer;
    });
  }

private:
  const UnsatProblem &claim_;
  std::vector<Constraint> hypotheses_;
  std::vector<const Clause *> clauses_;
};

} // namespace

std::optional<Error> verify(const UnsatProblem &claim, const Certificate &certificate) {
  return Verifier(claim).verify(certificate);
}

std::optional<Constraint> tightened(const UnsatProblem &claim, const Constraint &constraint) {
  Number denominators(1), numerators(0);
  for (const auto &[monomial, coefficient] : constraint.polynomial) {
    if (monomial.empty())
      continue;
    if (!Verifier::isInteger(claim, monomial))
      return std::nullopt;
    denominators = lcm(denominators, coefficient.denominator());
  }
  for (const auto &[monomial, coefficient] : constraint.polynomial)
    if (!monomial.empty())
      numerators = gcd(numerators, coefficient * denominators);
  if (numerators.isZero())
    return std::nullopt;
  Polynomial whole = scaled(constraint.polynomial, denominators / numerators);
  const Number rest = constantOf(whole);
  whole.erase(Monomial());
  const Number bound = constraint.relation == Relation::Positive ? ceiling(rest) - 1 : floor(rest);
  addTo(whole, constant(bound));
  return Constraint{std::move(whole), Relation::NonNegative};
}

Constraint atMost(const Polynomial &polynomial, const Number &bound) {
  Polynomial rest = constant(bound);
  addTo(rest, polynomial, -1);
  return {std::move(rest), Relation::NonNegative};
}

Constraint atLeast(const Polynomial &polynomial, const Number &bound) {
  Polynomial rest = polynomial;
  addTo(rest, constant(-bound));
  return {std::move(rest), Relation::NonNegative};
}

} // namespace feedhold::check
