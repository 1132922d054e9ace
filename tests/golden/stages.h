// Stages: what an expectation fence can ask of the programs of a case.
#pragma once

#include "findings/rule/rule.h"
#include "language/dialect/dialect.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace feedhold::golden {

struct InputFile {
  std::string name;
  std::string text;
};

struct Input {
  std::vector<InputFile> files;
  const Dialect *dialect = nullptr;  // of all files
  bool guess = false;                // `findings` finds the dialect, or a foreign language, by itself
  std::vector<std::string> rules;    // those that run; empty: all
  std::optional<std::string> config; // the text of a feedhold.toml beside the files
};

/// The text that a stage gives for the input; absent when there is no such stage.
std::optional<std::string> runStage(std::string_view stage, const Input &input);

} // namespace feedhold::golden
