// FileStore: files as they were read, shared by the projects of a run and kept by a server from one loading to the
// next. Most of a folder stays as it is while a person edits one of its programs.
#pragma once

#include "findings/project/project_file.h"

#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <tuple>

namespace feedhold {

/// Programs of a folder, by name, and their texts.
using Folder = std::vector<std::pair<std::filesystem::path, SourceFile>>;

/// Holds each file as parsed for each control.  Safe to use from several threads.
class FileStore {
public:
  /// A run reads a file once, whatever happens to it meanwhile; a server asks again whether the text, the control and
  /// the files beside it are the same bytes as before.
  enum class Lifetime : std::uint8_t { Run, Server };
  explicit FileStore(Lifetime lifetime) : lifetime_(lifetime) {}

  /// The programs of a folder: a run lists them once.
  std::shared_ptr<const Folder> folder(const std::filesystem::path &folder, const std::function<Folder()> &list);

  std::shared_ptr<const ProjectFile> read(const OpenedFile &file, const std::shared_ptr<const OpenTexts> &open);

private:
  using Key = std::tuple<std::filesystem::path, std::string, std::string>; // path, as shown, control with its switches
  bool isAsBefore(const ProjectFile &known, const OpenedFile &file, const std::shared_ptr<const OpenTexts> &open) const;

  Lifetime lifetime_;
  std::mutex mutex_; // of the maps
  std::map<std::filesystem::path, std::shared_ptr<const Folder>> folders_;
  std::map<Key, std::shared_ptr<const ProjectFile>> files_;
};

} // namespace feedhold
