// AnalysisKeys: under which keys the findings of the files of a run are kept.  What rules say of a file may depend on
// all files of the run.
#pragma once

#include "findings/project/workload.h"

#include <span>
#include <string>

namespace feedhold {

class AnalysisKeys {
public:
  explicit AnalysisKeys(std::span<const WorkItem> items);

  std::string of(const WorkItem &item) const;
  /// Of what the files give away about the settings of their machines.
  std::string ofInferred() const;

private:
  std::string run_; // a hash of the names, the texts and the settings of all files and of the contracts beside them
};

} // namespace feedhold
