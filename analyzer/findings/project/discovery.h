// Discovery: from the paths that a person names to the files to look at, in a fixed order.
#pragma once

#include "findings/project/config_finder.h"
#include "findings/project/outcome.h"

#include <filesystem>
#include <string>
#include <vector>

namespace feedhold {

/// How a file came into the run.
enum class FoundBy {
  Name,      // named by the person: always taken
  Extension, // in a folder, with an extension that only NC programs have
  Content,   // in a folder, with any other extension or none: taken when it looks like a program
};

struct FoundFile {
  std::filesystem::path path;
  std::string shown; // the path in messages: as it was named, `/` as separator
  FoundBy foundBy;
  const Config *config; // of its folder
};

struct Discovery {
  std::vector<FoundFile> files;    // by shown path, each file once
  std::vector<SkippedFile> others; // in folders, of another format by their extension; by shown path
  std::vector<PathProblem> problems;
};

/// Hidden folders and files are passed over; links to folders are not followed.  A file whose configuration has errors
/// is left out: the errors are with the finder.
Discovery discover(const std::vector<std::string> &paths, ConfigFinder &configs);

/// The files of one folder without those below it, with absolute paths.
std::vector<FoundFile> discoverFolder(const std::filesystem::path &folder, ConfigFinder &configs);

/// How a file of this name in a folder is looked at; absent: its extension is one of another format.
std::optional<FoundBy> kindOfFileName(std::string_view name);
/// It begins with a dot, and is no program with the extension of one: `.canal_face.ngc` is no hidden file, those that
/// editors and systems put beside a program are (`.#O1000.nc`, `._O1000.nc`).
bool isHiddenFileName(std::string_view name);

/// Whether a file that was skipped is one of the `named` only because somebody, such as a hook, names all files that
/// changed: by its name it may be a program or anything else.
bool isNamedByChance(const SkippedFile &skipped, const std::vector<std::string> &named);

} // namespace feedhold
