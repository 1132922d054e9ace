#include "findings/project/git_changes.h"

#include "base/source/path_text.h"
#include "base/support/process.h"
#include "base/support/text.h"

#include <fmt/format.h>

#include <optional>
#include <set>

namespace feedhold {

namespace fs = std::filesystem;

namespace {

/// What git wrote; absent: it refused.
Result<std::optional<std::string>> git(const fs::path &folder, std::vector<std::string> words) {
  words.insert(words.begin(), {"git", "-C", folder.string()});
  Result<ProcessOutput> run = runProgram(words, "", {});
  if (!run)
    return Error{"--changed-since needs git: " + run.error().message};
  if (run.value().end != ProcessOutput::End::Exited || run.value().exitCode != 0)
    return std::optional<std::string>();
  return std::optional(run.take().output);
}

fs::path folderOf(const std::string &path) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored))
    return path;
  const fs::path parent = fs::path(path).parent_path();
  return parent.empty() ? fs::path(".") : parent;
}

std::string withoutLineEnd(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r'))
    text.pop_back();
  return text;
}

/// Where the branch left the revision: what happened there since is no change of ours.
Result<std::string> startOf(const fs::path &repository, const std::string &revision) {
  auto commit = git(repository, {"rev-parse", "--verify", "--quiet", "--end-of-options", revision + "^{commit}"});
  if (!commit)
    return Error{commit.error()};
  if (!commit.value())
    return Error{fmt::format("{}: there is no revision `{}`; name a commit, a branch or a tag that `git log` knows (a "
                             "shallow clone may lack it)",
                             pathText(repository), revision)};
  const std::string hash = withoutLineEnd(*commit.value());
  const auto base = git(repository, {"merge-base", hash, "HEAD"});
  if (!base)
    return Error{base.error()};
  return base.value() ? withoutLineEnd(*base.value()) : hash;
}

std::optional<Error> addChanges(const fs::path &repository, const std::string &revision, std::set<fs::path> &changed) {
  const Result<std::string> start = startOf(repository, revision);
  if (!start)
    return start.error();
  const std::vector<std::vector<std::string>> questions = {
      {"diff", "--name-only", "-z", "--no-renames", "--no-ext-diff", "--ignore-submodules", start.value(), "--"},
      {"ls-files", "--others", "--exclude-standard", "-z"}};
  for (const std::vector<std::string> &question : questions) {
    const auto answer = git(repository, question);
    if (!answer)
      return answer.error();
    if (!answer.value())
      return Error{fmt::format("{}: `git {}` failed", pathText(repository), question.front())};
    std::string_view rest = *answer.value();
    while (!rest.empty()) {
      const std::string_view name = rest.substr(0, rest.find('\0'));
      changed.insert(normalPath(repository / name));
      rest.remove_prefix(std::min(name.size() + 1, rest.size()));
    }
  }
  return std::nullopt;
}

} // namespace

Result<std::vector<fs::path>> changedSince(const std::string &revision, const std::vector<std::string> &paths) {
  std::set<fs::path> repositories;
  for (const std::string &path : paths) {
    const fs::path folder = folderOf(path);
    // As this program spells the folder: git would follow links on the way to it.
    const auto up = git(folder, {"rev-parse", "--show-cdup"});
    if (!up)
      return up.error();
    if (!up.value())
      return Error{fmt::format(
          "{}: is not in a git repository that git can read (`git status` there says why); --changed-since needs one",
          pathText(folder))};
    repositories.insert(normalPath(absolutePath(folder / withoutLineEnd(*up.value()))) / "");
  }
  std::set<fs::path> changed;
  for (const fs::path &repository : repositories)
    if (auto error = addChanges(repository, revision, changed))
      return *error;
  return std::vector<fs::path>(changed.begin(), changed.end());
}

} // namespace feedhold
