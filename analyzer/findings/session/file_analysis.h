// FileAnalysis: what the rules say of one file, and its record.
#pragma once

#include "findings/project/workload.h"
#include "findings/session/result.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace feedhold {

struct FileAnalysis {
  std::vector<Finding> findings;
  std::vector<ProgramHead> programs;
  std::vector<std::string> sidecarPaths; // of the files beside it that were read with it
  std::vector<CheckedFile> sidecars;     // those of which there is something to say
};

/// A file before anything was found in it.
CheckedFile headOf(const WorkItem &item);

std::string writeFileAnalysis(const FileAnalysis &analysis);

/// What findings may name.
struct AnalysedRun {
  std::span<const WorkItem> items;
  const RuleRegistry &rules;
};

/// Absent: that is no record, it names files, places or rules that are not there, or a file beside the program has
/// changed.
std::optional<FileAnalysis> readFileAnalysis(std::string_view record, const WorkItem &item, const AnalysedRun &run);

std::string writeInferred(const std::vector<InferredSetting> &inferred);
std::optional<std::vector<InferredSetting>> readInferred(std::string_view record, const DialectRegistry &dialects);

} // namespace feedhold
