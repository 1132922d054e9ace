// Project: files that belong together, each parsed and resolved once, with the calls between them.  loadProject()
// serves every command and the server.
#pragma once

#include "findings/project/file_store.h"
#include "findings/project/machine_settings.h"
#include "findings/project/missing_contracts.h"
#include "findings/project/workload.h"
#include "meaning/cfg/program_set.h"

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace feedhold {

struct Project {
  std::vector<std::shared_ptr<const ProjectFile>> files; // by FileId
  CallGraph callGraph;
  std::vector<InferredSetting> inferred = {};
  MissingContracts missingContracts = {}; // of a project of one program with its folder
  std::optional<ProgramSet> set;          // with control flow graphs; absent: calls alone were asked for

  const ProjectFile &file(FileId id) const { return *files[id.index()]; }
  /// Of the first file.
  const Dialect &dialect() const { return *files.front()->dialect; }
  /// By FileId.
  std::vector<const FileContracts *> contracts() const;
};

// ---- the files of a run, each for its own control ----

enum class LoadGraphs : std::uint8_t { No, Yes };    // of control flow
enum class InferMachines : std::uint8_t { No, Yes }; // for rules alone: see machine_settings.h

struct LoadOptions {
  LoadGraphs graphs = LoadGraphs::Yes;
  InferMachines infer = InferMachines::No;
  unsigned jobs = 0;
  std::shared_ptr<const OpenTexts> open = {}; // of editors
};

/// The index of an item is its FileId.  A file in a language that is not read has no blocks.
Project loadProject(std::span<const WorkItem> items, const LoadOptions &options);

// ---- one program with its folder, all for the control of the first file ----

struct ProgramOptions {
  std::string path;
  std::optional<PipedText> piped = std::nullopt; // instead of `path`; such a program sees no folder
  ControlOptions control = {};
  ConfigOptions config = {};
  std::shared_ptr<const OpenTexts> open = {}; // of editors
  /// Whether its folder is read too when it calls nothing: to see who calls it.
  enum class Folder : std::uint8_t { WhenItCalls, Always } folder = Folder::WhenItCalls;
  FileStore *store = nullptr; // null: every file is read
};

/// The first file is the one that was named; then come those of its folder, by name.  The error names the file or the
/// configuration that refuses.  Files of the folder that are no programs are left out.
Result<std::unique_ptr<const Project>> loadProject(const ProgramOptions &options, const KnownNames &known);
/// The same for a file that has been found; `path`, `piped`, `control` and `config` of the options are not asked again.
std::unique_ptr<const Project> loadProject(const WorkItem &item, const ProgramOptions &options,
                                           const KnownNames &known);

/// Where a run of the first file starts: at its first program that is no subroutine, or at the one of this name
/// (`O1234`, `1234`, `NAME`, `o<name>`).  Absent when there is none.
std::optional<Callee> startOf(const Project &project, const std::optional<std::string> &name);

} // namespace feedhold
