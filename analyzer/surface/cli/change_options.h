// `--changed-since REV` and `--with-callers`: a run over what a change may concern.
#pragma once

#include "findings/session/affected.h"

#include <CLI/CLI.hpp>

#include <string>

namespace feedhold {

struct ChangeWish {
  std::string since; // a revision; empty: none
  bool withCallers = false;

  bool isAsked() const { return !since.empty() || withCallers; }
};
void addChangedSince(CLI::App &app, ChangeWish &wish);
void addWithCallers(CLI::App &app, ChangeWish &wish);

std::optional<std::string> complaintAbout(const ChangeWish &wish, const CheckOptions &options);

/// Of the files of `options`.  Errors: git refuses.
Result<Affected> affected(const ChangeWish &wish, const CheckOptions &options, const KnownNames &known);

} // namespace feedhold
