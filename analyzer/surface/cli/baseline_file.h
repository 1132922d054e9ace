// Baseline files: `--baseline FILE`, read and written as JSON with one entry a line.
#pragma once

#include "findings/session/baseline.h"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <string>

namespace feedhold {

struct BaselineWish {
  std::string file; // empty: no baseline
  bool update = false;

  bool isAsked() const { return !file.empty(); }
};
/// `--baseline` and `--update-baseline`.
void addBaselineOptions(CLI::App &app, BaselineWish &wish);

/// Empty where none is asked for, or where it is not there and is about to be written.  Errors: not there, damaged, of
/// a newer version.
Result<Baseline> readBaseline(const BaselineWish &wish);
/// A reader sees the old bytes or the new ones.
std::optional<Error> writeBaseline(const BaselineWish &wish, const Baseline &baseline);

/// The folder that its paths start from.
std::filesystem::path folderOf(const BaselineWish &wish);

/// For people: `3 old findings hidden by FILE`, and what is in it and no longer in the programs.
std::string told(const NewFindings &found, const BaselineWish &wish);
std::string told(const NewVerdicts &found, const BaselineWish &wish);
/// `wrote 3 findings to FILE (1 new, 2 gone)`
std::string toldOfUpdate(const Baseline &before, const Baseline &after, const BaselineWish &wish);

} // namespace feedhold
