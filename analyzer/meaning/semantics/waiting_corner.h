// Whether a line with `,C` or `,R` waits for the next one (corners.h).
#pragma once

#include "meaning/semantics/context.h"

namespace feedhold {

template <ValueAlgebra R> typename R::Truth waitsForLine(StepContext<R> &context) {
  R &interpretation = context.interpretation;
  const auto &corner = context.state.corner;
  return interpretation.negation(
      interpretation.both(interpretation.isVacant(corner.chamfer), interpretation.isVacant(corner.radius)));
}

} // namespace feedhold
