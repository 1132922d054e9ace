// Sinks: a check result as text of some format.  Files come by path, findings by place, then by rule.
#pragma once

#include "findings/rule/registry.h"
#include "findings/session/result.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace feedhold {

enum class Format { Text, Concise, Json, Sarif, Junit, Github };

std::string_view nameOf(Format format);
std::optional<Format> formatFromName(std::string_view name);

enum class ShowSuppressed { No, Yes };

/// All that a sink may look at.
struct Report {
  const CheckResult &result;
  const RuleRegistry &rules;
  std::string_view version = {};   // of the program
  std::filesystem::path root = {}; // absolute folder that paths in SARIF are relative to
  int exitCode = 0;
  ShowSuppressed showSuppressed = ShowSuppressed::No;
  bool colour = false;
};

/// Ends with a line feed unless it is empty.
std::string write(Format format, const Report &report);

/// For people, behind the findings: how many of what, which dialects were guessed, what to do next.
std::string summary(const Report &report);
/// For people: the files that are no programs and why, the first few by name.
std::string skippedFiles(const std::vector<SkippedFile> &skipped);
/// The number of findings of each rule, most first.
std::string statistics(const Report &report);

// The formats one by one.
std::string writeText(const Report &report);
std::string writeConcise(const Report &report);
std::string writeJson(const Report &report);
std::string writeSarif(const Report &report);
std::string writeJunit(const Report &report);
std::string writeGithub(const Report &report);

} // namespace feedhold
