#include "surface/cli/bundle_folder.h"

#include "base/source/path_text.h"
#include "base/source/source_file.h"
#include "base/source/write_file.h"
#include "base/support/system_words.h"
#include "surface/cli/platform.h"

#include <fmt/format.h>

namespace feedhold {

namespace fs = std::filesystem;

namespace {

/// Beside the folder, so that a move of it is one step.
fs::path beside(const fs::path &folder, std::string_view what) {
  fs::path path = normalPath(absolutePath(folder));
  if (!path.has_filename())
    path = path.parent_path();
  return path.string() + fmt::format(".{}-{}", what, processId());
}

std::optional<Error> writeAll(const fs::path &folder, const Bundle &bundle) {
  fs::create_directories(folder);
  for (const auto &[name, text] : bundle) {
    fs::create_directories((folder / name).parent_path());
    if (auto error = writeFile(folder / name, text))
      return error;
  }
  return std::nullopt;
}

} // namespace

void keepEvidence(ProofOptions &options) {
  options.steps = KeepSteps::Yes;
  options.prove.guards = prove::InferGuards::No;
  options.prove.arithmetic = prove::Arithmetic::Exact;
  options.prove.missing = MissingPrograms::DoAnything;
  options.prove.mayTakeFewPasses = false;
}

std::optional<Error> whyNoBundleFits(const fs::path &folder, std::string_view mark) {
  std::error_code error;
  if (!fs::exists(folder, error))
    return std::nullopt;
  if (!fs::is_directory(folder, error))
    return Error{"is not a folder"};
  if (!fs::is_empty(folder, error) && !fs::exists(folder / mark, error))
    return Error{fmt::format("contains other files; choose a new folder, or one with a {}", mark)};
  return error ? std::optional(Error{inWords(error)}) : std::nullopt;
}

std::optional<Error> writeBundle(const fs::path &folder, const Bundle &bundle) {
  const fs::path fresh = beside(folder, "new");
  const fs::path old = beside(folder, "old");
  std::error_code ignored;
  try {
    if (auto error = writeAll(fresh, bundle)) {
      fs::remove_all(fresh, ignored);
      return error;
    }
    if (fs::exists(folder))
      fs::rename(folder, old);
    fs::rename(fresh, folder);
    fs::remove_all(old, ignored);
    return std::nullopt;
  } catch (const fs::filesystem_error &error) {
    fs::remove_all(fresh, ignored);
    if (fs::exists(old, ignored) && !fs::exists(folder, ignored))
      fs::rename(old, folder, ignored);
    return Error{inWords(error.code())};
  }
}

Result<Bundle> readBundle(const fs::path &folder) {
  Bundle bundle;
  try {
    for (const fs::directory_entry &entry : fs::recursive_directory_iterator(folder)) {
      if (entry.is_directory())
        continue;
      const Result<SourceFile> file = SourceFile::open(entry.path());
      if (!file)
        return file.error();
      bundle.emplace(pathText(entry.path().lexically_relative(folder)), file.value().text());
    }
  } catch (const fs::filesystem_error &error) {
    return Error{inWords(error.code())};
  }
  return bundle;
}

} // namespace feedhold
