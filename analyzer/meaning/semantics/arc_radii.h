// The radii of an arc at its two ends.
#pragma once

#include "meaning/semantics/algebra.h"

#include <array>

namespace feedhold::detail {

/// Whether the lengths of two vectors differ by more than the tolerance.  They differ by no more than the sizes along
/// the axes do together (triangle inequality), which is said, too, because proofs need no roots for it.
template <ValueAlgebra R>
typename R::Truth lengthsDiffer(R &interpretation, const std::array<typename R::Value, 2> &from,
                                const std::array<typename R::Value, 2> &to, const typename R::Value &tolerance) {
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
  const Value difference = sizeOf(interpretation.subtract(lengthOf(from), lengthOf(to)));
  return interpretation.both(interpretation.compare(Relation::Greater, alongAxes, tolerance),
                             interpretation.compare(Relation::Greater, difference, tolerance));
}

} // namespace feedhold::detail
