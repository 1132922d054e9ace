// The sub-commands of `feedhold`; each adds its options and says what to run.
#pragma once

#include "findings/session/answers.h"

#include <CLI/CLI.hpp>

#include <functional>

namespace feedhold {

inline constexpr int kExitClean = 0;
inline constexpr int kExitFindings = 1;
inline constexpr int kExitCouldNotRun = 2;
inline constexpr int kExitDefect = 4;  // of `prove`: a run contradicts a verdict, which is a defect of Feedhold
inline constexpr int kExitUnknown = 3; // of `prove`: nothing is refuted, not all is proved

/// A sub-command on the command line, and what it does: returns the exit code.
struct Command {
  CLI::App *app;
  std::function<int()> run;
};

/// `given`: answers of parts, which `merge` joins by this command; null: the command works everything out.
Command addCheckCommand(CLI::App &parent, const Answers *given = nullptr);
Command addRunCommand(CLI::App &parent);
Command addPlotCommand(CLI::App &parent);
Command addExplainCommand(CLI::App &parent);
Command addRulesCommand(CLI::App &parent);
Command addDialectsCommand(CLI::App &parent);
Command addTokensCommand(CLI::App &parent);
Command addTreeCommand(CLI::App &parent);
Command addModelCommand(CLI::App &parent);
Command addCfgCommand(CLI::App &parent);
Command addRangesCommand(CLI::App &parent);
Command addProveCommand(CLI::App &parent, const Answers *given = nullptr);
Command addMergeCommand(CLI::App &parent);
Command addDraftCommand(CLI::App &parent);
Command addCertifyCommand(CLI::App &parent, const Answers *given = nullptr);
Command addRecheckCommand(CLI::App &parent);
Command addSelfCheckCommand(CLI::App &parent);
Command addCompletionsCommand(CLI::App &parent);
Command addManCommand(CLI::App &parent);
Command addLspCommand(CLI::App &parent);

} // namespace feedhold
