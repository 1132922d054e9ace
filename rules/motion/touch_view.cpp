#include "rules/motion/touch_view.h"

#include "rules/flow/definitions.h"
#include "rules/flow/system_variables.h"

#include <string_view>

namespace feedhold::rules {

std::optional<char> axisOfPosition(const FileContext &context, std::uint32_t variable) {
  constexpr std::string_view kAxes = "XYZ";
  constexpr std::uint32_t kTable = 20; // positions of one kind
  const std::uint32_t axis = (variable - 1) % kTable;
  return isPosition(roleOf(context, variable)) && axis < kAxes.size() ? std::optional(kAxes[axis]) : std::nullopt;
}

std::optional<NodeId> skipBefore(const FlowFacts &facts, const MotionView &view, NodeId node) {
  constexpr int kFarthest = 12;
  std::optional<NodeId> at = onlyPredecessor(facts, node);
  for (int i = 0; at && i < kFarthest; ++i) {
    if (view.mayDo(*at, {CodeAction::Skip}) && view.findAction(*at, {CodeAction::Skip}))
      return at;
    if (!view.axisWords(*at).empty())
      return std::nullopt;
    at = onlyPredecessor(facts, *at);
  }
  return std::nullopt;
}

} // namespace feedhold::rules
