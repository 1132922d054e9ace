// OpenTexts: what editors show of files, which counts instead of what lies on disk.
#pragma once

#include "base/source/source_file.h"

#include <filesystem>
#include <map>
#include <memory>
#include <string>

namespace feedhold {

/// By absolute path in normal form, and by the path without links where that is another one; in UTF-8.
using OpenTexts = std::map<std::filesystem::path, std::shared_ptr<const std::string>>;

/// The path without links.
std::filesystem::path placeOf(const std::filesystem::path &path);

/// The open text of the file, else what lies on disk: with `open`, as a copy of its own, since an editor's server holds
/// it while others write the file anew.  Errors as SourceFile::open.
Result<SourceFile> openSource(const std::filesystem::path &path, const std::shared_ptr<const OpenTexts> &open);

} // namespace feedhold
