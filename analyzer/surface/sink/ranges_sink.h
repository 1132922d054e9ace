// What is known before each block of a program, as text or JSON (docs/schemas/ranges.schema.json).
#pragma once

#include "inference/absint/block_states.h"

#include <optional>
#include <span>
#include <string>

namespace feedhold {

struct RangesReport {
  const ProgramSet &programs;
  std::span<const std::string> shown; // paths by FileId
  const BlockStates &states;
  std::optional<std::uint32_t> line = std::nullopt; // the one that is asked for; absent: all
};

/// Of all lines: before each block what differs from what is told of the block above it.
std::string writeRangesText(const RangesReport &report);
/// Of each block all that is known.
std::string writeRangesJson(const RangesReport &report);

} // namespace feedhold
