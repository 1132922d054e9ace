// What becomes of the paths of a run: files with the dialect that was chosen for them, files that are none of its
// business, and problems.
#pragma once

#include <string>
#include <string_view>

namespace feedhold {

/// Why a file is read in its dialect.
enum class DialectChoice {
  Option,      // --dialect
  FilePattern, // [[files]] of the configuration
  Config,      // `dialect` of the configuration
  Guess,       // from the text
  Fallback,    // nothing speaks for any: the first of the list
};
std::string_view nameOf(DialectChoice choice);

struct SkippedFile {
  std::string path;
  std::string reason;
};

/// A path or a configuration that could not be used.
struct PathProblem {
  std::string path;
  std::string message;
};

} // namespace feedhold
