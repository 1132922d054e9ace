// The result of a run of the concrete machine as text or JSON (docs/schemas/run.schema.json).
#pragma once

#include "meaning/machine/machine.h"

#include <span>
#include <string>
#include <vector>

namespace feedhold {

/// A block that was executed.
struct TracedBlock {
  Place place;
  std::size_t depth;       // calls that were open
  std::size_t movesBefore; // index of the first move that it made, or that came behind it
};

struct RunReport {
  const ProgramSet &programs;
  std::span<const std::string> shown; // paths by FileId
  Callee start;
  const RunResult &result;
  NumberModel numbers;                     // in which it was computed
  std::span<const TracedBlock> trace = {}; // empty: not asked for
};

std::string writeRunText(const RunReport &report);
std::string writeRunJson(const RunReport &report);

} // namespace feedhold
