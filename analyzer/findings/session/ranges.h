// Ranges: what is known before the blocks of a program that has been loaded with its folder.
#pragma once

#include "findings/project/project.h"
#include "inference/absint/block_states.h"

namespace feedhold {

struct RangesOptions {
  /// Started there alone; absent: at each program of the file that none of its others calls.
  std::optional<std::string> program = std::nullopt;
  std::optional<std::uint32_t> line = std::nullopt; // absent: all lines
  /// Of which files blocks are told: the one that was named, or those of its folder that are called, too.
  enum class Files : std::uint8_t { First, All } files = Files::First;
};

/// Errors: no such program, no such line.
Result<BlockStates> rangesOf(const Project &programs, const RangesOptions &options);

} // namespace feedhold
