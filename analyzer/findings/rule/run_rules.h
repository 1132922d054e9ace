// Running rules over one file: one walk over the tree, each rule called for what it asked to see.
#pragma once

#include "findings/rule/rule.h"

#include <span>
#include <vector>

namespace feedhold {

/// The order of findings: by place, then by rule name.
bool comesBefore(const RawFinding &a, const RawFinding &b);

/// Findings in order of place, then of rule name.
std::vector<RawFinding> runRules(std::span<const Rule *const> rules, const FileContext &context);

/// Of a file beside the program: only what rules say of its clauses.
std::vector<RawFinding> runContractRules(std::span<const Rule *const> rules, const FileContext &context);

} // namespace feedhold
