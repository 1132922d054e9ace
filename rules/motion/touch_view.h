// What rules ask of skip moves: which one a place stands behind, and which axis a position is of.
#pragma once

#include "rules/motion/motion_view.h"

#include <optional>

namespace feedhold::rules {

/// The axis of `#5061` or `#5041`: tables of positions follow the axes from their last digit on.  Absent for other
/// variables, and for other axes than X, Y, Z.
std::optional<char> axisOfPosition(const FileContext &context, std::uint32_t variable);

/// The skip move from which every run comes to the place, with no other movement between.
std::optional<NodeId> skipBefore(const FlowFacts &facts, const MotionView &view, NodeId node);

} // namespace feedhold::rules
