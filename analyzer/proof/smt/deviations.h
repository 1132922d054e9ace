// Deviations: how far a rounded number may be from what it would be if nothing in it had been rounded.  The error of
// each operation, carried through those that follow (Goubault, Putot, "Static analysis of numerical algorithms", 2006).
#pragma once

#include "proof/smt/bounds.h"

#include <functional>
#include <map>
#include <optional>

namespace feedhold::smt {

struct Deviation {
  TermId exact; ///< nothing in it is rounded, but what a floor or a choice is made of
  double most;  ///< |term - exact| is at most this; infinite: not known
};

class Deviations {
public:
  /// `rangeOf`: between which numbers a term lies.
  Deviations(TermStore &store, std::function<Interval(TermId)> rangeOf) : store_(store), rangeOf_(std::move(rangeOf)) {}

  const Deviation &of(TermId term);

private:
  Interval rangeOf(TermId term);
  Deviation find(TermId term);
  Deviation ofSum(const std::vector<TermId> &terms);
  Deviation ofProduct(const std::vector<TermId> &factors);
  Deviation ofQuotient(TermId dividend, TermId divisor);
  std::optional<TermId> magnitudeIn(TermId choice);
  Deviation ofChoice(TermId term);
  Deviation ofFunction(TermId term);

  TermStore &store_;
  std::function<Interval(TermId)> rangeOf_;
  std::map<TermId, Deviation> known_;
};

/// Formulas that hold where the given ones do, about the numbers that there would be if nothing were rounded: what is
/// compared may differ by as much as the numbers deviate.
std::vector<TermId> withoutRounding(TermStore &store, std::span<const TermId> formulas,
                                    std::function<Interval(TermId)> rangeOf);

/// By how much rounding to the nearest double changes a number of the range at most.
double halfUnitOf(const Interval &range);

} // namespace feedhold::smt
