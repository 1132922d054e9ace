// The radii of an arc at its two ends.
#pragma once

#include "meaning/semantics/algebra.h"

#include <array>

namespace feedhold::detail {

/// How far apart the lengths of two vectors are.  They differ by no more than the sizes along the axes do together
/// (triangle inequality), which is said, too, because proofs need no roots for it.
template <typename R> struct RadiiApart {
  typename R::Value alongAxes;
  typename R::Value difference;
  typename R::Value start, end; // the lengths

  typename R::Truth exceed(R &interpretation, const typename R::Value &tolerance) const {
    return interpretation.both(interpretation.compare(Relation::Greater, alongAxes, tolerance),
                               interpretation.compare(Relation::Greater, difference, tolerance));
  }
  typename R::Value larger(R &interpretation) const {
    return interpretation.select(interpretation.compare(Relation::Less, start, end), end, start);
  }
};

template <ValueAlgebra R>
RadiiApart<R> radiiApart(R &interpretation, const std::array<typename R::Value, 2> &from,
                         const std::array<typename R::Value, 2> &to) {
  using Value = typename R::Value;
  const auto sizeOf = [&](const Value &value) { return interpretation.function(FunctionKind::Abs, value); };
  const auto apart = [&](const Value &a, const Value &b) {
    return sizeOf(interpretation.subtract(sizeOf(a), sizeOf(b)));
  };
  const auto lengthOf = [&](const std::array<Value, 2> &vector) {
    const auto &[a, b] = vector;
    return interpretation.function(FunctionKind::Sqrt,
                                   interpretation.add(interpretation.multiply(a, a), interpretation.multiply(b, b)));
  };
  const Value alongAxes = interpretation.add(apart(from[0], to[0]), apart(from[1], to[1]));
  // The end before the start: in another order of terms a proof under rounding (corpus, O9217) runs out of steps.
  const Value end = lengthOf(to);
  const Value start = lengthOf(from);
  return {alongAxes, sizeOf(interpretation.subtract(start, end)), start, end};
}

} // namespace feedhold::detail
