// Variables whose number the program computes, where the analysis knows what it comes to.
#pragma once

#include "findings/rule/flow_path.h"
#include "findings/rule/rule.h"

#include <vector>

namespace feedhold::rules {

struct ComputedNumber {
  Span place; // `#[#1+20]`
  NodeId node;
  bool isWritten;
  bool isNegative = false;            // in all runs
  std::vector<std::uint32_t> numbers; // the few that are possible; none where it is negative
};
/// In the blocks that are reached.
std::vector<ComputedNumber> computedNumbersOf(const FlowFacts &facts);

} // namespace feedhold::rules
