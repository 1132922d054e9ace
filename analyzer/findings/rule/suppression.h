// Suppressions: `(@ALLOW rule reason)` on a block, `(@ALLOW-PROGRAM rule reason)` for the program it stands in.
#pragma once

#include "findings/rule/registry.h"

#include <span>
#include <vector>

namespace feedhold {

struct Suppression {
  Span span; // the comment
  std::string rule;
  std::string reason; // may be empty: that is a finding of its own
  BlockId block;      // on a block of its own it covers the next block that is not empty
  bool wholeProgram = false;
  bool used = false;
};

std::vector<Suppression> findSuppressions(const FileContext &context);

struct SuppressionResult {
  std::vector<RawFinding> kept; // with the findings about the suppressions themselves, in order
  std::vector<RawFinding> suppressed;
};

/// Takes out what is suppressed and adds what is wrong with the suppressions: unused, unknown rule, no reason.
SuppressionResult applySuppressions(std::vector<RawFinding> findings, const FileContext &context,
                                    const RuleRegistry &registry, std::span<const Rule *const> selected);

} // namespace feedhold
