// RunInput: what sub-commands that execute a program are told on the command line.
#pragma once

#include "findings/project/project.h"
#include "meaning/machine/machine.h"
#include "proof/replay/example_run.h"
#include "surface/cli/shared_options.h"

#include <CLI/CLI.hpp>

#include <memory>
#include <string>
#include <vector>

namespace feedhold {

struct RunInput {
  std::string path;
  std::string program;
  std::vector<std::string> arguments;
  std::vector<std::string> variables;
  std::vector<std::string> offsets;
  std::vector<std::string> readings;
  std::vector<std::string> start;
  std::vector<std::string> modal;
  std::vector<std::string> switches;
  std::uint64_t fuel = RunOptions{}.fuel;
  ControlArguments control;
  std::string numbers; // empty: those of the dialect
  std::string missing = "stop";
  ConfigArguments config;
  bool blockSkip = false;
};

/// The options `--arg` and so on, and the file.
void addRunInput(CLI::App &app, RunInput &input);

struct PreparedRun {
  std::unique_ptr<const Project> programs;
  Callee start;
  RunOptions options;
};
Result<PreparedRun> prepareRun(const RunInput &input);

} // namespace feedhold
