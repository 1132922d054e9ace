// Products of hypotheses, equalities times monomials, squares: rows that follow, chosen where they say something new.
#pragma once

#include "proof/prove/discharge_rows.h"

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

  /// The rows that the point of `rows` breaks, a few, the most useful first: those without new monomials.
  std::vector<Candidate> violated(const Rows &rows, const std::vector<ActiveHypothesis> &hypotheses,
                                  const ProductLimits &limits);
  std::uint64_t work() const { return work_; }

private:
  const Polynomial &product(const ActiveHypothesis &left, const ActiveHypothesis &right);
  void pairs(const Rows &rows, const std::vector<ActiveHypothesis> &hypotheses, const ProductLimits &limits);
  void triples(const Rows &rows, const std::vector<ActiveHypothesis> &hypotheses, const ProductLimits &limits);
  void equalities(const Rows &rows, const std::vector<ActiveHypothesis> &hypotheses, const ProductLimits &limits);
  void squares(const Rows &rows, const std::vector<ActiveHypothesis> &hypotheses, const ProductLimits &limits);
  void offer(const Rows &rows, Candidate candidate);
  std::vector<ActiveHypothesis> inequalities(const std::vector<ActiveHypothesis> &hypotheses) const;

  const Strategy strategy_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, Polynomial> known_;
  std::vector<std::pair<std::size_t, Candidate>> found_;
  std::uint64_t work_ = 0;
};

} // namespace feedhold::prove
