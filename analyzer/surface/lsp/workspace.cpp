#include "surface/lsp/workspace.h"

#include "base/source/path_text.h"
#include "base/support/check.h"
#include "findings/project/discovery.h"

#include <algorithm>

namespace feedhold::lsp {

namespace fs = std::filesystem;

namespace {

/// Of a folder of the workspace: with more files, those of a document alone come first.
constexpr std::size_t kQuickFolder = 500;
/// With more files it is no folder of programs, and only looked at document by document.
constexpr std::size_t kLargestFolder = 20'000;

std::vector<PublishedDiagnostic> movedAll(const std::vector<PublishedDiagnostic> &diagnostics,
                                          const std::vector<TextChange> &changes) {
  std::vector<PublishedDiagnostic> result;
  for (const PublishedDiagnostic &published : diagnostics) {
    std::optional<PublishedDiagnostic> here = published;
    for (const TextChange &change : changes)
      if (here)
        here = moved(*here, change);
    if (here)
      result.push_back(std::move(*here));
  }
  return result;
}

} // namespace

OpenDocument &Workspace::add(Document document) {
  const std::string uri = document.uri;
  OpenDocument &open = documents_[uri];
  open.document = std::move(document);
  textChanged(open, {});
  return open;
}

void Workspace::remove(const std::string &uri) {
  documents_.erase(uri);
  textsChanged();
}

OpenDocument *Workspace::find(const std::string &uri) {
  const auto found = documents_.find(uri);
  return found == documents_.end() ? nullptr : &found->second;
}

void Workspace::textChanged(OpenDocument &changed, const std::vector<TextChange> &changes) {
  changed.denied = movedAll(changed.denied, changes);
  changed.flow = movedAll(changed.flow, changes);
  changed.proofs = movedAll(changed.proofs, changes);
  const fs::path folder = changed.document.path.parent_path();
  for (auto &[uri, open] : documents_) {
    if (&open != &changed && (folder.empty() || open.document.path.parent_path() != folder))
      continue;
    open.programs.reset();
    open.kept->forget();
    open.verdicts.reset();
    // Its findings stay as they are when another program changes; a contract is read with it.
    if (&open == &changed || changed.isContract()) {
      open.stamp = ++lastStamp_;
      open.isFlowKnown = false;
    }
  }
  textsChanged();
}

void Workspace::surroundingsChanged() {
  for (auto &[uri, open] : documents_) {
    open.stamp = ++lastStamp_;
    open.isFlowKnown = false;
    open.denied.clear();
    open.programs.reset();
    open.kept->forget();
    open.verdicts.reset();
  }
}

void Workspace::textsChanged() {
  OpenTexts texts;
  OpenUris uris;
  for (const auto &[uri, open] : documents_)
    if (!open.document.path.empty()) {
      texts[open.document.path] = open.document.text;
      texts.try_emplace(open.document.place, open.document.text);
      uris.add(open.document.path, uri);
    }
  texts_ = std::make_shared<const OpenTexts>(std::move(texts));
  uris_ = std::make_shared<const OpenUris>(std::move(uris));
}

CheckOptions Workspace::optionsFor(const OpenDocument &document) const {
  CheckOptions options;
  options.open = texts_;
  options.jobs = 1; // the editor has the other processors
  std::error_code ignored;
  const fs::path &path = document.document.path;
  if (document.isContract()) {
    options.paths = programsBeside(path);
    return options;
  }
  if (!path.empty() && fs::is_regular_file(path, ignored)) {
    options.paths = {pathText(path)};
    return options;
  }
  // Not on disk: a name in the first folder, so that its configuration holds.
  const fs::path name = !path.empty() ? path : fs::path(document.document.uri).filename();
  const fs::path folder = folders.empty() || !path.empty() ? fs::path() : folders.front();
  options.piped = PipedText{pathText((folder / name)), *document.document.text};
  return options;
}

FlowScope Workspace::scopeOf(const OpenDocument &document) {
  FlowScope scope{.alone = optionsFor(document)};
  const fs::path root = rootOf(document);
  if (root.empty() || scope.alone.paths.empty())
    return scope;
  const std::size_t files = filesBelow(root);
  if (files > kLargestFolder)
    return scope;
  scope.isLarge = files > kQuickFolder;
  scope.whole = scope.alone;
  scope.whole->only.emplace(scope.alone.paths.begin(), scope.alone.paths.end());
  scope.whole->paths.push_back(pathText(root));
  return scope;
}

fs::path Workspace::rootOf(const OpenDocument &document) const {
  fs::path innermost;
  for (const fs::path &folder : folders) {
    const fs::path relative = document.document.path.lexically_relative(folder);
    const bool isBelow = !relative.empty() && *relative.begin() != "..";
    if (isBelow && folder.native().size() > innermost.native().size())
      innermost = folder;
  }
  return innermost;
}

std::string Workspace::nameIn(const OpenDocument &document, const CheckOptions &options) {
  if (document.isContract())
    return pathText(document.document.path);
  return options.piped ? options.piped->name : options.paths.front();
}

/// Counted once, and no further than to the largest folder that is looked at as a whole.  One that cannot be counted,
/// like the root of a system, is none.
std::size_t Workspace::filesBelow(const fs::path &root) {
  const auto [known, isNew] = filesBelow_.try_emplace(root, 0);
  if (!isNew)
    return known->second;
  std::error_code error;
  for (fs::recursive_directory_iterator at(root, fs::directory_options::skip_permission_denied, error), end;
       !error && at != end && known->second <= kLargestFolder; at.increment(error)) {
    if (at->path().filename().native().starts_with('.'))
      at.disable_recursion_pending();
    ++known->second;
  }
  if (error)
    known->second = kLargestFolder + 1;
  return known->second;
}

std::vector<std::string> Workspace::programsBeside(const fs::path &contract) {
  std::vector<std::string> named, all;
  std::error_code error; // of a folder that cannot be listed there is nothing to say
  for (fs::directory_iterator at(contract.parent_path(), error), end; !error && at != end; at.increment(error)) {
    const fs::path path = at->path();
    std::error_code ignored;
    if (path.extension() == kContractExtension || !at->is_regular_file(ignored) ||
        !kindOfFileName(pathText(path.filename())))
      continue;
    all.push_back(pathText(path));
    if (path.filename() == contract.stem() || path.stem() == contract.stem())
      named.push_back(pathText(path));
  }
  return named.empty() ? all : named;
}

std::shared_ptr<const Project> Workspace::programsOf(OpenDocument &document) {
  if (document.programs || document.isContract())
    return document.programs;
  const CheckOptions options = optionsFor(document);
  const ProgramOptions program{.path = options.paths.empty() ? std::string() : options.paths.front(),
                               .piped = options.piped,
                               .open = options.open,
                               .store = &store_};
  if (auto loaded = loadProject(program, known_))
    document.programs = loaded.take();
  return document.programs;
}

View Workspace::viewOf(OpenDocument &document) {
  std::shared_ptr<const Project> programs = programsOf(document);
  FEEDHOLD_CHECK(programs != nullptr, "a view of what is no program");
  return {.uri = document.document.uri,
          .programs = std::move(programs),
          .proofs = document.verdicts,
          .known = known_,
          .encoding = encoding,
          .folders = folders,
          .open = texts_,
          .uris = uris_,
          .store = &store_,
          .flow = document.kept};
}

} // namespace feedhold::lsp
