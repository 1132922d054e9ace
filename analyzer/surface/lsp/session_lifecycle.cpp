// The beginning and the end of a session, and what changes around its documents.
#include "surface/lsp/session.h"

#include "base/source/file_uri.h"
#include "base/source/path_text.h"

#include <algorithm>

namespace feedhold::lsp {

namespace {

/// Null where there is nothing.
Json at(const Json &json, std::string_view pointer) {
  const Json::json_pointer place{std::string(pointer)};
  return json.contains(place) ? json.at(place) : Json();
}

bool isTrue(const Json &json, std::string_view pointer) { return at(json, pointer) == true; }

std::filesystem::path folderOf(const Json &uri) {
  const std::filesystem::path path = uri.is_string() ? pathOfUri(uri.get<std::string>()) : std::filesystem::path();
  return isAbsolutePath(path) ? normalPath(path) : std::filesystem::path();
}

} // namespace

Json ClientSession::initialize(const Json &params) {
  if (phase_ != Phase::Fresh)
    throw RequestError(ErrorCode::InvalidRequest, "`initialize` may be sent only once");
  const Json client = params.at("capabilities");
  const Json encodings = at(client, "/general/positionEncodings");
  if (std::find(encodings.begin(), encodings.end(), "utf-8") != encodings.end())
    workspace_.encoding = PositionEncoding::Utf8;
  pullsDiagnostics_ = at(client, "/textDocument/diagnostic").is_object();
  refreshesDiagnostics_ = isTrue(client, "/workspace/diagnostics/refreshSupport");
  refreshesLenses_ = isTrue(client, "/workspace/codeLens/refreshSupport");
  refreshesHints_ = isTrue(client, "/workspace/inlayHint/refreshSupport");
  showsProgress_ = isTrue(client, "/window/workDoneProgress");
  registersWatchers_ = isTrue(client, "/workspace/didChangeWatchedFiles/dynamicRegistration");
  const Json operations = at(client, "/workspace/workspaceEdit/resourceOperations");
  appliesEdits_ = isTrue(client, "/workspace/applyEdit");
  createsFiles_ = isTrue(client, "/workspace/workspaceEdit/documentChanges") &&
                  std::find(operations.begin(), operations.end(), "create") != operations.end();
  const Json folders = at(params, "/workspaceFolders");
  for (const Json &folder : folders)
    if (const auto path = folderOf(at(folder, "/uri")); !path.empty())
      workspace_.folders.push_back(path);
  if (const auto root = folderOf(at(params, "/rootUri")); workspace_.folders.empty() && !root.empty())
    workspace_.folders.push_back(root);
  const SettingsRead read = readSettings(at(params, "/initializationOptions"), settings_);
  settings_ = read.settings;
  if (read.complaint)
    show(Severity::Warning, *read.complaint);
  phase_ = Phase::Initialized;
  return {{"capabilities", capabilities()}, {"serverInfo", {{"name", "feedhold"}, {"version", options_.version}}}};
}

Json ClientSession::capabilities() const {
  Json result = featureCapabilities();
  result["positionEncoding"] = workspace_.encoding == PositionEncoding::Utf8 ? "utf-8" : "utf-16";
  constexpr int kIncremental = 2;
  result["textDocumentSync"] = {{"openClose", true}, {"change", kIncremental}, {"save", {{"includeText", false}}}};
  result["codeActionProvider"] = {{"codeActionKinds", {"quickfix", "refactor", "source.fixAll.feedhold"}}};
  result["documentFormattingProvider"] = true;
  result["documentRangeFormattingProvider"] = true;
  result["executeCommandProvider"] = {{"commands", {"feedhold.draft", "feedhold.prove", "feedhold.runWitness"}}};
  result["colorProvider"] = true; // with no colours: editors paint `#500` otherwise
  result["workspace"]["workspaceFolders"] = {{"supported", true}, {"changeNotifications", true}};
  if (pullsDiagnostics_)
    result["diagnosticProvider"] = {
        {"identifier", "feedhold"}, {"interFileDependencies", true}, {"workspaceDiagnostics", false}};
  return result;
}

Json ClientSession::shutDown(const Json &) {
  phase_ = Phase::ShutDown;
  for (auto &[uri, document] : workspace_.documents()) {
    document.quickDue = document.flowDue = document.proofsDue = std::nullopt;
    flowLane_.drop(uri);
    proofLane_.drop(uri);
  }
  return nullptr;
}

void ClientSession::initialized(const Json &) {
  if (!registersWatchers_)
    return;
  Json watchers = Json::array();
  for (const char *pattern :
       {"**/feedhold.toml", "**/*.contract", "**/*.{nc,cnc,tap,ngc,eia,min,prg,ncd,mac,sub,txt}", "**/O[0-9]*"})
    watchers.push_back({{"globPattern", pattern}});
  ask("client/registerCapability", {{"registrations",
                                     {{{"id", "feedhold-files"},
                                       {"method", "workspace/didChangeWatchedFiles"},
                                       {"registerOptions", {{"watchers", std::move(watchers)}}}}}}});
}

void ClientSession::changeSettings(const Json &params) {
  const SettingsRead read = readSettings(params.at("settings"), settings_);
  if (read.complaint)
    show(Severity::Warning, *read.complaint);
  const bool isOther = read.settings.proofs != settings_.proofs;
  settings_ = read.settings;
  if (isOther)
    for (auto &[uri, document] : workspace_.documents())
      planProofs(document, Reason::Opened);
}

void ClientSession::changeFolders(const Json &params) {
  const Json &event = params.at("event");
  for (const Json &folder : event.at("removed"))
    std::erase(workspace_.folders, folderOf(folder.at("uri")));
  for (const Json &folder : event.at("added"))
    if (const auto path = folderOf(folder.at("uri")); !path.empty())
      workspace_.folders.push_back(path);
  planAll();
}

/// Programs, contracts or a configuration; which of them does not matter, since each may concern all.
void ClientSession::changeFiles(const Json &) {
  complaints_.clear();
  planAll();
}

void ClientSession::cancelProgress(const Json &params) {
  const auto found = progress_.find(params.at("token").get<std::string>());
  if (found != progress_.end())
    proofLane_.drop(found->second);
}

} // namespace feedhold::lsp
