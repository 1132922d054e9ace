// Draft: contracts for programs that have none, made from what the programs and their callers say (docs/draft.md).
#pragma once

#include "findings/draft/draft_clause.h"
#include "findings/draft/trial.h"
#include "findings/session/proofs.h"

#include <filesystem>
#include <stop_token>

namespace feedhold {

namespace draft {

/// The clauses of one program.  `kept`: what people wrote beside it, without earlier drafts.
struct ProgramDraft {
  DraftClauses clauses;
  Score before; // of what is asked of any program
  Score after;
  std::size_t promises = 0; // that the draft adds, all of them proved
  std::size_t guesses = 0;  // conditions that callers have to keep, and that a proof needs
};
ProgramDraft draftOf(const Project &project, ProgramId program, const std::string &kept,
                     const prove::ProveOptions &options);

} // namespace draft

struct DraftOptions {
  CheckOptions files; // which, how they are read, and on how many threads
  /// A share of the work of `prove`, because each program is proved several times; missing programs as there.
  prove::ProveOptions prove = {.steps = prove::kStepsOfProgram / 8,
                               .arithmetic = prove::Arithmetic::Doubles,
                               .missing = MissingPrograms::Return};
  bool update = false;       // contracts that are there are added to, and earlier drafts in them made anew
  std::string program = {};  // the only one that is drafted, `O9100`; empty: all
  std::stop_token stop = {}; // of editors: nobody wants the result any more
};

/// One program and the file beside it.
struct DraftedProgram {
  std::string file;    // that has the program, as shown
  std::string program; // `O9100`
  std::filesystem::path place;
  std::string before; // the text of the sidecar
  std::string after;
  draft::ProgramDraft draft;
  std::string untouched = {}; // why nothing was drafted; empty: it was

  bool isChanged() const { return before != after; }
};

struct DraftResult {
  std::vector<DraftedProgram> programs; // by file, then by place
  std::vector<SkippedFile> skipped;
  std::vector<PathProblem> errors;
};

/// Nothing is drafted once a stop is requested.
DraftResult draftAll(const DraftOptions &options, const KnownNames &known);
/// Where the contract of a program would be written, if `feedhold draft` drafts one for it; absent: it does not.
std::optional<std::filesystem::path> draftPlace(const Project &project, ProgramId program);
/// Writes those that are changed.
std::vector<PathProblem> writeDrafts(const std::vector<DraftedProgram> &drafts);

} // namespace feedhold
