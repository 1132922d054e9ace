// Which loops are entered by jumps from outside, and at which labels.
#pragma once

#include "meaning/cfg/cfg.h"

#include <vector>

namespace feedhold {

/// A label inside a loop to which some jump from outside of the loop may lead.
struct LoopEntrance {
  BlockId label;
  std::size_t loop; // index in ProgramModel::loops
};

/// Of one program; by label, outer loops first.
std::vector<LoopEntrance> loopEntrances(const ProgramModel &model, ProgramId program, const Dialect &dialect,
                                        const ReturnTargets &returns);

/// The number of a loop that the control takes: 1 to the last one of the dialect.
std::optional<std::uint8_t> usableNumber(const std::optional<std::uint32_t> &number, const Dialect &dialect);

} // namespace feedhold
