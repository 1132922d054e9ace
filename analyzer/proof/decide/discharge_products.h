// Products of hypotheses, equalities times monomials, squares: rows that follow, chosen where they say something new.
#pragma once

#include "proof/decide/discharge_rows.h"

#include <set>

namespace feedhold::prove {

struct ActiveHypothesis {
  std::uint32_t index;
  const check::Constraint *constraint;
};

/// How far products go.
struct ProductLimits {
  std::size_t degree;
  std::size_t factors; ///< hypotheses in one product, a square not counted; 1: two, one of them among the newest
};

/// Which products come first.  No order suits all claims, so that the search tries several for a while.
struct Strategy {
  enum class Order : std::uint8_t { NewestFirst, OldestFirst } order; ///< the newest stem from the goal
  std::size_t newest;                                                 ///< at first, one factor is among so many newest
  std::size_t squares;                                                ///< rows of squares added at once
};

class Products {
public:
  explicit Products(const Strategy &strategy) : strategy_(strategy) {}

  /// The rows that the point of `rows` breaks, a few, the most useful first: those without new monomials.  Of those
  /// that so much work finds.
  std::vector<Candidate> violated(const Rows &rows, const std::vector<ActiveHypothesis> &hypotheses,
                                  const ProductLimits &limits, std::uint64_t mostWork);
  std::uint64_t work() const { return work_; }

private:
  /// A polynomial and the numbers of its monomials.
  struct Known {
    Polynomial polynomial;
    std::vector<std::pair<std::uint32_t, double>> terms;
  };
  enum class Sign : std::uint8_t { Positive, Zero, Negative, NotClear };
  /// As smt::DeltaNumber.
  struct Near {
    double real, infinitesimal;
  };

  const Known &product(const ActiveHypothesis &left, const ActiveHypothesis &right);
  const Known &timesMonomial(const ActiveHypothesis &equality, const Monomial &factor);
  Known known(Polynomial polynomial);
  std::uint32_t numberOf(const Monomial &monomial);
  const Near &near(const Rows &rows, std::uint32_t monomial);
  double realOf(const Rows &rows, const Monomial &monomial) { return near(rows, numberOf(monomial)).real; }
  Sign sign(const Rows &rows, const Known &known);
  static bool mayBeViolated(Sign sign, check::Relation relation);
  void pairs(const Rows &rows, const std::vector<ActiveHypothesis> &hypotheses, const ProductLimits &limits);
  void triples(const Rows &rows, const std::vector<ActiveHypothesis> &hypotheses, const ProductLimits &limits);
  void equalities(const Rows &rows, const std::vector<ActiveHypothesis> &hypotheses, const ProductLimits &limits);
  void squares(const Rows &rows, const std::vector<ActiveHypothesis> &hypotheses, const ProductLimits &limits);
  void offer(const Rows &rows, RowSource source, const Known &known, check::Relation relation);
  void offer(const Rows &rows, Candidate candidate);
  /// The square of x - f*y, times a hypothesis; for the f that the point breaks most.
  void square(const Rows &rows, const Monomial &x, const Monomial &y, const ActiveHypothesis *by);
  bool mayBreakSquare(const Rows &rows, const Monomial &x, const Monomial &y);
  bool isSpent() const { return work_ >= mostWork_; }
  std::vector<ActiveHypothesis> inequalities(const std::vector<ActiveHypothesis> &hypotheses) const;

  const Strategy strategy_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, Known> pairs_;
  std::map<std::pair<std::uint32_t, Monomial>, Known> multiples_; ///< of equalities
  std::map<Monomial, std::uint32_t> numbers_;
  std::vector<const Monomial *> monomials_; ///< by number
  std::vector<std::optional<Near>> nearly_; ///< where they stand at the point in hand, rounded
  std::vector<std::pair<std::size_t, Candidate>> found_;
  std::uint64_t work_ = 0;
  std::uint64_t mostWork_ = 0;
};

} // namespace feedhold::prove
