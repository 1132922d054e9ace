// What happens when texts change: findings that need no flow analysis at once, all of them a moment later.
#include "surface/lsp/session.h"

#include "base/source/write_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <tuple>

namespace feedhold::lsp {

namespace fs = std::filesystem;

namespace {

constexpr auto kUntilFlow = std::chrono::milliseconds(100); // of a pause in the typing
constexpr auto kUntilProofs = std::chrono::seconds(1);

/// Where the checked program itself is: a file with its contracts may come before it by name.
std::optional<std::size_t> indexOf(const CheckResult &result, const CheckOptions &options) {
  const std::string &name = options.piped ? options.piped->name : options.paths.front();
  const auto found = std::find_if(result.files.begin(), result.files.end(),
                                  [&](const CheckedFile &file) { return file.path == name; });
  if (found == result.files.end())
    return std::nullopt;
  return static_cast<std::size_t>(found - result.files.begin());
}

/// Those of `all` that are not among `some`.
std::vector<Remark> without(std::vector<Remark> all, const std::vector<Remark> &some) {
  using Key = std::tuple<Span, std::string_view, std::string_view>;
  const auto keyOf = [](const Remark &remark) { return Key{remark.span, remark.code, remark.message}; };
  std::set<Key> known;
  for (const Remark &remark : some)
    known.insert(keyOf(remark));
  std::erase_if(all, [&](const Remark &remark) { return known.contains(keyOf(remark)); });
  return all;
}

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
  std::set<std::string> told = document.others;
  told.insert(uri);
  workspace_.remove(uri);
  for (const std::string &each : told)
    notify("textDocument/publishDiagnostics", {{"uri", each}, {"diagnostics", Json::array()}});
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
  for (auto &[uri, document] : workspace_.documents())
    try {
      if (isDue(document.quickDue))
        document.isContract() ? checkContract(document) : checkQuickly(document);
      if (isDue(document.flowDue) && !document.isContract())
        startFlow(document);
      if (isDue(document.proofsDue) && !document.isContract())
        startProofs(document);
    } catch (const std::exception &error) {
      log(fmt::format("{}: {}", uri, error.what()));
    }
}

void ClientSession::checkQuickly(OpenDocument &document) {
  CheckOptions options = workspace_.optionsFor(document);
  options.depth = CheckOptions::Depth::WithoutFlow;
  const CheckResult result = check(options, options_.known);
  const auto own = indexOf(result, options);
  document.quick = own ? remarksOn(*own, result, remarkContext()) : std::vector<Remark>();
  if (!own)
    document.flow.clear();
  complainAbout(result.errors);
  publish(document);
  publishOthers(document, result);
}

/// By the programs that it is for, whether they are open or not.
void ClientSession::checkContract(OpenDocument &contract) {
  CheckOptions options = workspace_.optionsFor(contract);
  options.piped.reset();
  options.paths = Workspace::programsBeside(contract.document.path);
  options.depth = CheckOptions::Depth::WithoutFlow;
  const CheckResult result = options.paths.empty() ? CheckResult{} : check(options, options_.known);
  contract.quick.clear();
  for (std::size_t i = 0; i < result.files.size(); ++i)
    if (result.files[i].path == contract.document.path)
      contract.quick = remarksOn(i, result, remarkContext());
  publish(contract);
}

void ClientSession::startFlow(OpenDocument &document) {
  const std::string uri = document.document.uri;
  const auto stamp = document.stamp;
  flowLane_.submit(uri, [this, uri, stamp, options = workspace_.optionsFor(document)](const std::stop_token &stop) {
    if (stop.stop_requested())
      return;
    std::function<void()> task;
    try {
      auto result = std::make_shared<const CheckResult>(check(options, options_.known));
      task = [this, uri, stamp, result] {
        if (OpenDocument *found = workspace_.find(uri); found != nullptr && found->stamp == stamp)
          takeFlow(*found, *result);
      };
    } catch (const std::exception &error) {
      task = [this, uri, why = std::string(error.what())] { log(fmt::format("{}: {}", uri, why)); };
    }
    if (!stop.stop_requested())
      queue_.push({.task = std::move(task)});
  });
}

void ClientSession::takeFlow(OpenDocument &document, const CheckResult &result) {
  const auto own = indexOf(result, workspace_.optionsFor(document));
  std::vector<Remark> all = own ? remarksOn(*own, result, remarkContext()) : std::vector<Remark>();
  document.flow = without(std::move(all), document.quick);
  document.isFlowKnown = true;
  if (pullsDiagnostics_ && refreshesDiagnostics_)
    ask("workspace/diagnostic/refresh", nullptr);
  publish(document);
  publishOthers(document, result);
}

void ClientSession::publish(const OpenDocument &document) {
  // Those who pull get the findings when they ask.
  const std::array<const std::vector<Remark> *, 3> all = {&document.proofs, &document.quick, &document.flow};
  notify("textDocument/publishDiagnostics",
         {{"uri", document.document.uri},
          {"version", document.document.version},
          {"diagnostics", diagnosticsOf(document, std::span(all).first(pullsDiagnostics_ ? 1 : all.size()))}});
}

void ClientSession::publishOthers(OpenDocument &document, const CheckResult &result) {
  const RemarkContext context = remarkContext();
  const auto own = indexOf(result, workspace_.optionsFor(document));
  std::map<std::string, Json> found;
  for (const std::string &uri : document.others)
    found[uri] = Json::array(); // no longer
  document.others.clear();
  for (std::size_t i = 0; i < result.files.size(); ++i) {
    if (i == own)
      continue;
    const std::string uri = context.uriOf(result.files[i].path);
    if (workspace_.find(uri) != nullptr)
      continue; // it speaks for itself
    const Places places(result.files[i].source, workspace_.encoding);
    found[uri] = Json::array();
    for (const Remark &remark : remarksOn(i, result, context))
      found[uri].push_back(diagnosticOf(remark, places, uri, context));
    document.others.insert(uri);
  }
  for (auto &[uri, diagnostics] : found)
    notify("textDocument/publishDiagnostics", {{"uri", uri}, {"diagnostics", std::move(diagnostics)}});
}

void ClientSession::complainAbout(const std::vector<PathProblem> &problems) {
  for (const PathProblem &problem : problems)
    if (complaints_.insert(problem.path + problem.message).second)
      show(Severity::Error, fmt::format("{}: {}", problem.path, problem.message));
}

Json ClientSession::diagnosticsOf(const OpenDocument &document, std::span<const std::vector<Remark> *const> remarks) {
  const RemarkContext context = remarkContext();
  const std::string &uri = document.document.uri;
  const Places places(SourceFile::fromText({}, *document.document.text), workspace_.encoding);
  std::vector<const Remark *> all;
  for (const std::vector<Remark> *some : remarks)
    for (const Remark &remark : *some)
      all.push_back(&remark);
  std::stable_sort(all.begin(), all.end(), [](const Remark *a, const Remark *b) {
    return std::pair(a->span, std::string_view(a->code)) < std::pair(b->span, std::string_view(b->code));
  });
  Json diagnostics = Json::array();
  for (const Remark *remark : all)
    diagnostics.push_back(diagnosticOf(*remark, places, uri, context));
  return diagnostics;
}

RemarkContext ClientSession::remarkContext() {
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
