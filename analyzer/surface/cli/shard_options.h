// `--shard`, `--part` and `--costs`: a run of which each machine does a part.
#pragma once

#include "findings/session/part.h"

#include <CLI/CLI.hpp>

#include <optional>
#include <string>
#include <vector>

namespace feedhold {

struct ShardOptions {
  std::string shard; // `3/8`; empty: all files
  std::string part;  // file; empty: none is written
  std::vector<std::string> costs;
  const Answers *given = nullptr; // of the parts of this run, which are joined; null: none are

  bool isAsked() const { return !shard.empty() || !part.empty() || given != nullptr; }
};
void addShardOptions(CLI::App &app, ShardOptions &options);

/// What is wrong with the options; `other` names one that was given and does not go with them, or is empty.
std::optional<std::string> complaintAbout(const ShardOptions &options, const std::string &other);

/// The files of the shard as they are shown; absent: all.  Errors: a part with costs cannot be read.
Result<std::optional<std::set<std::string>>> filesOf(const ShardOptions &options, const CheckOptions &among,
                                                     const KnownNames &known);

/// Writes what the shard of a command has found, if that is asked for.
std::optional<Error> writePartOf(const ShardOptions &options, const CLI::App &command, const Answers &answers,
                                 FileCosts costs);

/// The solvers, where the results of a command name them.
std::string proverOfParts(const std::string &command);

/// This build of the program, as parts name it.
std::string toolOfParts();

/// The files and, of folders, all `*.part` in them.  Errors name the file.
Result<std::vector<RunPart>> readParts(const std::vector<std::string> &paths);

} // namespace feedhold
