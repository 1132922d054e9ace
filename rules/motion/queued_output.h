// Digital outputs of LinuxCNC: M62 to M65, and M66, which waits for an input.
#pragma once

#include "rules/motion/motion_view.h"

#include <optional>

namespace feedhold::rules {

/// `M63 P2`: an output that is switched by a code.
struct OutputCode {
  const Word *code;
  const Word *pin;
  bool isOn;     // M62, M64
  bool isQueued; // M62, M63: with the next motion
};
/// Absent: the block has no such code, or no P beside it.
std::optional<OutputCode> outputIn(BlockId block, const FileContext &context);

/// `M66 P1 L3 Q5`, with an L that waits: for a change, or for a state.
const Word *waitIn(BlockId block, const FileContext &context);

} // namespace feedhold::rules
