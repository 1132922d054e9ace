// Workload: the files of a run, loaded, each with the settings that hold for it.
#pragma once

#include "findings/project/config_finder.h"
#include "findings/project/control_options.h"
#include "findings/project/open_texts.h"
#include "findings/project/outcome.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace feedhold {

/// A program that comes from a pipe.
struct PipedText {
  std::string name; // the path that it stands for
  std::string text;
};

struct CheckOptions {
  std::vector<std::string> paths;
  std::optional<PipedText> piped = std::nullopt;
  ControlOptions control = {};
  std::vector<std::string> select = {}; // names that exist
  std::vector<std::string> ignore = {};
  std::optional<Severity> errorOn = std::nullopt;
  std::optional<Severity> minSeverity = std::nullopt;
  ConfigOptions config = {};
  unsigned jobs = 0;                          // 0: one per processor
  std::shared_ptr<const OpenTexts> open = {}; // of editors; null: none
  /// Which rules run: without those that follow the flow of programs, a file takes a fraction of the time.
  enum class Depth : std::uint8_t { All, WithoutFlow } depth = Depth::All;
  /// Files as they are shown, on which rules run; the others of the run are only there to be called.  Absent: all.
  std::optional<std::set<std::string>> only = std::nullopt;
  /// Called from several threads: files analysed so far, and all.
  std::function<void(std::size_t, std::size_t)> progress = {};
};

/// All that the settings say about a file.
struct Profile {
  Dialect dialect; // with the switches of the configuration
  std::vector<const Rule *> rules;
  std::vector<SeveritySetting> severities;
  Severity errorOn = Severity::Warning;
  Severity minSeverity = Severity::Warning; // of the findings that are shown; not above errorOn
};

struct WorkItem {
  std::string shown;
  std::filesystem::path path; // empty for a piped text
  SourceFile source;
  std::shared_ptr<const Profile> profile;
  DialectChoice choice;
  std::vector<std::string_view> reasons;
  const ForeignLanguage *foreign; // null: a language that we read
  bool isNamed = false;           // by a person, or by the text: for which control it was written is no guess
  bool hasMarks = false;          // the same, or this text or another one of the folder has marks of its control
};

/// The rule that says it of a file in another language.
inline constexpr std::string_view kForeignLanguageRule = "foreign-language";

struct Workload {
  std::vector<WorkItem> items; // by shown path
  std::vector<SkippedFile> skipped;
  std::vector<PathProblem> errors;
};

Workload loadWorkload(const CheckOptions &options, const KnownNames &known);

} // namespace feedhold
