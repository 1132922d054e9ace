// The options that several commands have, so that they mean and say the same everywhere.
#pragma once

#include "findings/project/config_finder.h"
#include "findings/project/control_options.h"

#include <CLI/CLI.hpp>

#include <optional>
#include <string>
#include <vector>

namespace feedhold {

/// `--dialect`, `--increment-system` and `--g-code-system`: empty when they are not given.
struct ControlArguments {
  std::string dialect;
  std::string incrementSystem;
  std::string gCodeSystem;
};
void addControl(CLI::App &app, ControlArguments &arguments);
/// Why there is no such control; absent when there is.
std::optional<std::string> complaintAbout(const ControlArguments &arguments);
ControlOptions controlFrom(const ControlArguments &arguments);

/// `--config` and `--isolated`.
struct ConfigArguments {
  std::string file;
  bool isolated = false;
};
void addConfiguration(CLI::App &app, ConfigArguments &arguments);
ConfigOptions configFrom(const ConfigArguments &arguments);

/// `--format`; `format` holds the default.
void addFormat(CLI::App &app, std::string &format, const std::vector<std::string> &known);

/// `--jobs`: 0 is one thread for each processor.
void addJobs(CLI::App &app, unsigned &jobs);

/// `--color`; `when` holds the default.
void addColor(CLI::App &app, std::string &when);

/// `-q` and `--quiet`; `meaning` is what the command still prints, or no longer prints.
void addQuiet(CLI::App &app, bool &quiet, const std::string &meaning = "print no summary and no skipped files");

/// `--stdin-filename`; `path` holds the default.
void addStdinFilename(CLI::App &app, std::string &path);

/// `--cache-dir`, `--cache-url` and `--no-cache`.
struct CacheArguments {
  std::string folder;
  std::string url;
  bool off = false;
};
void addCache(CLI::App &app, CacheArguments &arguments);

} // namespace feedhold
