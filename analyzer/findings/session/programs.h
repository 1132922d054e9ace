// Programs: one file and those of its folder that it may call, from their texts to a ProgramSet.
#pragma once

#include "findings/session/workload.h"
#include "language/contract/contract.h"
#include "meaning/cfg/program_set.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace feedhold {

class FileMemory;

struct ProgramsWish {
  std::string path;
  std::optional<PipedText> piped = std::nullopt; // instead of `path`; such a program sees no folder
  std::optional<std::string> dialect = std::nullopt;
  ConfigWish config = {};
  std::shared_ptr<const OpenTexts> open = {}; // of editors
  /// Whether its folder is read too when it calls nothing: to see who calls it.
  enum class Folder : std::uint8_t { WhenItCalls, Always } folder = Folder::WhenItCalls;
  FileMemory *memory = nullptr; // of an editor's server, which has `open`, too; null: every file is read
};

/// One file, from its text to its model.
struct LoadedFile {
  std::string shown;
  std::filesystem::path path; // empty for a piped text
  SourceFile source;
  SyntaxTree tree;
  ProgramModel model;
  FileContracts contracts; // with those of the files beside it
};

/// All files are read for the control of the first one, with its switches.
struct LoadedPrograms {
  Dialect dialect;
  std::vector<std::shared_ptr<const LoadedFile>> files; // by FileId: the one that was named, then its folder by name
  std::optional<ProgramSet> set;

  const LoadedFile &file(FileId id) const { return *files[id.index()]; }
};

/// The error names the file or the configuration that refuses.  Files of the folder that are no programs are left out.
Result<std::unique_ptr<const LoadedPrograms>> loadPrograms(const ProgramsWish &wish, const KnownNames &known);

/// Where a run of the first file starts: at its first program that is no subroutine, or at the one of this name
/// (`O1234`, `1234`, `NAME`).  Absent when there is none.
std::optional<Callee> startOf(const LoadedPrograms &programs, const std::optional<std::string> &name);

} // namespace feedhold
