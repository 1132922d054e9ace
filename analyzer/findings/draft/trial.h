// Trial: a program proved with clauses that are in no file yet.
#pragma once

#include "findings/draft/draft_clause.h"
#include "findings/project/project.h"
#include "proof/prove/prove.h"

#include <map>

namespace feedhold::draft {

class Trial {
public:
  /// `kept`: the text of the sidecar that people wrote, as far as it stays.
  Trial(const Project &project, ProgramId program, std::string kept, prove::ProveOptions options);

  /// The contract of the file with these lines.
  FileContracts contractsWith(const std::vector<std::string> &lines) const;
  /// No clause has an issue, and no clause is given twice.
  bool areSound(const std::vector<std::string> &lines) const;
  prove::ProgramProof prove(const std::vector<std::string> &lines, std::vector<prove::ObligationKind> only = {},
                            prove::InferGuards guards = prove::InferGuards::No) const;

private:
  const Project &project_;
  ProgramId program_;
  std::string kept_;
  prove::ProveOptions options_;
};

/// How many claims there are, and how many of them hold.
struct Score {
  std::size_t holds = 0;
  std::size_t all = 0;
};
Score scoreOf(const prove::ProgramProof &proof);
/// Of what is asked of any program; promises of its contract are not counted.
Score scoreBesidePromises(const prove::ProgramProof &proof);

} // namespace feedhold::draft
