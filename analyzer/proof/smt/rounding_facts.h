// What is known of rounded numbers, as facts about the variables that stand for them (purify.h).
//
// Lemmas (Higham, "Accuracy and Stability of Numerical Algorithms", 2002, chapter 2; without overflow and underflow):
//   v = nearest(t):  |v - t| <= 2^-53 |t|;  v has the sign of t;  s <= t gives nearest(s) <= nearest(t);
//                    where |t| <= 2^e, |v - t| <= 2^(e-54);
//                    where t is a double, v = t;
//   v = nearest(a - b), a and b doubles, a/2 <= b <= 2a:  v = a - b (Sterbenz, "Floating-point computation", 1974);
//   v = nearest(sqrt(nearest(x * x))), x a double:  v = |x| (Boldo, "Stupid is as stupid does: taking the square root
//   of
//                    the square of a floating-point number", 2015);
//   v = near(t, h):  |v - t| <= h.
#pragma once

#include "proof/smt/bounds.h"
#include "proof/smt/deviations.h"

#include <span>
#include <utility>
#include <vector>

namespace feedhold::smt {

/// Facts about `rounded`, the double nearest to `exact`.
std::vector<TermId> nearestFacts(TermStore &store, const Bounds &bounds, TermId rounded, TermId exact);

/// Where the difference of two doubles is a double: of `rounded`, the double nearest to first - second.
std::optional<TermId> differenceFact(TermStore &store, const Bounds &bounds, TermId rounded, TermId first,
                                     TermId second);

/// Of the double `root` nearest to the square root of the double nearest to `argument`, which is compared with
/// `square`: the double nearest to base * base, or that product itself where the argument is it.
std::vector<TermId> rootFacts(TermStore &store, TermId root, TermId argument, TermId square, TermId base);

/// Facts about `value`, which is at most `distance` away from `exact`.
std::vector<TermId> nearFacts(TermStore &store, TermId value, TermId exact, TermId distance);

/// Numbers that were rounded keep their order: of two variables with what they are rounded from.
std::vector<TermId> orderFacts(TermStore &store, const Bounds &bounds, std::pair<TermId, TermId> first,
                               std::pair<TermId, TermId> second);

} // namespace feedhold::smt
