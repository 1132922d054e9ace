#include "surface/cli/change_options.h"

#include "findings/project/git_changes.h"

namespace feedhold {

void addChangedSince(CLI::App &app, ChangeOptions &change) {
  app.add_option("--changed-since", change.since,
                 "only programs changed since the branch left this git revision, and programs that call them")
      ->type_name("REVISION");
}

void addWithCallers(CLI::App &app, ChangeOptions &change) {
  CLI::Option *callers =
      app.add_flag("--with-callers", change.withCallers,
                   "the paths are changed files: include the programs in their folders that call them");
  callers->excludes(app.get_option("--changed-since"));
}

std::optional<std::string> complaintAbout(const ChangeOptions &change, const CheckOptions &options) {
  if (!change.isAsked() || !options.piped)
    return std::nullopt;
  return "--changed-since and --with-callers need named files, not standard input";
}

Result<Affected> affected(const ChangeOptions &change, const CheckOptions &options, const KnownNames &known) {
  if (change.withCallers)
    return affectedByNamed(options.paths, options, known);
  const Result<std::vector<std::filesystem::path>> changed = changedSince(change.since, options.paths);
  if (!changed)
    return changed.error();
  return affectedBy(changed.value(), options, known);
}

} // namespace feedhold
