// Drafted contracts: the action that offers one, and the edit that creates its file.  A draft takes seconds, so that
// the action is a command, and the edit comes when the draft is ready.
#include "base/source/path_text.h"
#include "surface/lsp/session.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::lsp {

namespace {

/// A later draft takes the place of an earlier one; a proof of the same document does not.
std::string workOf(const std::string &uri) { return uri + "#draft"; }

} // namespace

/// At the head of a program that has no contract.
void ClientSession::addDraft(OpenDocument &document, Span asked, Json &actions) {
  const auto programs = createsFiles_ && appliesEdits_ ? workspace_.programsOf(document) : nullptr;
  if (!programs || document.isContract())
    return;
  const ProjectFile &file = programs->file(FileId(0));
  std::error_code ignored; // what is not on disk has no files beside it
  if (asked.end > file.source.text().size() || !std::filesystem::is_regular_file(file.path, ignored))
    return;
  const BlockId block = file.tree.blockAt(asked.begin);
  const ProgramId id = file.model.programs.empty() ? ProgramId(0) : file.model.programOf(block);
  if (file.model.programs.empty() || file.model.programs[id].first != block)
    return;
  const auto place = draftPlace(*programs, id);
  if (!place)
    return;
  const ProgramName &name = file.model.programs[id].name;
  const std::string program = name.empty() ? file.path.filename().string() : toString(name);
  const std::string title = fmt::format("draft a contract for {}", program);
  const Json argument = {{"uri", document.document.uri}, {"program", program}};
  actions.push_back({{"title", title},
                     {"kind", "refactor"},
                     {"command", {{"title", title}, {"command", "feedhold.draft"}, {"arguments", {argument}}}}});
}

void ClientSession::startDraft(OpenDocument &document, const std::string &program) {
  if (!createsFiles_ || !appliesEdits_)
    throw RequestError(ErrorCode::RequestFailed, "this editor does not create files for the server");
  const std::string uri = document.document.uri;
  DraftOptions options;
  options.files = workspace_.optionsFor(document);
  options.program = program;
  const std::string token = fmt::format("feedhold/drafts/{}", ++lastAsked_);
  const std::string subject = program.empty() ? std::filesystem::path(uri).filename().string() : program;
  beginProgress(token, workOf(uri), fmt::format("drafting contracts of {}", subject));
  proofLane_.submit(workOf(uri), [this, uri, subject, options, token](const std::stop_token &stop) mutable {
    options.stop = stop;
    options.files.progress = [&](std::size_t done, std::size_t all) { reportProgress(token, done, all); };
    auto result = std::make_shared<DraftResult>();
    std::string failure;
    try {
      if (!stop.stop_requested())
        *result = draftAll(options, options_.known);
    } catch (const std::exception &error) {
      failure = error.what();
    }
    const bool isStopped = stop.stop_requested();
    queue_.push({.task = [this, uri, token, subject, result, failure, isStopped] {
      if (!failure.empty())
        log(fmt::format("{}: {}", uri, failure));
      else if (!isStopped)
        takeDraft(subject, *result);
      endProgress(token, isStopped ? "stopped" : failure);
    }});
  });
}

void ClientSession::takeDraft(const std::string &subject, const DraftResult &result) {
  bool isNew = false;
  for (const DraftedProgram &drafted : result.programs) {
    if (!drafted.isChanged())
      continue;
    isNew = true;
    const std::string place = pathText(drafted.place);
    const SidecarClause file{.file = drafted.place,
                             .isNew = true,
                             .before = SourceFile::fromText(place, ""),
                             .edit = {{0, 0}, drafted.after},
                             .place = {}};
    ask("workspace/applyEdit",
        {{"label", fmt::format("draft a contract for {}", drafted.program)}, {"edit", sidecarEdit(file)}});
  }
  for (const PathProblem &problem : result.errors)
    log(fmt::format("{}: {}", problem.path, problem.message));
  if (!isNew)
    show(Severity::Info, fmt::format("nothing to draft for {}: no guard, comment or promise says anything about its "
                                     "calls",
                                     subject));
}

} // namespace feedhold::lsp
