// Stages: what an expectation fence can ask of the programs of a case.
#pragma once

#include "findings/rule/rule.h"
#include "language/dialect/dialect.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace feedhold::golden {

struct InputFile {
  std::string name;
  std::string text;
  const Dialect *dialect;
};

struct Input {
  std::vector<InputFile> files;
  std::vector<const Rule *> rules; // those that run
};

/// The text that a stage gives for the input; absent when there is no such stage.
std::optional<std::string> runStage(std::string_view stage, const Input &input);

} // namespace feedhold::golden
