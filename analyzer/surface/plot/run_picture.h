// Run pictures: a run of a program with the space of its contract, as a picture, and what there is to say of it.
#pragma once

#include "findings/project/project.h"
#include "surface/plot/plot_sink.h"

#include <span>
#include <string>
#include <vector>

namespace feedhold {

/// A run that is to be drawn.
struct PicturedRun {
  const Project &programs;
  Callee start;
  const RunOptions &options;
  const RunResult &result;
  std::string name; // for people
};

struct RunPicture {
  std::string svg;
  std::vector<std::string> notes;  // what stands below the title
  std::vector<std::string> gouges; // where the run breaks each clause on space most, the deepest first
};

/// Of one run, or of two over each other; gouges are those of the first.
RunPicture drawRuns(const std::string &title, std::span<const PicturedRun> runs);

/// `O9311`
std::string startedProgram(const PicturedRun &run);

} // namespace feedhold
