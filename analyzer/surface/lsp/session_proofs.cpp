// Proofs in the background, with progress, and the commands about them.
#include "surface/lsp/session.h"

#include "surface/sink/prove_shown.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::lsp {

namespace {

struct KeptProofs {
  std::shared_ptr<const ProofsResult> result; // what the verdicts point into
  std::vector<DocumentProof> verdicts;
};

std::shared_ptr<const std::vector<DocumentProof>> verdictsOf(const std::shared_ptr<const ProofsResult> &result) {
  auto kept = std::make_shared<KeptProofs>(KeptProofs{result, {}});
  for (const ProvedFile &file : result->files)
    for (const ProvedProgram &program : file.programs)
      kept->verdicts.push_back({program.program, program.proof});
  return {kept, &kept->verdicts};
}

std::string summaryOf(const std::vector<DocumentProof> &verdicts) {
  VerdictCounts counts;
  for (const DocumentProof &each : verdicts)
    counts.add(each.proof);
  return counts.all() == 0 ? std::string("no program with a contract") : textOf(counts);
}

} // namespace

void ClientSession::startProofs(OpenDocument &document) {
  const std::string uri = document.document.uri;
  const auto programs = workspace_.programsOf(document);
  const bool isPromising = programs && !programs->file(FileId(0)).contracts.contracts.empty();
  if (!isPromising)
    return takeProofs(uri, document.stamp, std::make_shared<ProofsResult>());
  ProofOptions options{
      .files = workspace_.optionsFor(document), .cache = options_.cache, .which = ProofOptions::Which::WithContract};
  const std::string token = fmt::format("feedhold/proofs/{}", ++lastAsked_);
  beginProgress(token, uri, fmt::format("proving {}", std::filesystem::path(uri).filename().string()));
  proofLane_.submit(uri, [this, uri, stamp = document.stamp, options, token](const std::stop_token &stop) mutable {
    options.stop = stop;
    options.files.progress = [&](std::size_t done, std::size_t all) { reportProgress(token, done, all); };
    std::shared_ptr<ProofsResult> result;
    std::string failure;
    try {
      if (!stop.stop_requested())
        result = std::make_shared<ProofsResult>(proveAll(options, options_.known));
    } catch (const std::exception &error) {
      failure = error.what();
    }
    const bool isStopped = stop.stop_requested();
    queue_.push({.task = [this, uri, stamp, token, result, failure, isStopped] {
      if (!failure.empty())
        log(fmt::format("{}: {}", uri, failure));
      else if (!isStopped)
        takeProofs(uri, stamp, result);
      endProgress(token, isStopped ? "stopped" : result ? summaryOf(*verdictsOf(result)) : failure);
    }});
  });
}

void ClientSession::takeProofs(const std::string &uri, std::uint64_t stamp,
                               const std::shared_ptr<ProofsResult> &result) {
  OpenDocument *document = workspace_.find(uri);
  if (document == nullptr || document->stamp != stamp)
    return;
  document->verdicts = verdictsOf(result);
  document->proved = result;
  std::vector<PublishedDiagnostic> diagnostics;
  if (!result->files.empty()) {
    const ProvedFile &file = result->files.front();
    diagnostics = diagnosticsOfProofs(file, *result, publishContext());
    // The verdicts name places of the programs that were loaded for them.
    document->programs = std::shared_ptr<const Project>(result, file.project.get());
  }
  for (const PathProblem &problem : result->errors) // the findings say it, too
    log(fmt::format("{}: {}", problem.path, problem.message));
  const bool isNews = !diagnostics.empty() || !document->proofs.empty();
  document->proofs = std::move(diagnostics);
  if (isNews)
    publish(*document);
  if (refreshesHints_)
    ask("workspace/inlayHint/refresh", nullptr);
  if (refreshesLenses_)
    ask("workspace/codeLens/refresh", nullptr);
}

void ClientSession::beginProgress(const std::string &token, const std::string &work, const std::string &title) {
  if (!showsProgress_)
    return;
  progress_[token] = work;
  ask("window/workDoneProgress/create", {{"token", token}});
  notify("$/progress", {{"token", token},
                        {"value", {{"kind", "begin"}, {"title", title}, {"cancellable", true}, {"percentage", 0}}}});
}

void ClientSession::reportProgress(const std::string &token, std::size_t done, std::size_t all) {
  if (showsProgress_)
    notify("$/progress", {{"token", token},
                          {"value",
                           {{"kind", "report"},
                            {"message", fmt::format("{} of {} programs", done, all)},
                            {"percentage", done * 100 / all}}}});
}

void ClientSession::endProgress(const std::string &token, const std::string &message) {
  if (progress_.erase(token) != 0)
    notify("$/progress", {{"token", token}, {"value", {{"kind", "end"}, {"message", message}}}});
}

} // namespace feedhold::lsp
