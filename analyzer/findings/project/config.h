// Configuration: what one `feedhold.toml` says.
#pragma once

#include "findings/project/control_options.h"
#include "findings/rule/registry.h"
#include "language/dialect/registry.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace feedhold {

/// `[[files]]`: settings for the files whose path matches.
struct FilePattern {
  std::string path; // glob, from the folder of the configuration
  std::optional<std::string> dialect = std::nullopt;
  std::vector<std::string> select = {}; // replaces the rules chosen so far
  std::vector<std::string> ignore = {};
  std::vector<SwitchSetting> switches = {};
  std::optional<IncrementSystem> incrementSystem = std::nullopt;
  std::optional<GCodeSystem> gCodeSystem = std::nullopt;
};

struct SeveritySetting {
  std::string rule;
  Severity severity;
};

struct Config {
  std::filesystem::path folder; // patterns are relative to it
  std::optional<std::string> dialect = std::nullopt;
  std::vector<std::string> select = {}; // names of rules or categories; empty: all rules
  std::vector<std::string> ignore = {};
  std::optional<Severity> errorOn = std::nullopt;
  std::optional<Severity> minSeverity = std::nullopt;
  std::vector<std::string> include = {}; // further files to take from a folder
  std::vector<std::string> exclude = {};
  std::vector<FilePattern> files = {};
  std::vector<SwitchSetting> switches = {};
  std::optional<IncrementSystem> incrementSystem = std::nullopt;
  std::optional<GCodeSystem> gCodeSystem = std::nullopt;
  std::vector<CodeCall> codeCalls = {};
  std::vector<VariableRange> buildersVariables = {};
  std::vector<CodeName> buildersCodes = {}; // sorted, each once
  std::vector<SeveritySetting> severities = {};
};

struct ConfigError {
  std::uint32_t line = 1;
  std::uint32_t column = 1;
  std::string message; // lower case, no full stop
};

struct ConfigText {
  Config config;
  std::vector<ConfigError> errors; // in order of the text; with one, `config` is not to be used
};

/// The names that a configuration may use.
struct KnownNames {
  const DialectRegistry &dialects;
  const RuleRegistry &rules;
};

inline constexpr std::string_view kConfigFileName = "feedhold.toml";

/// `folder` becomes Config::folder.
ConfigText readConfig(std::string_view text, const std::filesystem::path &folder, const KnownNames &known);

/// All that a configuration may change about a dialect, as text: the same text, the same settings.
std::string textOf(const Switches &switches);

/// A pattern of the configuration against a path from the folder of the configuration.  A pattern without `/` is
/// one for the file name alone; one that names a folder covers all below it.
bool patternMatches(std::string_view pattern, std::string_view path);

/// The message for a rule or category that does not exist; absent when it does.
std::optional<std::string> complaintAboutRuleName(std::string_view name, const RuleRegistry &rules);
/// The message for a dialect that does not exist; absent when it does.
std::optional<std::string> complaintAboutDialect(std::string_view id, const DialectRegistry &dialects);

} // namespace feedhold
