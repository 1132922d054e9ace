// Finds, opens and looks at the files in parallel, then settles what holds for each.
#include "findings/project/workload.h"

#include "base/source/path_text.h"
#include "base/support/parallel.h"
#include "findings/project/content.h"
#include "findings/project/discovery.h"
#include "findings/project/remaps.h"
#include "findings/project/selection.h"
#include "language/dialect/folder_vote.h"
#include "language/dialect/g_code_system.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <tuple>
#include <unordered_map>

namespace feedhold {

namespace {

/// One file between finding it and knowing its settings.
struct Candidate {
  FoundFile found;
  std::optional<SourceFile> source = std::nullopt;
  LanguageGuess guess = {};
  std::optional<std::string> problem = std::nullopt;
  std::optional<std::string> skipReason = std::nullopt;
};

struct Settings {
  std::vector<const FilePattern *> patterns; // of the configuration, those that match
  const Dialect *dialect = nullptr;
  DialectChoice choice = DialectChoice::Fallback;
  std::vector<CodeName> remapped = {};                   // by the `.ini` files of the machine
  std::optional<GCodeSystem> gCodeSystem = std::nullopt; // as the text shows
};

void look(Candidate &candidate, const KnownNames &known) {
  const std::string_view text = candidate.source->text();
  if (const auto reason = whyNotText(text))
    candidate.skipReason = std::string(*reason);
  else
    candidate.guess = guessLanguage(text, candidate.found.shown, known.dialects);
}

void open(Candidate &candidate, const CheckOptions &options, const KnownNames &known) {
  Result<SourceFile> source = openSource(candidate.found.path, options.open);
  if (!source) {
    candidate.problem = source.error().message;
    return;
  }
  candidate.source = source.take();
  look(candidate, known);
}

std::vector<const FilePattern *> matchingPatterns(const FoundFile &file) {
  std::vector<const FilePattern *> matching;
  if (file.config->files.empty())
    return matching;
  const std::filesystem::path absolute = normalPath(absolutePath(file.path));
  const std::string relative = pathText(absolute.lexically_relative(file.config->folder));
  for (const FilePattern &pattern : file.config->files)
    if (patternMatches(pattern.path, relative))
      matching.push_back(&pattern);
  return matching;
}

DialectChoice choiceOf(GuessBasis basis) {
  switch (basis) {
  case GuessBasis::Text: return DialectChoice::Guess;
  case GuessBasis::Neighbours: return DialectChoice::FolderVote;
  case GuessBasis::Nothing: return DialectChoice::Fallback;
  }
  FEEDHOLD_UNREACHABLE("what a guess rests on");
}

std::filesystem::path folderOf(const std::filesystem::path &file) {
  return normalPath(absolutePath(file)).parent_path();
}

/// The folders that were named.  A person names one, a hook thousands of files.
class NamedFolders {
public:
  explicit NamedFolders(const CheckOptions &options) {
    for (const std::string &path : options.paths)
      places_.try_emplace((normalPath(absolutePath(path)) / "").parent_path().native(), places_.size());
  }

  /// The folder of a file and those above it, up to the one that was named: of several the first.
  std::vector<std::filesystem::path> above(const std::filesystem::path &file) const {
    std::vector<std::filesystem::path> folders = {folderOf(file)};
    std::size_t count = 1; // of those up to the named one
    std::size_t first = places_.size();
    while (true) {
      const auto named = places_.find(folders.back().native());
      if (named != places_.end() && named->second < first) {
        first = named->second;
        count = folders.size();
      }
      if (!folders.back().has_relative_path())
        break;
      folders.push_back(folders.back().parent_path());
    }
    folders.resize(count);
    return folders;
  }

private:
  std::unordered_map<std::filesystem::path::string_type, std::size_t> places_;
};

class Settler {
public:
  Settler(const CheckOptions &options, const KnownNames &known) : options_(options), known_(known), named_(options) {}

  Settings settle(const Candidate &candidate) {
    Settings settings;
    settings.patterns = matchingPatterns(candidate.found);
    const auto choose = [&](std::string_view id, DialectChoice choice) {
      settings.dialect = findDialect(known_.dialects, id);
      settings.choice = choice;
    };
    settings.dialect = known_.dialects.dialects.front();
    if (candidate.guess.dialect != nullptr)
      choose(candidate.guess.dialect->id, choiceOf(candidate.guess.basis));
    if (candidate.found.config->dialect)
      choose(*candidate.found.config->dialect, DialectChoice::Config);
    for (const FilePattern *pattern : settings.patterns)
      if (pattern->dialect)
        choose(*pattern->dialect, DialectChoice::FilePattern);
    if (options_.control.dialect)
      choose(*options_.control.dialect, DialectChoice::Option);
    if (settings.dialect->grammar.oWords && options_.config.source != ConfigSource::None)
      settings.remapped = remaps_.inFolders(named_.above(
          candidate.found.path.empty() ? std::filesystem::path(candidate.found.shown) : candidate.found.path));
    if (!settings.dialect->gCodesOfSystem.front().empty())
      settings.gCodeSystem = candidate.guess.gCodeSystem;
    return settings;
  }

  /// The G code system that a person has named.
  std::optional<GCodeSystem> namedSystem(const Config &config, const Settings &settings) const {
    std::optional<GCodeSystem> system = config.gCodeSystem;
    for (const FilePattern *pattern : settings.patterns)
      system = pattern->gCodeSystem ? pattern->gCodeSystem : system;
    return options_.control.gCodeSystem ? options_.control.gCodeSystem : system;
  }

  /// The settings of one configuration and one set of patterns are made once: thousands of files share them.
  std::shared_ptr<const Profile> profileFor(const Config &config, const Settings &settings) {
    const Key key{&config, settings.dialect, settings.patterns, settings.remapped, settings.gCodeSystem};
    const auto known = profiles_.find(key);
    if (known != profiles_.end())
      return known->second;
    return profiles_[key] = std::make_shared<const Profile>(makeProfile(config, settings));
  }

private:
  using Key = std::tuple<const Config *, const Dialect *, std::vector<const FilePattern *>, std::vector<CodeName>,
                         std::optional<GCodeSystem>>;

  Profile makeProfile(const Config &config, const Settings &settings) const {
    using Kind = SelectionStep::Kind;
    std::vector<SelectionStep> steps = {{Kind::Select, config.select}, {Kind::Ignore, config.ignore}};
    Profile profile{.dialect = *settings.dialect, .rules = {}, .severities = config.severities};
    Switches &switches = profile.dialect.switches;
    apply(config.switches, config.incrementSystem, switches);
    for (const FilePattern *pattern : settings.patterns) {
      steps.push_back({Kind::Select, pattern->select});
      steps.push_back({Kind::Ignore, pattern->ignore});
      apply(pattern->switches, pattern->incrementSystem, switches);
    }
    apply(options_.control.switches, options_.control.incrementSystem, switches);
    const auto seen = settings.gCodeSystem.value_or(GCodeSystem::A);
    chooseGCodeSystem(profile.dialect, namedSystem(config, settings).value_or(seen));
    if (!config.codeCalls.empty())
      switches.codeCalls = config.codeCalls;
    switches.buildersVariables = config.buildersVariables;
    std::set_union(config.buildersCodes.begin(), config.buildersCodes.end(), settings.remapped.begin(),
                   settings.remapped.end(), std::back_inserter(switches.buildersCodes));
    steps.push_back({Kind::Select, options_.select});
    steps.push_back({Kind::Ignore, options_.ignore});
    profile.rules = selectRules(known_.rules, steps);
    if (options_.depth == CheckOptions::Depth::WithoutFlow)
      std::erase_if(profile.rules, [](const Rule *rule) { return rule->hooks.asksFlow(); });
    profile.errorOn = options_.errorOn.value_or(config.errorOn.value_or(Severity::Warning));
    profile.minSeverity = std::min(profile.errorOn, minSeverity(config));
    return profile;
  }

  /// A person who names rules wants to see what they find.
  Severity minSeverity(const Config &config) const {
    const Severity unset = options_.select.empty() ? config.minSeverity.value_or(Severity::Warning) : Severity::Info;
    return options_.minSeverity.value_or(unset);
  }

  static void apply(const std::vector<SwitchSetting> &settings, std::optional<IncrementSystem> increments,
                    Switches &switches) {
    for (const SwitchSetting &setting : settings)
      switches.*setting.which = setting.value;
    switches.incrementSystem = increments.value_or(switches.incrementSystem);
  }

  const CheckOptions &options_;
  const KnownNames &known_;
  NamedFolders named_;
  RemapFinder remaps_;
  std::map<Key, std::shared_ptr<const Profile>> profiles_;
};

/// A person who names a file together with a dialect, or gives its pattern one, overrules the looks of the text.
bool isInsistedOn(const Candidate &candidate, DialectChoice choice) {
  switch (choice) {
  case DialectChoice::Option: return candidate.found.foundBy == FoundBy::Name;
  case DialectChoice::FilePattern: return true;
  case DialectChoice::Config:
  case DialectChoice::Guess:
  case DialectChoice::FolderVote:
  case DialectChoice::Fallback: return false;
  }
  FEEDHOLD_UNREACHABLE("a way to choose a dialect");
}

bool isGuessed(DialectChoice choice) {
  switch (choice) {
  case DialectChoice::Option:
  case DialectChoice::FilePattern:
  case DialectChoice::Config: return false;
  case DialectChoice::Guess:
  case DialectChoice::FolderVote:
  case DialectChoice::Fallback: return true;
  }
  FEEDHOLD_UNREACHABLE("a way to choose a dialect");
}

/// Why the file is no business of ours, when it is not.
std::optional<std::string> whySkipped(const Candidate &candidate, DialectChoice choice) {
  const bool hasSign = candidate.found.foundBy != FoundBy::Content || candidate.guess.hasCodes;
  if ((candidate.guess.looksLikeProgram && hasSign) || isInsistedOn(candidate, choice))
    return std::nullopt;
  const bool dialectIsSet = choice == DialectChoice::Option || choice == DialectChoice::Config;
  if (dialectIsSet && candidate.found.foundBy != FoundBy::Content)
    return std::nullopt;
  return "does not look like an NC program; to check it anyway, name the file and give --dialect";
}

/// Turns candidates into work, one after the other, in their order.
class Sorter {
public:
  Sorter(const CheckOptions &options, const KnownNames &known) : settler_(options, known) {}

  void sort(Candidate &candidate) {
    if (candidate.problem) {
      result_.errors.push_back({candidate.found.shown, *candidate.problem});
      return;
    }
    const Settings settings = candidate.skipReason ? Settings{} : settler_.settle(candidate);
    if (!candidate.skipReason)
      candidate.skipReason = whySkipped(candidate, settings.choice);
    if (candidate.skipReason) {
      const bool isOther = candidate.found.foundBy == FoundBy::Content || candidate.skipReason == kEmptyFile;
      result_.skipped.push_back(
          {candidate.found.shown, *candidate.skipReason, isOther ? SkipKind::NoProgram : SkipKind::Refused});
      return;
    }
    addItem(candidate, settings);
  }

  Workload finish() { return std::move(result_); }

private:
  void addItem(const Candidate &candidate, const Settings &settings) {
    std::shared_ptr<const Profile> profile = settler_.profileFor(*candidate.found.config, settings);
    const ForeignLanguage *foreign = isInsistedOn(candidate, settings.choice) ? nullptr : candidate.guess.foreign;
    if (foreign != nullptr && !runsForeignRule(*profile)) {
      result_.skipped.push_back(
          {candidate.found.shown, fmt::format("{}, which Feedhold does not read", foreign->name)});
      return;
    }
    std::vector<std::string_view> reasons;
    const bool isGuess = isGuessed(settings.choice);
    if ((isGuess && settings.choice != DialectChoice::Fallback) || foreign != nullptr)
      reasons = candidate.guess.reasons;
    const GCodeSystem system = profile->dialect.switches.gCodeSystem;
    if (system != GCodeSystem::A && !settler_.namedSystem(*candidate.found.config, settings))
      reasons.push_back(marksOf(system));
    result_.items.push_back({candidate.found.shown, candidate.found.path, *candidate.source, std::move(profile),
                             settings.choice, std::move(reasons), foreign, !isGuess || candidate.guess.namesControl,
                             !isGuess || candidate.guess.hasOwnMarks});
  }

  static bool runsForeignRule(const Profile &profile) {
    return std::any_of(profile.rules.begin(), profile.rules.end(),
                       [](const Rule *rule) { return rule->info.name == kForeignLanguageRule; });
  }

  Settler settler_;
  Workload result_;
};

/// The other programs of the folders of which only single files were named: they vote, whatever is checked.
std::vector<Candidate> silentVoters(const std::vector<Candidate> &candidates, const CheckOptions &options,
                                    const KnownNames &known) {
  std::set<std::filesystem::path> here, folders;
  for (const Candidate &candidate : candidates) {
    here.insert(normalPath(absolutePath(candidate.found.path)));
    if (candidate.found.foundBy == FoundBy::Name)
      folders.insert(folderOf(candidate.found.path));
  }
  ConfigFinder configs(options.config, known);
  std::vector<Candidate> voters;
  for (const std::filesystem::path &folder : folders)
    for (FoundFile &file : discoverFolder(folder, configs))
      if (!here.contains(file.path))
        voters.push_back({std::move(file)});
  parallelFor(voters.size(), options.jobs, [&](std::size_t i) { open(voters[i], options, known); });
  return voters;
}

/// The files of a folder decide together for which control they were written; where too few of them say the same, those
/// of the folder above do.
void vote(std::vector<Candidate> &candidates, const CheckOptions &options, const KnownNames &known) {
  if (options.control.dialect)
    return;
  const NamedFolders named(options);
  std::map<std::filesystem::path, FolderVote> votes;
  const auto add = [&](const Candidate &candidate) {
    for (const std::filesystem::path &folder : named.above(candidate.found.path))
      votes.try_emplace(folder, known.dialects).first->second.add(candidate.guess);
  };
  for (const Candidate &candidate : candidates)
    add(candidate);
  for (const Candidate &candidate : silentVoters(candidates, options, known))
    add(candidate);
  for (Candidate &candidate : candidates) {
    const std::vector<std::filesystem::path> folders = named.above(candidate.found.path);
    const auto clear = std::find_if(folders.begin(), folders.end(),
                                    [&](const std::filesystem::path &folder) { return votes.at(folder).isClear(); });
    const bool isOfOwn = clear == folders.end() || clear == folders.begin();
    const FolderVote &asked = votes.at(isOfOwn ? folders.front() : *clear);
    LanguageGuess decided = asked.decide(candidate.guess);
    // The machine of a few programs in another folder is not that of this one.
    const bool isAnother = decided.dialect != nullptr && decided.dialect != candidate.guess.dialect;
    if (isOfOwn || !isAnother || asked.speaksFor(decided.dialect))
      candidate.guess = std::move(decided);
  }
}

Candidate pipedCandidate(const PipedText &piped, ConfigFinder &configs, const KnownNames &known) {
  const std::filesystem::path folder = std::filesystem::path(piped.name).parent_path();
  Candidate candidate{{{}, piped.name, FoundBy::Name, configs.forFolder(folder.empty() ? "." : folder)}};
  candidate.source = SourceFile::fromText(piped.name, piped.text);
  look(candidate, known);
  return candidate;
}

} // namespace

Workload loadWorkload(const CheckOptions &options, const KnownNames &known) {
  ConfigFinder configs(options.config, known);
  Discovery discovery = discover(options.paths, configs);
  std::vector<Candidate> candidates;
  candidates.reserve(discovery.files.size() + 1);
  for (FoundFile &file : discovery.files)
    candidates.push_back({std::move(file)});
  parallelFor(candidates.size(), options.jobs, [&](std::size_t i) { open(candidates[i], options, known); });
  vote(candidates, options, known);
  if (options.piped)
    candidates.push_back(pipedCandidate(*options.piped, configs, known));

  Sorter sorter(options, known);
  for (Candidate &candidate : candidates)
    if (candidate.found.config != nullptr)
      sorter.sort(candidate);
  Workload workload = sorter.finish();
  workload.skipped.insert(workload.skipped.end(), discovery.others.begin(), discovery.others.end());
  std::stable_sort(workload.skipped.begin(), workload.skipped.end(),
                   [](const SkippedFile &a, const SkippedFile &b) { return a.path < b.path; });
  workload.errors.insert(workload.errors.begin(), discovery.problems.begin(), discovery.problems.end());
  workload.errors.insert(workload.errors.begin(), configs.problems().begin(), configs.problems().end());
  return workload;
}

} // namespace feedhold
