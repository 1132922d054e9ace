// Certificate: a refutation in steps that exact arithmetic verifies.  No solver is needed.
#pragma once

#include "proof/check/problem.h"

#include <variant>

namespace feedhold::check {

/// multiplier * the product of hypotheses (>= 0 or > 0) * the squares of polynomials; the multiplier is >= 0.
struct Product {
  Number multiplier;
  std::vector<std::uint32_t> hypotheses;
  std::vector<Polynomial> squares;
  friend bool operator==(const Product &, const Product &) = default;
};
/// multiplier * a hypothesis (= 0)
struct EqualityUse {
  Polynomial multiplier;
  std::uint32_t hypothesis;
  friend bool operator==(const EqualityUse &, const EqualityUse &) = default;
};

/// The sum of all is, as a polynomial, a constant below 0; or 0, and one product has a positive multiplier, strict
/// hypotheses alone and no squares.  Both cannot be where all hypotheses hold.
struct Combination {
  std::vector<Product> products;
  std::vector<EqualityUse> equalities;
  friend bool operator==(const Combination &, const Combination &) = default;
};
/// One branch for each alternative, with its constraints as new hypotheses and its clauses as new clauses.
struct ClauseSplit {
  std::uint32_t clause;
  friend bool operator==(const ClauseSplit &, const ClauseSplit &) = default;
};
/// polynomial <= bound | polynomial >= bound + 1; whole coefficients, integer variables, a whole bound.
struct IntegerSplit {
  Polynomial polynomial;
  Number bound;
  friend bool operator==(const IntegerSplit &, const IntegerSplit &) = default;
};
/// polynomial >= 0 | polynomial < 0
struct SignSplit {
  Polynomial polynomial;
  friend bool operator==(const SignSplit &, const SignSplit &) = default;
};
/// A hypothesis over integer variables alone gives a stronger one: see `tightened`.
struct Tighten {
  std::uint32_t hypothesis;
  friend bool operator==(const Tighten &, const Tighten &) = default;
};

/// Hypotheses are numbered as they come: the constraints of the claim, then those that each step on the way adds;
/// clauses likewise.
struct Certificate {
  std::variant<Combination, ClauseSplit, IntegerSplit, SignSplit, Tighten> step;
  std::vector<Certificate> branches; ///< none, one for each alternative, 2, 2, 1
  friend bool operator==(const Certificate &, const Certificate &) = default;
};

/// Present when the certificate does not show that the claim is contradictory: the first step that fails.
std::optional<Error> verify(const UnsatProblem &claim, const Certificate &certificate);

/// With p = g * q + c, where q has whole coprime coefficients and no constant, and g > 0: q + floor(c / g) >= 0 follows
/// from p >= 0 and from p = 0, and q + ceiling(c / g) - 1 >= 0 from p > 0.  Absent when a variable is no integer or p
/// is a constant.
std::optional<Constraint> tightened(const UnsatProblem &claim, const Constraint &constraint);
/// The two sides of each split.
Constraint atMost(const Polynomial &polynomial, const Number &bound);
Constraint atLeast(const Polynomial &polynomial, const Number &bound);

std::string writeCertificate(const UnsatProblem &claim, const Certificate &certificate);
Result<Certificate> readCertificate(const UnsatProblem &claim, std::string_view text);

} // namespace feedhold::check
