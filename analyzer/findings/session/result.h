// CheckResult: what a run found, in the order in which every output shows it.
#pragma once

#include "base/source/source_file.h"
#include "findings/project/machine_settings.h"
#include "findings/project/outcome.h"
#include "findings/rule/rule.h"

#include <string>
#include <string_view>
#include <vector>

namespace feedhold {

struct Finding {
  const RuleInfo *rule;
  Severity severity; // after the configuration had its say
  Diagnostic diagnostic;
  std::string fingerprint; // 16 hex digits
  bool suppressed = false;
  std::string reason = {};    // of the suppression; may be empty
  std::string allowedIn = {}; // the file beside the program that suppresses it; empty: a comment of the program
};

/// Where a program of a file begins.
struct ProgramHead {
  std::string name; // `O1000`; empty: none is written
  Span header;
};

struct CheckedFile {
  std::string path; // as named, `/` as separator; the index in CheckResult::files is the FileId of labels
  SourceFile source;
  std::string_view dialect; // id
  DialectChoice choice;
  std::vector<std::string_view> reasons;  // of a guess
  Severity errorOn;                       // findings from here on fail the run
  Severity minSeverity;                   // findings from here on are shown
  std::vector<Finding> findings;          // by place, then by rule
  bool isOnlyCalled = false;              // no rules ran over it: it is there for the others
  std::string_view foreign = {};          // the language, of a file that is refused for it
  std::vector<ProgramHead> programs = {}; // in order of the text
  std::vector<std::string> sidecars = {}; // paths of the files beside it that were read with it
};

struct CheckResult {
  std::vector<CheckedFile> files;   // by path
  std::vector<SkippedFile> skipped; // by path
  std::vector<PathProblem> errors;
  std::vector<InferredSetting> inferred = {}; // by folder
};

/// Severe enough to be shown, and to be repaired.
bool isReported(const Finding &finding, const CheckedFile &file);
/// Not suppressed and severe enough to fail the run.
bool fails(const Finding &finding, const CheckedFile &file);
bool anyFails(const CheckResult &result);

} // namespace feedhold
