// ProjectFile: one file of a project, from its text to its model and its contracts.  Programs are parsed here and
// nowhere else.
#pragma once

#include "findings/project/sidecars.h"
#include "language/contract/contract.h"
#include "language/model/model.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace feedhold {

struct ProjectFile {
  std::string shown;
  std::filesystem::path path; // empty for a piped text
  SourceFile source;
  std::shared_ptr<const Dialect> dialect; // for whose control it is read, with the switches of the configuration
  SyntaxTree tree;
  ProgramModel model;
  FileContracts contracts;       // with those of the files beside it
  std::vector<Sidecar> sidecars; // that were read with it
};

/// A file that has been opened.
struct OpenedFile {
  std::string shown;
  std::filesystem::path path;
  SourceFile source;
  std::shared_ptr<const Dialect> dialect;
};

/// `open`: texts of editors, those of sidecars among them.
std::shared_ptr<ProjectFile> readFile(const OpenedFile &file, const std::shared_ptr<const OpenTexts> &open);
/// A file in a language that is not read: without blocks and programs.
std::shared_ptr<ProjectFile> unreadFile(const OpenedFile &file);

} // namespace feedhold
