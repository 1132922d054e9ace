// Rows of the certificate search: each monomial counts as an unknown of its own, each row knows how a certificate
// writes it.
#pragma once

#include "proof/check/certificate.h"
#include "proof/smt/simplex.h"

#include <map>
#include <vector>

namespace feedhold::prove {

using check::Monomial;
using check::Number;
using check::Polynomial;
using smt::DeltaNumber;

/// A product of hypotheses and of the square of a polynomial; or an equality times a monomial.
struct RowSource {
  std::vector<std::uint32_t> hypotheses;
  std::vector<Polynomial> squares;
  std::optional<Monomial> multiplier; ///< present: of the one hypothesis, which is an equality
};

class Rows {
public:
  explicit Rows(std::size_t variables);

  void add(RowSource source, const Polynomial &polynomial, check::Relation relation);
  smt::Simplex::Status check(std::uint64_t workLimit) { return simplex_.check(workLimit); }
  /// After Infeasible: the contradiction.  Hypotheses as the sources name them.
  check::Combination contradiction() const;

  /// Where a monomial that no row has yet counts as the product of its variables.
  DeltaNumber value(const Polynomial &polynomial) const;
  DeltaNumber value(const Monomial &monomial) const;
  /// How many monomials no row has yet.
  std::size_t newMonomials(const Polynomial &polynomial) const;
  /// The variables, strict bounds included.
  std::vector<Number> point() const;
  /// The monomials of degree 2 that rows have.
  std::vector<Monomial> quadraticMonomials() const;
  /// Those that are not, at the point, the product of their factors; by how much.
  std::vector<std::pair<Monomial, Number>> brokenProducts(const std::vector<Number> &point) const;

  smt::Simplex::Mark mark() const { return simplex_.mark(); }
  void undo(smt::Simplex::Mark mark) { simplex_.undo(mark); }
  std::uint64_t work() const { return simplex_.work(); }

private:
  std::size_t variableCount_;
  smt::Simplex simplex_;
  std::map<Monomial, smt::Simplex::Column> columns_;
  std::vector<RowSource> sources_;
};

/// One `p >= 0`, `p > 0` or `p = 0` that follows from hypotheses by multiplication.
struct Candidate {
  RowSource source;
  Polynomial polynomial;
  check::Relation relation;
};
bool isViolated(const Rows &rows, const Candidate &candidate);

} // namespace feedhold::prove
