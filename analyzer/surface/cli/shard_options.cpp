#include "surface/cli/shard_options.h"

#include "base/source/path_text.h"
#include "base/source/source_file.h"
#include "base/source/write_file.h"
#include "proof/smt/solver.h"
#include "surface/cli/command_words.h"
#include "surface/cli/platform.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>

namespace feedhold {

namespace fs = std::filesystem;

namespace {

std::optional<std::uint32_t> numberIn(std::string_view text) {
  std::uint32_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

std::optional<Shard> shardNamed(std::string_view text) {
  const std::size_t slash = text.find('/');
  if (slash == std::string_view::npos)
    return std::nullopt;
  const auto index = numberIn(text.substr(0, slash));
  const auto count = numberIn(text.substr(slash + 1));
  const Shard shard{index.value_or(0), count.value_or(0)};
  return isShard(shard) ? std::optional(shard) : std::nullopt;
}

/// The options that are not the same in all shards of a run.
const std::vector<std::string> kOwnOptions = {"--shard",     "--part",      "--costs",   "--jobs",
                                              "--cache-dir", "--cache-url", "--no-cache"};

std::vector<fs::path> partsIn(const fs::path &path) {
  std::error_code ignored;
  if (!fs::is_directory(path, ignored))
    return {path};
  std::vector<fs::path> parts;
  for (const fs::directory_entry &entry : fs::directory_iterator(path, ignored))
    if (entry.path().extension() == kPartEnd)
      parts.push_back(entry.path());
  std::sort(parts.begin(), parts.end());
  return parts;
}

} // namespace

void addShardOptions(CLI::App &app, ShardOptions &options) {
  app.add_option("--shard", options.shard,
                 "only the I-th of N parts of the files, as equal in cost as the calls among the programs allow")
      ->type_name("I/N");
  app.add_option("--part", options.part, "write the results of this shard to a file, for `feedhold merge`")
      ->type_name("FILE");
  app.add_option("--costs", options.costs, "balance the shards by what the files cost in these parts of an earlier run")
      ->type_name("PART")
      ->allow_extra_args(false);
}

std::optional<std::string> complaintAbout(const ShardOptions &options, const std::string &other) {
  if (!options.shard.empty() && !shardNamed(options.shard))
    return fmt::format("--shard {}: which shard, and of how many? Write for example --shard 3/8", options.shard);
  if (!options.costs.empty() && options.shard.empty())
    return "--costs needs --shard";
  if (options.isAsked() && !other.empty())
    return fmt::format("{} cannot be combined with --shard or --part, or with parts", other);

  return std::nullopt;
}

Result<std::optional<std::set<std::string>>> filesOf(const ShardOptions &options, const CheckOptions &among,
                                                     const KnownNames &known) {
  if (options.shard.empty())
    return std::optional<std::set<std::string>>();
  FileCosts costs;
  if (!options.costs.empty()) {
    Result<std::vector<RunPart>> parts = readParts(options.costs);
    if (!parts)
      return parts.error();
    for (RunPart part : parts.take())
      costs.merge(part.costs);
  }
  return std::optional(filesOfShard(among, known, *shardNamed(options.shard), costs));
}

std::optional<Error> writePartOf(const ShardOptions &options, const CLI::App &command, const Answers &answers,
                                 FileCosts costs) {
  if (options.part.empty())
    return std::nullopt;
  std::vector<std::string> words = wordsOf(command, kOwnOptions);
  words.insert(words.begin(), command.get_name());
  const Shard shard = options.shard.empty() ? Shard() : *shardNamed(options.shard);
  auto error = saveFile(options.part, writePart({toolOfParts(), proverOfParts(command.get_name()), std::move(words),
                                                 shard, std::move(costs), answers.all()}));
  if (error)
    return Error{options.part + ": " + error->message};
  return std::nullopt;
}

std::string proverOfParts(const std::string &command) {
  if (command != "certify") // the report of which names them
    return "";
  return fmt::format("{} and {}", smt::z3Version().value_or("no Z3"), smt::cvc5Version().value_or("no cvc5"));
}

std::string toolOfParts() { return fmt::format("feedhold {} {}", FEEDHOLD_VERSION, buildId()); }

Result<std::vector<RunPart>> readParts(const std::vector<std::string> &paths) {
  std::vector<RunPart> parts;
  for (const std::string &path : paths) {
    const std::vector<fs::path> files = partsIn(path);
    if (files.empty())
      return Error{fmt::format("{}: the folder has no file whose name ends in {}", path, kPartEnd)};
    for (const fs::path &file : files) {
      const Result<SourceFile> source = SourceFile::open(file);
      if (!source)
        return Error{fmt::format("{}: {}", pathText(file), source.error().message)};
      Result<RunPart> part = readPart(source.value().text());
      if (!part)
        return Error{fmt::format("{}: {}", pathText(file), part.error().message)};
      parts.push_back(part.take());
    }
  }
  return parts;
}

} // namespace feedhold
