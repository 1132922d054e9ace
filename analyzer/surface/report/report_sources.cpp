// The files that a report was made of, as they are now: where they were, or below another folder.
#include "base/source/path_text.h"
#include "base/support/sha256.h"
#include "surface/report/report_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace feedhold {

namespace fs = std::filesystem;
using certificate::Json;

namespace {

struct FoundSource {
  std::optional<fs::path> file = {};     // absent: it is not there
  std::optional<std::string> doubt = {}; // why it cannot be told which one it is, and a way out
};

std::vector<FoundSource> whereTheyWere(const std::vector<std::string> &paths, const fs::path &folder) {
  std::vector<FoundSource> found;
  for (const std::string &path : paths)
    found.push_back({normalPath(absolutePath(folder) / path)});
  return found;
}

using Names = std::vector<std::string>;

/// The names of folders and of the file; `..` is none.
Names namesIn(const fs::path &path) {
  Names names;
  for (const fs::path &part : normalPath(path))
    if (const std::string name = pathText(part); name != ".." && name != "." && name != "/")
      names.push_back(name);
  return names;
}

/// Of two paths that end alike, how far they do; one that stands in the folder just as it is named is before others.
struct Likeness {
  std::size_t names = 0;
  bool isWhole = false;
  friend auto operator<=>(const Likeness &, const Likeness &) = default;
};
Likeness likenessOf(const Names &source, const Names &file) {
  const auto end = std::mismatch(source.rbegin(), source.rend(), file.rbegin(), file.rend()).second;
  return {static_cast<std::size_t>(end - file.rbegin()), end == file.rend()};
}

std::string listed(const std::vector<std::string> &paths) { return fmt::format("`{}`", fmt::join(paths, "`, `")); }

/// Files of one name are told apart by the folders in which they lie.
class SourceSearch {
public:
  SourceSearch(const std::vector<std::string> &paths, const fs::path &place) : paths_(paths), place_(place) {
    std::set<std::string> wanted;
    for (const std::string &path : paths) {
      sources_.push_back(namesIn(path));
      if (!sources_.back().empty())
        wanted.insert(sources_.back().back());
    }
    std::error_code error;
    for (fs::recursive_directory_iterator at(place, fs::directory_options::skip_permission_denied, error), end;
         !error && at != end; at.increment(error))
      if (wanted.contains(at->path().filename().string()) && at->is_regular_file(error))
        files_.push_back(pathText(at->path().lexically_relative(place)));
    std::sort(files_.begin(), files_.end());
  }

  std::vector<FoundSource> find() const {
    std::vector<Match> matches;
    for (const Names &source : sources_)
      matches.push_back(bestFor(source));
    std::vector<FoundSource> found;
    for (std::size_t i = 0; i < matches.size(); ++i)
      found.push_back(settle(i, matches));
    return found;
  }

private:
  struct Match {
    Likeness likeness;
    std::vector<std::string> files; // below the folder; several: each is as like as the others
  };

  Match bestFor(const Names &source) const {
    Match best;
    for (const std::string &file : files_) {
      const Likeness likeness = likenessOf(source, namesIn(file));
      if (likeness.names == 0 || likeness < best.likeness)
        continue;
      if (likeness > best.likeness)
        best = {likeness, {}};
      best.files.push_back(file);
    }
    return best;
  }
  FoundSource settle(std::size_t index, const std::vector<Match> &matches) const {
    const Match &match = matches[index];
    if (match.files.empty())
      return {};
    if (match.files.size() > 1)
      return {{},
              fmt::format("it may be any of {} below `{}`: name a folder that holds only one of them",
                          listed(match.files), pathText(place_))};
    std::vector<std::string> rivals;
    for (std::size_t i = 0; i < matches.size(); ++i) {
      if (i == index || matches[i].files != match.files)
        continue;
      if (matches[i].likeness > match.likeness)
        return {}; // it is that one's
      if (matches[i].likeness == match.likeness)
        rivals.push_back(paths_[i]);
    }
    if (!rivals.empty())
      return {{},
              fmt::format("`{}` below `{}` may be this one or {}: name a folder that keeps the original "
                          "folder names",
                          match.files.front(), pathText(place_), listed(rivals))};
    return {place_ / match.files.front()};
  }

  const std::vector<std::string> &paths_;
  fs::path place_;
  std::vector<Names> sources_;
  std::vector<std::string> files_;
};

} // namespace

SourceCheck checkSources(const Bundle &report, const fs::path &folder, const std::optional<fs::path> &place) {
  SourceCheck result;
  const Result<Json> document = certificate::readDocument(report);
  if (!document)
    return result;
  try {
    const Json &sources = document.value().at("sources");
    std::vector<std::string> paths;
    for (const Json &source : sources)
      paths.push_back(source.at("path"));
    const std::vector<FoundSource> found = place ? SourceSearch(paths, *place).find() : whereTheyWere(paths, folder);
    for (std::size_t i = 0; i < paths.size(); ++i) {
      if (found[i].doubt) {
        result.changed.push_back(fmt::format("`{}`: {}", paths[i], *found[i].doubt));
        continue;
      }
      const auto now = found[i].file ? std::optional(SourceFile::open(*found[i].file)) : std::nullopt;
      if (!now || !*now)
        result.gone.push_back(paths[i]);
      else if (sha256(now->value().text()) != sources[i].at("sha256"))
        result.changed.push_back(fmt::format("`{}` has changed since it was proved", paths[i]));
      else
        ++result.same;
    }
  } catch (const Json::exception &) {
    result.changed.push_back(fmt::format("`{}` has been changed", kReportDocument));
  }
  return result;
}

} // namespace feedhold
