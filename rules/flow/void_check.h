// Why a check that leads to an alarm can never raise it, as far as the text of the program gives a reason.
#pragma once

#include "rules/flow/flow_view.h"

#include <optional>
#include <string>

namespace feedhold::rules {

struct VoidReason {
  std::string note;
  std::optional<Label> label;
};

/// Of a test whose outcome, by the analysis, is never the one that leads to its alarm.  Absent: an earlier check
/// repeats it, or the reason is none that shows a mistake.
std::optional<VoidReason> whyVoid(const FlowFacts &facts, const FileContext &context, NodeId test,
                                  ExpressionId condition);

/// Of a decided test with a GOTO: blocks that for its sake no run comes to, where other checks and not the values of a
/// setting decide it.
std::optional<VoidReason> whatNeverRuns(const FlowFacts &facts, const FileContext &context, NodeId test,
                                        ExpressionId condition, Truth truth);

} // namespace feedhold::rules
