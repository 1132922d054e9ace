// Bounds: between which numbers a term lies wherever some formulas hold, by interval arithmetic.
#pragma once

#include "inference/domain/interval.h"
#include "proof/smt/term.h"

#include <map>
#include <optional>
#include <span>
#include <utility>

namespace feedhold::smt {

/// The double that is nearest to the number, and its neighbours where it is none.
Interval around(const Number &value);

/// Intervals are rounded outwards: they hold for the exact value and for what it is rounded to (interval.h).
class Bounds {
public:
  /// From the comparisons among the formulas, in a few rounds: x + y <= 3 and y >= 1 give x <= 2.
  Bounds(const TermStore &store, std::span<const TermId> formulas);

  /// More, or the same again with what restrict() has told since.
  void learn(std::span<const TermId> formulas);
  /// Of a number.  Nothing is known of a quotient or a function but what restrict() was told.
  Interval of(TermId term) const;
  /// Of a formula that the bounds decide.
  std::optional<bool> truthOf(TermId formula) const;
  /// The term lies in the interval, too.
  void restrict(TermId term, const Interval &bounds);

private:
  Interval of(TermId term, int depth) const;
  Interval found(TermId term, int depth) const;
  std::optional<bool> truthOf(TermId formula, int depth) const;
  void learn(const Term &formula);
  void learnChoice(const Term &choice);
  void learnAllowed(TermId sum, const Interval &allowed);
  std::optional<std::pair<TermId, Interval>> allowedBy(const Term &comparison) const;
  std::map<TermId, Interval> allowedIn(const Term &one) const;
  void learnSum(const LinearSum &sum, const Interval &allowed);

  const TermStore &store_;
  std::map<TermId, Interval> known_;
  mutable std::map<TermId, Interval> computed_; // from these, until one of them changes
};

} // namespace feedhold::smt
