// What the calls in the checked files pass for an argument: whether the macro has to expect 0.
#pragma once

#include "rules/flow/flow_view.h"

#include <optional>

namespace feedhold::rules {

enum class PassedZero : std::uint8_t {
  NoCall,  // none of the checked programs calls this one
  Never,   // each call passes a number other than 0
  Maybe,   // some call passes 0, or a value that nothing checks, or does not pass the argument
  Unknown, // some caller is not analysed
};
struct PassedValues {
  PassedZero zero;
  std::optional<Label> call = {}; // of Maybe: the first such call
};
/// An argument that a caller passes on as it was passed to it is looked up in the calls of that caller.
PassedValues passedFor(std::uint32_t argument, const FlowFacts &facts, const FileContext &context);

/// `IF[#1GT3]GOTO90`, `GOTO#1`: an expression of one argument that has an upper bound, and neither a lower one nor a
/// test for vacant.
std::optional<std::uint32_t> checkedAboveOnly(const FlowFacts &facts, const FileContext &context, NodeId node,
                                              ExpressionId expression, const AbstractValue &value);

/// Adds to a finding about an unchecked argument where it comes from.
void addPassed(Diagnostic &diagnostic, const PassedValues &passed, const FlowFacts &facts);

} // namespace feedhold::rules
