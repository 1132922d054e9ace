// Session: everything for a set of files, from paths to findings, and the repairs.
#pragma once

#include "findings/project/workload.h"
#include "findings/session/answers.h"
#include "findings/session/result.h"

#include <string>
#include <vector>

namespace feedhold {

/// A file, a text or a configuration that refuses is named in the result; the others are analysed all the same.
CheckResult check(const CheckOptions &options, const KnownNames &known, const AnswerUse &answers = {});

/// Which fixes a person wants.
enum class FixKind { Safe, All };

struct FixedFile {
  std::string path;            // as in CheckedFile
  std::filesystem::path place; // where it lies; empty for a piped text
  std::string before;
  std::string after; // differs from `before`
  std::size_t fixes = 0;
};

struct FixResult {
  std::vector<FixedFile> files; // those that change, by path
  CheckResult remaining;        // what is found in the repaired texts
};

/// Repairs in memory, again and again until nothing is left to repair (at most kMostFixRounds times).  A file in which
/// a round of repairs brings forth more errors than there were keeps its text from before that round.
FixResult fix(const CheckOptions &options, FixKind kind, const KnownNames &known);
inline constexpr int kMostFixRounds = 10;

/// Puts the repaired texts in place of the files; the problems are those that could not be written.
std::vector<PathProblem> writeFixes(const std::vector<FixedFile> &files);

} // namespace feedhold
