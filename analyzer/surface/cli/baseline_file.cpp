#include "surface/cli/baseline_file.h"

#include "base/source/path_text.h"
#include "base/source/write_file.h"
#include "surface/cli/commands.h"
#include "surface/cli/terminal.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>

namespace feedhold {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

constexpr int kVersion = 1;
constexpr std::size_t kGoneShown = 5;

Json toJson(const KnownFinding &entry) {
  return {{"path", entry.path}, {"rule", entry.rule}, {"fingerprint", entry.fingerprint}, {"message", entry.message}};
}

Json toJson(const KnownObligation &entry) {
  return {{"path", entry.path}, {"id", entry.id}, {"kind", entry.kind}, {"verdict", nameOf(entry.verdict)}};
}

/// One entry a line, so that a change of one is a change of one line.
template <typename Entry> std::string toText(const std::vector<Entry> &entries) {
  std::string text;
  for (const Entry &entry : entries) // a path may hold bytes that are no UTF-8; they become U+FFFD
    text += fmt::format("{}\n    {}", text.empty() ? "" : ",",
                        toJson(entry).dump(-1, ' ', false, Json::error_handler_t::replace));
  return text.empty() ? "[]" : fmt::format("[{}\n  ]", text);
}

void read(const Json &row, KnownFinding &entry) {
  entry = {row.at("path"), row.at("rule"), row.at("fingerprint"), row.value("message", "")};
}

void read(const Json &row, KnownObligation &entry) {
  const std::string verdict = row.at("verdict");
  if (verdict != nameOf(prove::Verdict::Refuted) && verdict != nameOf(prove::Verdict::Unknown))
    throw std::invalid_argument(fmt::format("the verdict `{}` is neither refuted nor unknown", verdict));
  const bool isRefuted = verdict == nameOf(prove::Verdict::Refuted);
  entry = {row.at("path"), row.at("id"), row.at("kind"), isRefuted ? prove::Verdict::Refuted : prove::Verdict::Unknown};
}

template <typename Entry> std::vector<Entry> readAll(const Json &document, const char *key) {
  std::vector<Entry> entries;
  const Json &rows = document.at(key);
  if (!rows.is_array())
    throw std::invalid_argument(fmt::format("`{}` is not a list", key));
  for (const Json &row : rows) {
    try {
      read(row, entries.emplace_back());
    } catch (const std::exception &error) {
      throw std::invalid_argument(fmt::format("entry {} of `{}`: {}", entries.size(), key, error.what()));
    }
  }
  std::sort(entries.begin(), entries.end());
  return entries;
}

Result<Baseline> parse(std::string_view text) {
  try {
    const Json document = Json::parse(text);
    const int version = document.at("version");
    if (version != kVersion)
      return Error{fmt::format("is a baseline of version {}, but this feedhold reads version {}; use the version that "
                               "wrote it, or rewrite it with --update-baseline",
                               version, kVersion)};
    return Baseline{readAll<KnownFinding>(document, "findings"), readAll<KnownObligation>(document, "obligations")};
  } catch (const std::exception &error) {
    return Error{fmt::format("is not a valid baseline: {}; restore it from version control, or delete it and rewrite "
                             "it with --update-baseline",
                             error.what())};
  }
}

std::string counted(std::size_t count, std::string_view one, std::string_view many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

std::string nameOf(const KnownFinding &entry) {
  return fmt::format("{}: {}: {}", entry.path, entry.rule, entry.message);
}
std::string nameOf(const KnownObligation &entry) {
  return fmt::format("{}: {} ({})", entry.path, entry.id, prove::nameOf(entry.verdict));
}

template <typename Entry>
std::string told(std::size_t hidden, const std::vector<Entry> &gone, const BaselineOptions &options,
                 std::string_view one, std::string_view many) {
  std::string text = fmt::format("{} hidden by {}\n", counted(hidden, one, many), options.file);
  if (gone.empty())
    return text;
  text += fmt::format("{} of {} no longer occur{}; --update-baseline removes {}:\n",
                      counted(gone.size(), "entry", "entries"), options.file, gone.size() == 1 ? "s" : "",
                      gone.size() == 1 ? "it" : "them");
  for (std::size_t i = 0; i < std::min(gone.size(), kGoneShown); ++i)
    text += fmt::format("  {}\n", nameOf(gone[i]));
  if (gone.size() > kGoneShown)
    text += fmt::format("  and {} more\n", gone.size() - kGoneShown);
  return text;
}

/// How many of `a` are not in `b`.
template <typename Entry> std::size_t lacking(const std::vector<Entry> &a, const std::vector<Entry> &b) {
  std::vector<Entry> rest;
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(rest));
  return rest.size();
}

Result<Baseline> readBaseline(const BaselineOptions &options) {
  if (!options.isAsked())
    return Baseline{};
  std::error_code error;
  if (!fs::exists(options.file, error)) {
    if (options.update)
      return Baseline{};
    return Error{options.file + ": no such baseline file; create it with --update-baseline"};
  }
  const Result<SourceFile> file = SourceFile::open(options.file);
  if (!file)
    return Error{fmt::format("{}: {}", options.file, file.error().message)};
  Result<Baseline> baseline = parse(file.value().text());
  if (!baseline)
    return Error{fmt::format("{}: {}", options.file, baseline.error().message)};
  return baseline;
}

std::optional<Error> writeBaseline(const BaselineOptions &options, const Baseline &baseline) {
  return saveFile(options.file, fmt::format("{{\n  \"version\": {},\n  \"findings\": {},\n  \"obligations\": {}\n}}\n",
                                            kVersion, toText(baseline.findings), toText(baseline.obligations)));
}

/// `wrote 3 findings to FILE (1 new, 2 gone)`
std::string toldOfUpdate(const Baseline &before, const Baseline &after, const BaselineOptions &options) {
  return fmt::format("wrote {} and {} to {}: {} new, {} gone\n", counted(after.findings.size(), "finding", "findings"),
                     counted(after.obligations.size(), "verdict", "verdicts"), options.file,
                     lacking(after.findings, before.findings) + lacking(after.obligations, before.obligations),
                     lacking(before.findings, after.findings) + lacking(before.obligations, after.obligations));
}

} // namespace

void addBaselineOptions(CLI::App &app, BaselineOptions &options) {
  CLI::Option *file =
      app.add_option("--baseline", options.file, "report only what is not in this baseline file")->type_name("FILE");
  app.add_flag("--update-baseline", options.update,
               "write the current results to the baseline instead of reporting them")
      ->needs(file);
}

fs::path folderOf(const BaselineOptions &options) { return normalPath(absolutePath(options.file)).parent_path(); }

std::optional<Baseline> baselineToStart(const std::optional<std::string> &complaint, const BaselineOptions &options) {
  if (complaint) {
    printError(*complaint);
    return std::nullopt;
  }
  Result<Baseline> known = readBaseline(options);
  if (known)
    return known.take();
  printError(known.error().message);
  return std::nullopt;
}

int updateBaselineFile(const Baseline &before, const Baseline &after, const BaselineOptions &options,
                       std::span<const PathProblem> problems, UpdateTold wanted) {
  printProblems(problems);
  if (const auto error = writeBaseline(options, after)) {
    printError(options.file + ": " + error->message);
    return kExitCouldNotRun;
  }
  if (wanted == UpdateTold::Yes)
    print(toldOfUpdate(before, after, options));
  return problems.empty() ? kExitClean : kExitCouldNotRun;
}

void printProblems(std::span<const PathProblem> problems) {
  for (const PathProblem &problem : problems)
    printError(problem.path + ": " + problem.message);
}

std::string told(const NewFindings &found, const BaselineOptions &options) {
  return told(found.hidden, found.gone, options, "old finding is", "old findings are");
}

std::string told(const NewVerdicts &found, const BaselineOptions &options) {
  return told(found.hidden, found.gone, options, "old verdict is", "old verdicts are");
}

} // namespace feedhold
