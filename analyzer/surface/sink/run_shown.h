// What the outputs of a run have in common: places in the text, variables worth showing.  Internal to sink/.
#pragma once

#include "surface/sink/run_sink.h"

#include <utility>

namespace feedhold {

inline BlockId blockAt(const RunReport &report, Place place) { return report.programs.node(place).block; }

inline std::uint32_t lineAt(const RunReport &report, Place place) {
  const ProgramFile &file = report.programs.file(place.file);
  return file.source->lineOf(file.tree->blocks[blockAt(report, place)].begin);
}

inline std::string programAt(const RunReport &report, FileId file, ProgramId program) {
  return toString(report.programs.file(file).model->programs[program].name);
}

/// The locals of the level at which the run ended that hold a value or stand in the program, then all others that were
/// given a value or lost it.  By name: `#1`, `#<depth>`.
std::vector<std::pair<std::string, ConcreteValue>> variablesOf(const RunReport &report);

/// Whether the numbers of the run are worth a word: others than doubles, or others than those of the control.
bool showsNumbers(const RunReport &report);

/// The axes whose coordinates are shown: X, Y and Z, and those of the others that ever left zero.
std::vector<Axis> axesOf(const RunReport &report);

} // namespace feedhold
