// Suppressions: `(@ALLOW rule reason)` on a block, `(@ALLOW-PROGRAM rule reason)` for the program it stands in; in a
// file beside the program `@ALLOW rule reason`, with a place before the reason or for the whole program.
#pragma once

#include "findings/rule/registry.h"

#include <span>
#include <vector>

namespace feedhold {

/// The rule that says it of a suppression that holds back nothing.
inline constexpr std::string_view kUnusedSuppressionRule = "unused-suppression";

struct Suppression {
  ContractSourceId source = kProgramText; // the text in which it stands
  Span span;                              // the comment or the clause
  std::string rule = {};
  std::string reason = {};                    // may be empty: that is a finding of its own
  BlockId first{0};                           // a comment on a block of its own covers the next block that is not empty
  BlockId last{0};                            // is covered, too
  std::optional<ProgramId> wholeProgram = {}; // then the blocks do not matter
  std::string missing = {};                   // a place that is not there: "block N20 in O9100"
  bool used = false;
};

/// Those of the program, then those of the files beside it.
std::vector<Suppression> findSuppressions(const FileContext &context);

struct SuppressedFinding {
  RawFinding finding;
  std::string reason;
  ContractSourceId source; // in which it is allowed
};
/// What is wrong with a suppression in a file beside the program.
struct SidecarFinding {
  ContractSourceId source;
  RawFinding finding;
};

struct SuppressionResult {
  std::vector<RawFinding> kept; // with the findings about the suppressions of the program itself, in order
  std::vector<SuppressedFinding> suppressed;
  std::vector<SidecarFinding> ofSidecars;
};

/// Takes out what is suppressed and adds what is wrong with the suppressions: unused, unknown rule, no reason.
SuppressionResult applySuppressions(std::vector<RawFinding> findings, const FileContext &context,
                                    const RuleRegistry &registry, std::span<const Rule *const> selected);

} // namespace feedhold
