// The least input increment: the step of coordinates, of ROUND in a word, and of numbers without a decimal point.
#pragma once

#include "meaning/semantics/context.h"

namespace feedhold {

template <ValueAlgebra R> typename R::Truth isMetric(StepContext<R> &context) {
  return context.inForce(ModalKind::Units, {CodeAction::Metric}, context.interpretation.truth(true));
}

/// `make` of the increment of an address in the units in force; angles have the metric one.
template <ValueAlgebra R, typename Make>
typename R::Value byIncrement(StepContext<R> &context, AddressKind kind, Make &&make) {
  const LeastIncrements increments = leastIncrementsOf(context.dialect());
  if (kind == AddressKind::Angle)
    return make(increments.metric);
  const auto metric = isMetric(context);
  if (context.certain(metric))
    return make(increments.metric);
  if (!context.interpretation.mayBe(metric))
    return make(increments.inch);
  return context.interpretation.select(metric, make(increments.metric), make(increments.inch));
}

} // namespace feedhold
