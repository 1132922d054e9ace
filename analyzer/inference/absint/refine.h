// Refine: what a condition says of the variables in it.
#pragma once

#include "inference/absint/abstract_interpretation.h"

namespace feedhold {

using AbstractContext = StepContext<AbstractInterpretation>;

/// Cuts the state down to the runs in which the condition holds, or does not; false when there is none.  What it says
/// of one variable is carried over to those at a known distance.
enum class Holds : std::uint8_t { No, Yes };
bool assume(AbstractContext &context, ExpressionId condition, Holds holds);

/// The value of the expression is rounded to this whole number; a vacant one counts as 0.
bool assumeRoundsTo(AbstractContext &context, ExpressionId expression, double number);
bool assumeDiffers(AbstractContext &context, ExpressionId expression, double value);

/// `a LT b` seen from b.
OperatorKind mirrored(OperatorKind op);

} // namespace feedhold
