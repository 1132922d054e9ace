// Opens the file of a dump and chooses its dialect as `check` does without a configuration.
#include "surface/cli/dump_input.h"

#include "dialects/registry.h"
#include "findings/project/config.h"
#include "surface/cli/terminal.h"

#include <memory>

namespace feedhold {

namespace {

struct DumpArguments {
  std::string path;
  std::string dialect;
};

const Dialect &dialectFor(const SourceFile &source, const std::string &asked) {
  if (const Dialect *named = findDialect(allDialects(), asked))
    return *named;
  const LanguageGuess guess = guessLanguage(source.text(), source.path(), allDialects());
  return guess.dialect != nullptr ? *guess.dialect : *allDialects().dialects.front();
}

int runDump(const DumpArguments &arguments, std::string (*dump)(const SourceFile &, const Dialect &)) {
  if (!arguments.dialect.empty())
    if (const auto complaint = complaintAboutDialect(arguments.dialect, allDialects())) {
      printError(*complaint);
      return kExitCouldNotRun;
    }
  Result<SourceFile> source =
      arguments.path == "-" ? SourceFile::fromText("<stdin>", readStandardInput()) : SourceFile::open(arguments.path);
  if (!source) {
    printError(arguments.path + ": " + source.error().message);
    return kExitCouldNotRun;
  }
  print(dump(source.value(), dialectFor(source.value(), arguments.dialect)));
  return kExitClean;
}

} // namespace

Command addDumpCommand(CLI::App &parent, const std::string &name, const std::string &description,
                       std::string (*dump)(const SourceFile &, const Dialect &)) {
  CLI::App *app = parent.add_subcommand(name, description);
  const auto arguments = std::make_shared<DumpArguments>();
  app->add_option("file", arguments->path, "program file; - is standard input")->type_name("FILE")->required();
  app->add_option("--dialect", arguments->dialect, "control to assume (default: detected); see `feedhold dialects`")
      ->type_name("DIALECT");
  return {app, [arguments, dump] { return runDump(*arguments, dump); }};
}

} // namespace feedhold
