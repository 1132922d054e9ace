// `--changed-since REV` and `--with-callers`: a run over what a change may concern.
#pragma once

#include "findings/project/affected.h"

#include <CLI/CLI.hpp>

#include <string>

namespace feedhold {

struct ChangeOptions {
  std::string since; // a revision; empty: none
  bool withCallers = false;

  bool isAsked() const { return !since.empty() || withCallers; }
};
void addChangedSince(CLI::App &app, ChangeOptions &change);
void addWithCallers(CLI::App &app, ChangeOptions &change);

std::optional<std::string> complaintAbout(const ChangeOptions &change, const CheckOptions &options);

/// Of the files of `options`.  Errors: git refuses.
Result<Affected> affected(const ChangeOptions &change, const CheckOptions &options, const KnownNames &known);

} // namespace feedhold
