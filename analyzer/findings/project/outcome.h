// What becomes of the paths of a run: files with the dialect that was chosen for them, files that are none of its
// business, and problems.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace feedhold {

/// Why a file is read in its dialect.
enum class DialectChoice {
  Option,      // --dialect
  FilePattern, // [[files]] of the configuration
  Config,      // `dialect` of the configuration
  Guess,       // from the text
  FolderVote,  // from the other files of its folder
  Fallback,    // nothing speaks for any: the first of the list
};
std::string_view nameOf(DialectChoice choice);

/// Refused: by its name or its contents it should be a program, and cannot be read.  NoProgram: a document, data, ..
enum class SkipKind : std::uint8_t { Refused, NoProgram };
std::string_view nameOf(SkipKind kind);

struct SkippedFile {
  std::string path;
  std::string reason;
  SkipKind kind = SkipKind::Refused;
};

/// A path or a configuration that could not be used.
struct PathProblem {
  std::string path;
  std::string message;
};

} // namespace feedhold
