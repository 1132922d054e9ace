// Requests about documents: findings on demand, and the features.
#include "base/source/file_uri.h"
#include "base/support/sha256.h"
#include "surface/lsp/session.h"

#include <fmt/format.h>

#include <array>

namespace feedhold::lsp {

namespace {

/// Of the document that a request is about; absent: it is about all.
std::optional<std::string> uriIn(const Json &params) {
  for (const char *member : {"textDocument", "item", "data"})
    if (params.is_object() && params.contains(member) && params.at(member).is_object() &&
        params.at(member).contains("uri"))
      return params.at(member).at("uri").get<std::string>();
  if (params.is_object() && params.contains("textDocument"))
    return params.at("textDocument").at("uri").get<std::string>(); // says what is wrong with it
  return std::nullopt;
}

} // namespace

Json ClientSession::askFeature(const Feature &feature, const Json &params) {
  const std::optional<std::string> uri = uriIn(params);
  if (!uri)
    return askFeatureOfAll(feature, params);
  if (OpenDocument *document = workspace_.find(*uri)) {
    if (refreshesHints_ && !document->kept->followLater)
      document->kept->followLater = [this, id = *uri](const Flow::Programs &programs) { followLater(id, programs); };
    return workspace_.programsOf(*document) ? feature.answer(workspace_.viewOf(*document), params) : Json();
  }
  OpenDocument closed; // a file beside one that is open: where a call led
  closed.document.uri = *uri;
  closed.document.path = pathOfUri(*uri);
  closed.document.text = std::make_shared<const std::string>();
  const bool isThere = !closed.document.path.empty() && workspace_.programsOf(closed);
  if (!isThere)
    throw RequestError(ErrorCode::InvalidParams, fmt::format("the document {} is not open", *uri));
  return feature.answer(workspace_.viewOf(closed), params);
}

/// The client asks for hints again when it is done.
void ClientSession::followLater(const std::string &uri, const Flow::Programs &programs) {
  flowLane_.submit(uri + "#hints", [this, uri, programs](const std::stop_token &stop) {
    if (stop.stop_requested())
      return;
    std::function<void()> task;
    try {
      task = [this, uri, programs, states = Flow::follow(*programs)] {
        OpenDocument *found = workspace_.find(uri);
        if (found == nullptr || found->programs != programs)
          return;
        found->kept->take(programs, states);
        ask("workspace/inlayHint/refresh", nullptr);
      };
    } catch (const std::exception &error) {
      task = [this, uri, why = std::string(error.what())] { log(fmt::format("{}: {}", uri, why)); };
    }
    queue_.push({.task = std::move(task)});
  });
}

/// What several documents see of one folder comes once.
Json ClientSession::askFeatureOfAll(const Feature &feature, const Json &params) {
  Json all = Json::array();
  std::set<std::string> seen;
  for (auto &[uri, document] : workspace_.documents()) {
    if (!workspace_.programsOf(document))
      continue;
    const Json found = feature.answer(workspace_.viewOf(document), params);
    if (!found.is_array())
      return found;
    for (const Json &each : found)
      if (seen.insert(each.dump(-1, ' ', false, Json::error_handler_t::replace)).second)
        all.push_back(each);
  }
  return all;
}

Json ClientSession::pullDiagnostics(const Json &params) {
  OpenDocument &document = documentOf(params);
  if (document.quickDue) {
    document.quickDue.reset();
    checkQuickly(document);
  }
  if (!refreshesDiagnostics_ && !document.isFlowKnown)
    findFlowNow(document);
  // Of what is found, not of how often it was looked for: the background may find the same once more.
  Json items = findingsOf(document);
  const std::string resultId = sha256(items.dump(-1, ' ', false, Json::error_handler_t::replace));
  if (params.value("previousResultId", Json()) == resultId)
    return {{"kind", "unchanged"}, {"resultId", resultId}};
  return {{"kind", "full"}, {"resultId", resultId}, {"items", std::move(items)}};
}

Json ClientSession::colours(const Json &params) {
  static_cast<void>(documentOf(params));
  return Json::array();
}

} // namespace feedhold::lsp
