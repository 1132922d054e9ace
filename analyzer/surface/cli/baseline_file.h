// Baseline files: `--baseline FILE`, read and written as JSON with one entry a line.
#pragma once

#include "findings/session/baseline.h"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

namespace feedhold {

struct BaselineOptions {
  std::string file; // empty: no baseline
  bool update = false;

  bool isAsked() const { return !file.empty(); }
};
/// `--baseline` and `--update-baseline`.
void addBaselineOptions(CLI::App &app, BaselineOptions &options);

/// The baseline that a run starts from: empty where none is asked for, or where it is not there and is about to be
/// written.  Absent: `complaint`, or that the file is not there, damaged or of a newer version, has been printed.
std::optional<Baseline> baselineToStart(const std::optional<std::string> &complaint, const BaselineOptions &options);

enum class UpdateTold : std::uint8_t { Yes, No };
/// Prints the problems of the run, writes the file and tells of it; returns the exit code.  A reader of the file sees
/// the old bytes or the new ones.
int updateBaselineFile(const Baseline &before, const Baseline &after, const BaselineOptions &options,
                       std::span<const PathProblem> problems, UpdateTold wanted);

/// The folder that its paths start from.
std::filesystem::path folderOf(const BaselineOptions &options);

/// For people: `3 old findings hidden by FILE`, and what is in it and no longer in the programs.
std::string told(const NewFindings &found, const BaselineOptions &options);
std::string told(const NewVerdicts &found, const BaselineOptions &options);

/// `feedhold: error: PATH: ..`, a line each.
void printProblems(std::span<const PathProblem> problems);

} // namespace feedhold
