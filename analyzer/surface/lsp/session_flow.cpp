// Findings that follow the flow: of a document alone, then as `check` of the folder of the workspace has them, where
// programs in other files call it, are called by it, or share a file with contracts.
#include "base/source/path_text.h"
#include "surface/lsp/session.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::lsp {

namespace {

constexpr auto kUntilOthers = std::chrono::milliseconds(500);

std::optional<std::size_t> indexOf(const CheckResult &result, const std::string &name) {
  const auto found = std::find_if(result.files.begin(), result.files.end(),
                                  [&](const CheckedFile &file) { return file.path == name; });
  if (found == result.files.end())
    return std::nullopt;
  return static_cast<std::size_t>(found - result.files.begin());
}

/// With the programs that share a file of contracts with those of `options.only`: what one of them uses there is not
/// unused.
CheckResult checkWhole(CheckOptions options, const KnownNames &known) {
  CheckResult result = check(options, known);
  std::set<std::string> sidecars;
  for (const CheckedFile &file : result.files)
    if (options.only->contains(file.path))
      sidecars.insert(file.sidecars.begin(), file.sidecars.end());
  const std::size_t before = options.only->size();
  for (const CheckedFile &file : result.files)
    if (std::any_of(file.sidecars.begin(), file.sidecars.end(),
                    [&](const std::string &path) { return sidecars.contains(path); }))
      options.only->insert(file.path);
  return options.only->size() == before ? std::move(result) : check(options, known);
}

} // namespace

void ClientSession::startFlow(const std::vector<OpenDocument *> &due) {
  std::map<std::string, FlowJob> jobs; // one for all documents of a folder that is looked at as a whole
  for (OpenDocument *document : due) {
    FlowScope scope = workspace_.scopeOf(*document);
    const std::string &uri = document->document.uri;
    FlowSubject subject{.uri = uri,
                        .stamp = document->stamp,
                        .name = Workspace::nameIn(*document, scope.alone),
                        .isForOthers = std::exchange(document->isFlowDueForOthers, false)};
    const auto [job, isNew] =
        jobs.try_emplace(scope.whole ? pathText(workspace_.rootOf(*document)) : uri, FlowJob{{}, scope});
    if (!isNew) {
      CheckOptions &whole = *job->second.scope.whole;
      whole.paths.insert(whole.paths.begin(), scope.whole->paths.begin(), scope.whole->paths.end());
      whole.only->insert(scope.whole->only->begin(), scope.whole->only->end());
    }
    job->second.subjects.push_back(std::move(subject));
  }
  for (auto &[folder, job] : jobs)
    submit(std::move(job));
}

void ClientSession::submit(FlowJob job) {
  const FlowSubject &first = job.subjects.front();
  const bool isOfOne = job.subjects.size() == 1;
  const bool isAloneFirst = !job.scope.whole || (job.scope.isLarge && isOfOne && !first.isForOthers);
  // A run for several documents is not stopped by a change of one of them.
  const std::string key = isOfOne ? first.uri : fmt::format("folder/{}", ++lastAsked_);
  flowLane_.submit(key, [this, job = std::move(job), isAloneFirst](const std::stop_token &stop) {
    const FlowScope &scope = job.scope;
    if (isAloneFirst && !stop.stop_requested())
      findFlow(job.subjects, scope.alone, scope.whole ? Stage::Alone : Stage::Last);
    if (scope.whole && !stop.stop_requested())
      findFlow(job.subjects, *scope.whole, Stage::Last);
  });
}

/// In a thread of the lane.  What a newer text has overtaken is dropped when it comes.
void ClientSession::findFlow(const std::vector<FlowSubject> &subjects, const CheckOptions &options, Stage stage) {
  std::function<void()> task;
  try {
    auto result = std::make_shared<const CheckResult>(options.only ? checkWhole(options, options_.known)
                                                                   : check(options, options_.known));
    task = [this, subjects, stage, result] {
      for (const FlowSubject &subject : subjects)
        if (OpenDocument *found = workspace_.find(subject.uri); found != nullptr && found->stamp == subject.stamp)
          takeFlow(*found, *result, subject, stage);
    };
  } catch (const std::exception &error) {
    task = [this, uri = subjects.front().uri, why = std::string(error.what())] {
      log(fmt::format("{}: {}", uri, why));
    };
  }
  queue_.push({.task = std::move(task)});
}

void ClientSession::takeFlow(OpenDocument &document, const CheckResult &result, const FlowSubject &subject,
                             Stage stage) {
  const auto own = indexOf(result, subject.name);
  const Json before = subject.isForOthers ? findingsOf(document) : Json();
  std::vector<PublishedDiagnostic> all =
      own ? diagnosticsOfCheck(*own, result, publishContext()) : std::vector<PublishedDiagnostic>();
  if (stage == Stage::Alone) {
    all = split(std::move(all), document.denied).fresh;
  } else {
    std::vector<PublishedDiagnostic> denied = std::move(document.denied);
    for (const std::vector<PublishedDiagnostic> *some : {&document.quick, &document.flow})
      denied.insert(denied.end(), some->begin(), some->end());
    document.denied = split(std::move(denied), all).fresh;
    document.isFlowKnown = true;
  }
  const std::vector<PublishedDiagnostic> quick = std::move(document.quick);
  document.quick = split(quick, all).known;
  document.flow = split(std::move(all), quick).fresh;
  if (own && !document.isContract())
    publishOthers(document, result, *own);
  if (subject.isForOthers && before == findingsOf(document))
    return;
  if (pullsDiagnostics_ && refreshesDiagnostics_)
    ask("workspace/diagnostic/refresh", nullptr);
  publish(document);
}

/// For a client that asks and cannot be told later.
void ClientSession::findFlowNow(OpenDocument &document) {
  document.flowDue.reset();
  const FlowScope scope = workspace_.scopeOf(document);
  const CheckResult result =
      scope.whole ? checkWhole(*scope.whole, options_.known) : check(scope.alone, options_.known);
  takeFlow(document, result, {document.document.uri, document.stamp, Workspace::nameIn(document, scope.alone)},
           Stage::Last);
}

/// Documents of the same folder of the workspace may call it, or be called.
void ClientSession::planOthers(const OpenDocument &changed) {
  const std::filesystem::path root = workspace_.rootOf(changed);
  if (root.empty())
    return;
  const Clock::time_point due = Clock::now() + kUntilOthers;
  for (auto &[uri, other] : workspace_.documents())
    if (&other != &changed && workspace_.rootOf(other) == root && (!other.flowDue || other.isFlowDueForOthers)) {
      other.flowDue = due;
      other.isFlowDueForOthers = other.isFlowKnown;
    }
}

/// On the files with contracts beside a program: they are not open, so that nobody else speaks for them.
void ClientSession::publishOthers(OpenDocument &document, const CheckResult &result, std::size_t own) {
  const PublishContext context = publishContext();
  std::set<std::string> told;
  for (const auto &[uri, diagnostics] : document.others)
    told.insert(uri);
  document.others.clear();
  const std::vector<std::string> &sidecars = result.files[own].sidecars;
  for (std::size_t i = 0; i < result.files.size(); ++i) {
    const CheckedFile &file = result.files[i];
    if (std::find(sidecars.begin(), sidecars.end(), file.path) == sidecars.end())
      continue;
    const std::string uri = context.uriOf(file.path);
    const Places places(file.source, workspace_.encoding);
    Json &diagnostics = document.others[uri] = Json::array();
    for (const PublishedDiagnostic &published : diagnosticsOfCheck(i, result, context))
      diagnostics.push_back(diagnosticOf(published, places, uri, context));
    told.insert(uri);
  }
  for (const std::string &uri : told)
    publishOther(uri);
}

/// What all open programs say of it, each thing once.
void ClientSession::publishOther(const std::string &uri) {
  if (workspace_.find(uri) != nullptr)
    return; // it speaks for itself
  Json all = Json::array();
  for (const auto &[name, document] : workspace_.documents())
    if (const auto said = document.others.find(uri); said != document.others.end())
      for (const Json &diagnostic : said->second)
        if (std::find(all.begin(), all.end(), diagnostic) == all.end())
          all.push_back(diagnostic);
  notify("textDocument/publishDiagnostics", {{"uri", uri}, {"diagnostics", std::move(all)}});
}

} // namespace feedhold::lsp
