// `#3=#4003 .. G#3`: modes that a program saves and restores.
#pragma once

#include "rules/motion/motion_view.h"

#include <vector>

namespace feedhold::rules {

/// `#3=#4003` at some place, and `G#3` at another.
struct Saving {
  std::uint8_t group;
  std::uint32_t variable;
  BlockId block;
  Span place;
};

/// The modal group whose code the expression reads, `#4003`.
std::optional<std::uint8_t> groupReadBy(ExpressionId value, const FileContext &context);

std::vector<Saving> savingsOf(ProgramId program, const FileContext &context);

/// The node executes a G code of the group that is written as a number.
bool setsGroup(const MotionView &view, NodeId node, std::uint8_t group);
/// `G#3`
bool restores(const MotionView &view, NodeId node, std::uint32_t variable);

} // namespace feedhold::rules
