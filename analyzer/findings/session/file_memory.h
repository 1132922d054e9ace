// FileMemory: files as they were read, kept from one loading to the next.  Most of a folder stays as it is while a
// person edits one of its programs.
#pragma once

#include "findings/session/programs.h"
#include "findings/session/sidecars.h"

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>

namespace feedhold {

/// For one thread.  Holds one reading of each file for each control.
class FileMemory {
public:
  struct Reading {
    std::shared_ptr<const LoadedFile> file;
    std::vector<Sidecar> sidecars; // that were read with it
  };

  /// The file as it was read, if its text, its control and the files beside it are the same bytes as then; else what
  /// `read` makes of it, which is kept.
  std::shared_ptr<const LoadedFile> reading(const std::filesystem::path &path, const SourceFile &source,
                                            const Dialect &dialect, const std::shared_ptr<const OpenTexts> &open,
                                            const std::function<Reading()> &read);

private:
  std::map<std::pair<std::filesystem::path, std::string>, Reading> readings_; // by path, and by control with switches
};

} // namespace feedhold
