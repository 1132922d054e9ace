// The stages of golden cases, each by the engine's own function; findings go the way that `feedhold check` takes, from
// files in a folder to the text of a sink.
#include "golden/stages.h"

#include "dialects/registry.h"
#include "findings/project/sidecars.h"
#include "findings/session/ranges.h"
#include "findings/session/session.h"
#include "golden/run_stage.h"
#include "golden/verdicts_stage.h"
#include "language/lex/lexer.h"
#include "language/parse/parse.h"
#include "meaning/cfg/cfg.h"
#include "rules/registry.h"
#include "surface/sink/ranges_sink.h"
#include "surface/sink/sink.h"

#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <functional>
#include <map>

namespace feedhold::golden {

namespace {

namespace fs = std::filesystem;

// ---- dumps of one file --------------------------------------------------------------------------------------------

using Dump = std::string (*)(const SourceFile &, const Dialect &);

std::string tokens(const SourceFile &source, const Dialect &dialect) { return dump(lex(source, dialect), source); }

std::string tree(const SourceFile &source, const Dialect &dialect) { return dump(parse(source, dialect), source); }

std::string model(const SourceFile &source, const Dialect &dialect) {
  const SyntaxTree syntax = parse(source, dialect);
  return dump(resolve(source, syntax, dialect), syntax, source);
}

std::string cfg(const SourceFile &source, const Dialect &dialect) {
  const SyntaxTree syntax = parse(source, dialect);
  const ProgramModel programs = resolve(source, syntax, dialect);
  return dump(lower(source, syntax, programs, dialect), syntax, source, programs);
}

/// `O9100.contract`: beside the programs, no program itself.
bool isSidecar(const InputFile &file) { return file.name.ends_with(".contract"); }

/// Text for each file, under the file's name when there are several.
std::string eachFile(const Input &input, const std::function<std::string(const InputFile &)> &textOf) {
  std::string text;
  const auto programs = std::count_if(input.files.begin(), input.files.end(), std::not_fn(isSidecar));
  for (const InputFile &file : input.files) {
    if (isSidecar(file))
      continue;
    if (programs > 1)
      text += fmt::format("== {} ==\n", file.name);
    text += textOf(file);
  }
  return text;
}

std::string dumps(const Input &input, Dump dumpOne) {
  return eachFile(input, [&](const InputFile &file) {
    return dumpOne(SourceFile::fromText(file.name, file.text), *input.dialect);
  });
}

// ---- whole runs ---------------------------------------------------------------------------------------------------

/// A folder with the files of a case, the working directory as long as it lives.
class Folder {
public:
  explicit Folder(const Input &input) : before_(fs::current_path()) {
    std::string path = (fs::temp_directory_path() / "feedhold-golden-XXXXXX").string();
    if (!mkdtemp(path.data()))
      std::abort();
    path_ = path;
    for (const InputFile &file : input.files)
      std::ofstream(path_ / file.name, std::ios::binary) << file.text;
    if (input.config)
      std::ofstream(path_ / kConfigFileName) << *input.config;
    fs::current_path(path_);
  }
  ~Folder() {
    fs::current_path(before_);
    fs::remove_all(path_);
  }
  Folder(const Folder &) = delete;
  Folder &operator=(const Folder &) = delete;
  const fs::path &path() const { return path_; }

private:
  fs::path before_;
  fs::path path_;
};

KnownNames knownNames() { return {allDialects(), allRules()}; }

CheckOptions optionsFor(const Input &input) {
  CheckOptions options;
  for (const InputFile &file : input.files)
    if (!isSidecar(file))
      options.paths.push_back(file.name);
  if (!input.guess)
    options.control.dialect = std::string(input.dialect->id);
  options.select = input.rules;
  options.config.source = input.config ? ConfigSource::Nearest : ConfigSource::None;
  options.jobs = 1;
  options.minSeverity = Severity::Info;
  return options;
}

std::string problemsOf(const CheckResult &result) {
  std::string text;
  for (const PathProblem &problem : result.errors)
    text += fmt::format("{}: {}\n", problem.path, problem.message);
  for (const SkippedFile &file : result.skipped)
    text += fmt::format("{}: skipped: {}\n", file.path, file.reason);
  return text;
}

/// The contracts of each file, with those beside it.
std::string contract(const Input &input) {
  const Folder folder(input);
  return eachFile(input, [&](const InputFile &file) {
    const SourceFile source = SourceFile::fromText(file.name, file.text);
    const SyntaxTree syntax = parse(source, *input.dialect);
    const ProgramModel programs = resolve(source, syntax, *input.dialect);
    return dump(readContracts(source, syntax, programs, *input.dialect, sidecarsOf(file.name, programs, nullptr)),
                programs, syntax);
  });
}

std::string report(const Input &input, Format format) {
  const Folder folder(input);
  const CheckResult result = check(optionsFor(input), knownNames());
  std::string text = write(format, {.result = result, .rules = allRules(), .version = "0", .root = folder.path()});
  const std::string place = folder.path().string();
  for (std::size_t at = text.find(place); at != std::string::npos; at = text.find(place))
    text.replace(at, place.size(), "/programs");
  return problemsOf(result) + text;
}

std::string fixed(const Input &input, FixKind options) {
  const Folder folder(input);
  const FixResult result = fix(optionsFor(input), options, knownNames());
  std::map<std::string, std::string> after;
  for (const FixedFile &file : result.files)
    after[file.path] = file.after;
  return eachFile(input,
                  [&](const InputFile &file) { return after.contains(file.name) ? after[file.name] : file.text; });
}

/// As `feedhold ranges` tells of the first file, called programs included.
std::string invariants(const Input &input) {
  const Folder folder(input);
  ProgramOptions options{.path = input.files.front().name};
  if (!input.guess)
    options.control.dialect = std::string(input.dialect->id);
  options.config.source = input.config ? ConfigSource::Nearest : ConfigSource::None;
  const auto programs = loadProject(options, knownNames());
  if (!programs)
    return programs.error().message + "\n";
  const Result<BlockStates> states = rangesOf(*programs.value(), {.files = RangesOptions::Files::All});
  if (!states)
    return states.error().message + "\n";
  std::vector<std::string> shown;
  for (const auto &file : programs.value()->files)
    shown.push_back(file->shown);
  return writeRangesText({*programs.value()->set, shown, states.value()});
}

std::string verdicts(const Input &input) {
  const Folder folder(input);
  ProofOptions options{.files = optionsFor(input)};
  options.prove.guards = prove::InferGuards::No;
  return verdictsOf(proveAll(options, knownNames()));
}

} // namespace

std::optional<std::string> runStage(std::string_view stage, const Input &input) {
  if (stage == "tokens")
    return dumps(input, tokens);
  if (stage == "tree")
    return dumps(input, tree);
  if (stage == "model")
    return dumps(input, model);
  if (stage == "cfg")
    return dumps(input, cfg);
  if (stage == "contract")
    return contract(input);
  if (stage == "invariants")
    return invariants(input);
  if (stage == "verdicts")
    return verdicts(input);
  if (stage == "run" || stage.starts_with("run ")) {
    const Folder folder(input);
    return runStageOf(input, stage.substr(3));
  }
  if (stage == "findings")
    return report(input, Format::Text);
  if (stage == "fixed")
    return fixed(input, FixKind::Safe);
  if (stage == "fixed-unsafe")
    return fixed(input, FixKind::All);
  if (const std::optional<Format> format = formatFromName(stage))
    return report(input, *format);
  return std::nullopt;
}

} // namespace feedhold::golden
