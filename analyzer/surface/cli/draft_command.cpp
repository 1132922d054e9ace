// `feedhold draft [PATHS]`: writes contracts for programs that have none.
#include "findings/draft/draft.h"

#include "base/diag/edits.h"
#include "base/source/path_text.h"
#include "dialects/registry.h"
#include "rules/registry.h"
#include "surface/cli/commands.h"
#include "surface/cli/shared_options.h"
#include "surface/cli/terminal.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace feedhold {

namespace {

struct DraftArguments {
  std::vector<std::string> paths;
  ControlArguments control;
  ConfigArguments config;
  std::string arithmetic = "control";
  unsigned jobs = 0;
  bool update = false;
  bool toOutput = false;
  bool diff = false;
  bool quiet = false;
};

void addOptions(CLI::App &app, DraftArguments &arguments) {
  app.add_option("paths", arguments.paths, "files and folders (default: current folder)")->type_name("PATH");
  app.add_flag("--update", arguments.update,
               "draft for programs with contracts, too: earlier drafts are written anew, your clauses stay");
  CLI::Option *toOutput = app.add_flag("--stdout", arguments.toOutput, "print the contracts and write no file");
  app.add_flag("--diff", arguments.diff, "print the changes as a unified diff and write no file")->excludes(toOutput);
  app.add_option("--arithmetic", arguments.arithmetic,
                 "prove in the rounded numbers of the control, or in exact numbers as on paper (faster)")
      ->check(CLI::IsMember({"control", "exact"}))
      ->capture_default_str();
  addControl(app, arguments.control);
  addConfiguration(app, arguments.config);
  addJobs(app, arguments.jobs);
  addQuiet(app, arguments.quiet, "print no table and no skipped files");
}

DraftOptions draftOptionsOf(const DraftArguments &arguments) {
  DraftOptions options;
  options.files.paths = arguments.paths.empty() ? std::vector<std::string>{"."} : arguments.paths;
  options.files.control = controlFrom(arguments.control);
  options.files.config = configFrom(arguments.config);
  options.files.jobs = arguments.jobs;
  options.update = arguments.update;
  if (arguments.arithmetic == "exact")
    options.prove.arithmetic = prove::Arithmetic::Exact;
  return options;
}

std::string textsOf(const std::vector<DraftedProgram> &programs, bool asDiff) {
  std::string text;
  for (const DraftedProgram &each : programs) {
    if (!each.isChanged())
      continue;
    const std::string place = pathText(each.place);
    text += asDiff ? unifiedDiff(place, each.before, each.after) : fmt::format("; {}\n{}\n", place, each.after);
  }
  return text;
}

/// `O9100   3 of 8  8 of 8  12 clauses, 4 promises proved`
std::string rowOf(const DraftedProgram &each, std::size_t width) {
  const draft::ProgramDraft &draft = each.draft;
  const std::string name = fmt::format("{}: {}", each.file, each.program);
  if (!each.untouched.empty())
    return fmt::format("{:<{}}  not drafted: {}\n", name, width, each.untouched);
  const auto score = [](const draft::Score &of) { return fmt::format("{} of {}", of.holds, of.all); };
  const auto hints =
      static_cast<std::size_t>(std::ranges::count(draft.clauses, draft::Ground::Hint, &draft::DraftClause::ground));
  return fmt::format("{:<{}}  {:>9} {:>9}  {:>7} {:>8} {:>11}\n", name, width, score(draft.before), score(draft.after),
                     draft.clauses.size() - hints, draft.promises, hints);
}

std::string tableOf(const std::vector<DraftedProgram> &programs) {
  std::size_t width = 0;
  for (const DraftedProgram &each : programs)
    width = std::max(width, each.file.size() + each.program.size() + 2);
  std::string text = fmt::format("{:<{}}  {:>9} {:>9}  {:>7} {:>8} {:>11}\n", "proved of what every program must keep",
                                 width, "before", "after", "clauses", "promises", "suggestions");
  for (const DraftedProgram &each : programs)
    text += rowOf(each, width);
  return text;
}

int runDraft(const DraftArguments &arguments) {
  if (const auto complaint = complaintAbout(arguments.control)) {
    printError(*complaint);
    return kExitCouldNotRun;
  }
  DraftOptions options = draftOptionsOf(arguments);
  ProgressLine progress;
  if (!arguments.quiet)
    options.files.progress = [&](std::size_t done, std::size_t all) { progress.show(done, all); };
  DraftResult result = draftAll(options, {allDialects(), allRules()});
  progress.clear();
  const bool isShown = arguments.toOutput || arguments.diff;
  if (isShown)
    print(textsOf(result.programs, arguments.diff));
  else
    for (PathProblem &problem : writeDrafts(result.programs))
      result.errors.push_back(std::move(problem));
  for (const PathProblem &error : result.errors)
    printError(error.path + ": " + error.message);
  if (!arguments.quiet) {
    for (const SkippedFile &skipped : result.skipped)
      printAside(fmt::format("skipped {}: {}\n", skipped.path, skipped.reason));
    if (isShown)
      printAside(tableOf(result.programs));
    else
      print(tableOf(result.programs));
  }
  if (!result.errors.empty())
    return kExitCouldNotRun;
  const bool wouldChange = std::ranges::any_of(result.programs, &DraftedProgram::isChanged);
  return arguments.diff && wouldChange ? kExitFindings : kExitClean;
}

} // namespace

Command addDraftCommand(CLI::App &parent) {
  CLI::App *app = parent.add_subcommand("draft", "write contracts for programs that have none, and prove them");
  app->footer("Exit codes: 0 done, 1 --diff has changes, 2 the command could not run.\n"
              "Example: feedhold draft --diff macros/");
  const auto arguments = std::make_shared<DraftArguments>();
  addOptions(*app, *arguments);
  return {app, [arguments] { return runDraft(*arguments); }};
}

} // namespace feedhold
