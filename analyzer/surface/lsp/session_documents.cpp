// What happens when texts change: findings that need no flow analysis at once, all of them a moment later.  A file with
// contracts has those that the programs beside it have on it, whether they are open or not.
#include "surface/lsp/session.h"

#include "base/source/file_uri.h"
#include "base/source/write_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace feedhold::lsp {

namespace fs = std::filesystem;

namespace {

constexpr auto kUntilFlow = std::chrono::milliseconds(100); // of a pause in the typing
constexpr auto kUntilProofs = std::chrono::seconds(1);

} // namespace

void ClientSession::open(const Json &params) {
  OpenDocument &document = workspace_.add(openDocument(params.at("textDocument")));
  plan(document, Reason::Opened);
}

void ClientSession::change(const Json &params) {
  OpenDocument &document = documentOf(params);
  const auto changes = applyChanges(document.document, params.at("contentChanges"), workspace_.encoding);
  document.document.version = params.at("textDocument").at("version").get<std::int64_t>();
  workspace_.textChanged(document, changes);
  plan(document, Reason::Typed);
  for (auto &[uri, other] : workspace_.documents())
    if (&other != &document && other.isContract() != document.isContract() &&
        other.document.path.parent_path() == document.document.path.parent_path())
      plan(other, Reason::Typed); // a program and its contract
  planOthers(document);
}

void ClientSession::save(const Json &params) {
  const OpenDocument &saved = documentOf(params);
  for (auto &[uri, document] : workspace_.documents())
    if (&document == &saved || document.document.path.parent_path() == saved.document.path.parent_path())
      planProofs(document, Reason::Saved);
}

void ClientSession::close(const Json &params) {
  const OpenDocument &document = documentOf(params);
  const std::string uri = document.document.uri;
  flowLane_.drop(uri);
  proofLane_.drop(uri);
  planOthers(document);
  const std::map<std::string, Json> others = document.others;
  workspace_.remove(uri);
  publishOther(uri);
  for (const auto &[other, diagnostics] : others)
    publishOther(other);
}

OpenDocument &ClientSession::documentOf(const Json &params) {
  const auto uri = params.at("textDocument").at("uri").get<std::string>();
  OpenDocument *document = workspace_.find(uri);
  if (document == nullptr)
    throw RequestError(ErrorCode::InvalidParams, fmt::format("the document {} is not open", uri));
  return *document;
}

void ClientSession::plan(OpenDocument &document, Reason reason) {
  const Clock::time_point now = Clock::now();
  document.quickDue = now;
  document.flowDue = reason == Reason::Typed ? now + kUntilFlow : now;
  document.isFlowDueForOthers = false;
  flowLane_.drop(document.document.uri);
  planProofs(document, reason);
}

void ClientSession::planProofs(OpenDocument &document, Reason reason) {
  using Proofs = Settings::Proofs;
  if (reason == Reason::Typed)
    proofLane_.drop(document.document.uri);
  document.proofsDue.reset();
  if (document.verdicts)
    return;
  const Clock::time_point now = Clock::now();
  switch (settings_.proofs) {
  case Proofs::Off: break;
  case Proofs::OnSave:
    if (reason != Reason::Typed)
      document.proofsDue = now;
    break;
  case Proofs::OnType: document.proofsDue = reason == Reason::Typed ? now + kUntilProofs : now; break;
  }
}

void ClientSession::planAll() {
  workspace_.surroundingsChanged();
  for (auto &[uri, document] : workspace_.documents())
    plan(document, Reason::Opened);
}

std::optional<Clock::time_point> ClientSession::nextDue() const {
  std::optional<Clock::time_point> next;
  for (const auto &[uri, document] : workspace_.documents())
    for (const auto &due : {document.quickDue, document.flowDue, document.proofsDue})
      if (due && (!next || *due < *next))
        next = due;
  return next;
}

void ClientSession::workOnDue() {
  const Clock::time_point now = Clock::now();
  const auto isDue = [&](std::optional<Clock::time_point> &due) {
    if (!due || *due > now)
      return false;
    due.reset();
    return true;
  };
  std::vector<OpenDocument *> flowDue;
  for (auto &[uri, document] : workspace_.documents())
    try {
      if (isDue(document.quickDue))
        checkQuickly(document);
      if (isDue(document.flowDue))
        flowDue.push_back(&document);
      if (isDue(document.proofsDue) && !document.isContract())
        startProofs(document);
    } catch (const std::exception &error) {
      log(fmt::format("{}: {}", uri, error.what()));
    }
  startFlow(flowDue);
}

void ClientSession::checkQuickly(OpenDocument &document) {
  CheckOptions options = workspace_.optionsFor(document);
  options.depth = CheckOptions::Depth::WithoutFlow;
  const bool isThere = options.piped || !options.paths.empty();
  const CheckResult result = isThere ? check(options, options_.known) : CheckResult{};
  const std::string name = isThere ? Workspace::nameIn(document, options) : std::string();
  document.quick.clear();
  bool isKnown = false;
  for (std::size_t i = 0; i < result.files.size(); ++i)
    if (result.files[i].path == name) {
      document.quick = split(diagnosticsOfCheck(i, result, publishContext()), document.denied).fresh;
      isKnown = true;
    }
  if (!isKnown && !document.isContract())
    document.flow.clear(); // it is no program any more
  if (!document.isContract())
    complainAbout(result.errors);
  publish(document);
}

void ClientSession::publish(const OpenDocument &document) {
  // Those who pull get the findings when they ask.
  const std::array<const std::vector<PublishedDiagnostic> *, 3> all = {&document.proofs, &document.quick,
                                                                       &document.flow};
  notify("textDocument/publishDiagnostics",
         {{"uri", document.document.uri},
          {"version", document.document.version},
          {"diagnostics", diagnosticsOf(document, std::span(all).first(pullsDiagnostics_ ? 1 : all.size()))}});
}

void ClientSession::complainAbout(const std::vector<PathProblem> &problems) {
  for (const PathProblem &problem : problems)
    if (complaints_.insert(problem.path + problem.message).second)
      show(Severity::Error, fmt::format("{}: {}", problem.path, problem.message));
}

Json ClientSession::findingsOf(const OpenDocument &document) {
  const std::array<const std::vector<PublishedDiagnostic> *, 2> findings = {&document.quick, &document.flow};
  return diagnosticsOf(document, findings);
}

Json ClientSession::diagnosticsOf(const OpenDocument &document,
                                  std::span<const std::vector<PublishedDiagnostic> *const> lists) {
  const PublishContext context = publishContext();
  const std::string &uri = document.document.uri;
  const Places places(SourceFile::fromText({}, *document.document.text), workspace_.encoding);
  std::vector<const PublishedDiagnostic *> all;
  for (const std::vector<PublishedDiagnostic> *some : lists)
    for (const PublishedDiagnostic &published : *some)
      all.push_back(&published);
  std::stable_sort(all.begin(), all.end(), [](const PublishedDiagnostic *a, const PublishedDiagnostic *b) {
    return std::pair(a->span, std::string_view(a->code)) < std::pair(b->span, std::string_view(b->code));
  });
  Json diagnostics = Json::array();
  for (const PublishedDiagnostic *published : all)
    diagnostics.push_back(diagnosticOf(*published, places, uri, context));
  return diagnostics;
}

PublishContext ClientSession::publishContext() {
  return {.encoding = workspace_.encoding,
          .uriOf = [this](const fs::path &path) { return workspace_.uriOf(path); },
          .pageOf = [this](std::string_view rule) { return pageOf(rule); }};
}

/// The page is put where the editor can open it, once.
std::string ClientSession::pageOf(std::string_view rule) {
  const RegisteredRule *known = findRule(options_.known.rules, rule);
  if (!options_.pages || known == nullptr)
    return {};
  const auto [entry, isNew] = pages_.try_emplace(known->rule);
  if (!isNew)
    return entry->second;
  const fs::path place = *options_.pages / fmt::format("{}.md", rule);
  std::error_code error;
  fs::create_directories(*options_.pages, error);
  if (!error && !putFile(place, known->page))
    entry->second = uriOfPath(place);
  return entry->second;
}

} // namespace feedhold::lsp
