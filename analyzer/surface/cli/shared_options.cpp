#include "surface/cli/shared_options.h"

#include "dialects/registry.h"

namespace feedhold {

void addControl(CLI::App &app, ControlArguments &arguments) {
  app.add_option("--dialect", arguments.dialect,
                 "control to assume (default: feedhold.toml, else detected); see `feedhold dialects`")
      ->type_name("DIALECT");
  const auto systems = incrementSystemNames();
  app.add_option("--increment-system", arguments.incrementSystem,
                 "least increment: IS-A 0.01 mm, IS-B 0.001 mm, IS-C 0.0001 mm (default: feedhold.toml, else IS-B)")
      ->type_name("SYSTEM")
      ->check(CLI::IsMember(std::vector<std::string>(systems.begin(), systems.end())));
  const auto lists = gCodeSystemNames();
  app.add_option("--g-code-system", arguments.gCodeSystem,
                 "G codes of a lathe: system A, B or C (default: feedhold.toml, else detected, else A)")
      ->type_name("SYSTEM")
      ->check(CLI::IsMember(std::vector<std::string>(lists.begin(), lists.end())));
}

std::optional<std::string> complaintAbout(const ControlArguments &arguments) {
  return arguments.dialect.empty() ? std::nullopt : complaintAboutDialect(arguments.dialect, allDialects());
}

ControlOptions controlFrom(const ControlArguments &arguments) {
  ControlOptions options{.incrementSystem = incrementSystemNamed(arguments.incrementSystem),
                         .gCodeSystem = gCodeSystemNamed(arguments.gCodeSystem)};
  if (!arguments.dialect.empty())
    options.dialect = arguments.dialect;
  return options;
}

void addConfiguration(CLI::App &app, ConfigArguments &arguments) {
  CLI::Option *config = app.add_option("--config", arguments.file, "use this feedhold.toml instead of the nearest one")
                            ->type_name("FILE");
  app.add_flag("--isolated", arguments.isolated, "ignore every feedhold.toml")->excludes(config);
}

ConfigOptions configFrom(const ConfigArguments &arguments) {
  if (arguments.isolated)
    return {ConfigSource::None};
  if (!arguments.file.empty())
    return {ConfigSource::Named, arguments.file};
  return {};
}

void addFormat(CLI::App &app, std::string &format, const std::vector<std::string> &known) {
  app.add_option("--format", format, "output format (default: " + format + ")")
      ->type_name("FORMAT")
      ->check(CLI::IsMember(known));
}

void addJobs(CLI::App &app, unsigned &jobs) {
  app.add_option("--jobs", jobs, "number of threads (default: one per processor)")->type_name("N");
}

void addColor(CLI::App &app, std::string &when) {
  app.add_option("--color", when, "colour the output (default: " + when + ")")
      ->type_name("WHEN")
      ->check(CLI::IsMember({"auto", "always", "never"}));
}

void addQuiet(CLI::App &app, bool &quiet, const std::string &meaning) { app.add_flag("-q,--quiet", quiet, meaning); }

void addStdinFilename(CLI::App &app, std::string &path) {
  app.add_option("--stdin-filename", path, "file name to show for standard input")->type_name("PATH");
}

void addCache(CLI::App &app, CacheArguments &arguments) {
  CLI::Option *folder =
      app.add_option("--cache-dir", arguments.folder, "keep verdicts here (default: user cache folder)")
          ->type_name("FOLDER");
  CLI::Option *url =
      app.add_option(
             "--cache-url", arguments.url,
             "share verdicts over this web folder, signed with $FEEDHOLD_CACHE_KEY (default: $FEEDHOLD_CACHE_URL)")
          ->type_name("URL");
  app.add_flag("--no-cache", arguments.off, "neither read nor write cached verdicts")->excludes(folder)->excludes(url);
}

} // namespace feedhold
