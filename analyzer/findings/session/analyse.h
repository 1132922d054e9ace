// Analyse: from loaded files to findings.
#pragma once

#include "findings/project/workload.h"
#include "findings/session/answers.h"
#include "findings/session/result.h"

#include <span>
#include <vector>

namespace feedhold {

struct AnalyseOptions {
  unsigned jobs = 0;
  std::function<void(std::size_t, std::size_t)> progress = {};
  std::shared_ptr<const OpenTexts> open = {};  // of editors: files with contracts among them
  const std::set<std::string> *only = nullptr; // as CheckOptions::only
  AnswerUse answers = {};
};

struct AnalysedFiles {
  std::vector<CheckedFile> files;
  std::vector<InferredSetting> inferred;
  std::vector<PathProblem> errors; // files of which no answer is given
};

/// One file for each item, in their order; the index of an item is its FileId.  Behind them those files with
/// contracts of which there is something to say.
AnalysedFiles analyse(std::span<const WorkItem> items, const KnownNames &known, const AnalyseOptions &options);

} // namespace feedhold
