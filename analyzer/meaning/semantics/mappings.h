// Mirror, scaling and rotation, which give coordinates another meaning.
#pragma once

#include "language/dialect/dialect.h"

namespace feedhold {

/// A program that finds one in force is told of positions relative to it, and ends it with what was known of them
/// (leaveUnknownMappings): its code at the start has to be no certain one, since that is the program's own.
constexpr bool beginsMapping(CodeAction action) {
  return action == CodeAction::ScalingOn || action == CodeAction::MirrorOn || action == CodeAction::RotationOn;
}

} // namespace feedhold
