// The messages of a session: what is allowed when, who answers, and what an error becomes.
#include "surface/lsp/session.h"

#include "base/support/turns.h"

#include <fmt/format.h>

#include <algorithm>

namespace feedhold::lsp {

namespace {

/// A client that sends without a pause gets the findings of what it wrote so far after this.
constexpr auto kLongestWait = std::chrono::milliseconds(50);

bool isId(const Json &id) { return id.is_number_integer() || id.is_string(); }

/// Without the number that the library puts before its message: `[json.exception.type_error.302] type must be ..`.
std::string complaintAboutForm(const std::string &method, const Json::exception &error) {
  const std::string_view what = error.what();
  const std::size_t number = what.find("] ");
  return fmt::format("invalid parameters of `{}`: {}", method,
                     number == std::string_view::npos ? what : what.substr(number + 2));
}

} // namespace

ClientSession::ClientSession(EventQueue &queue, MessageWriter &writer, const ServerOptions &options, Worker worker)
    : queue_(queue), writer_(writer), options_(options), workspace_(options.known), flowLane_(worker),
      proofLane_(worker) {}

int ClientSession::run() {
  while (!exitCode_) {
    const bool canWork = flowLane_.isReady() || proofLane_.isReady();
    if (!attend(canWork ? Clock::now() : nextDue()) && canWork)
      workInLanes();
  }
  return *exitCode_;
}

/// To the next event, if one comes until then, and to what is due by now; false: there was nothing.
bool ClientSession::attend(std::optional<Clock::time_point> until) {
  const std::optional<Event> event = queue_.popUntil(until);
  if (event && event->task)
    event->task();
  else if (event)
    receive(*event);
  const std::optional<Clock::time_point> due = nextDue();
  const Clock::time_point now = Clock::now();
  const bool isDue = !exitCode_ && due && *due <= now && (queue_.isEmpty() || *due + kLongestWait < now);
  if (isDue)
    workOnDue();
  return event || isDue;
}

/// Findings do not wait for a proof, which may take a minute; a proof waits for findings.
bool ClientSession::workInLanes() {
  const Turns turns([this] { attendMeanwhile(); });
  return flowLane_.workNext() || (!flowLane_.isWorking() && proofLane_.workNext());
}

/// In a turn of work in a lane.
void ClientSession::attendMeanwhile() {
  while (!exitCode_ && (attend(Clock::now()) || workInLanes())) {
  }
  if (!exitCode_)
    return;
  flowLane_.end();
  proofLane_.end();
}

void ClientSession::receive(const Event &event) {
  const auto &[kind, json, why] = event.incoming;
  if (kind == Incoming::Kind::End) {
    exitCode_ = phase_ == Phase::ShutDown ? 0 : 1;
    return;
  }
  if (kind == Incoming::Kind::Broken)
    return writer_.write(errorMessage(nullptr, ErrorCode::ParseError, why));
  if (!json.is_object())
    return writer_.write(errorMessage(nullptr, ErrorCode::InvalidRequest, "a message must be a JSON object"));
  const Json id = json.value("id", Json());
  const Json params = json.value("params", Json());
  const auto method = json.find("method");
  if (method == json.end() && isId(id) && (json.contains("result") || json.contains("error")))
    return; // an answer to what was asked: nothing depends on it
  if (method == json.end() || !method->is_string() || (json.contains("id") && !isId(id)))
    return writer_.write(errorMessage(isId(id) ? id : Json(), ErrorCode::InvalidRequest,
                                      "a message needs a `method`, and its `id` must be an integer or a string"));
  if (!json.contains("id"))
    return receiveNotification(method->get<std::string>(), params);
  if (event.isCancelled)
    return writer_.write(errorMessage(id, ErrorCode::RequestCancelled, "cancelled by the client"));
  receiveRequest(id, method->get<std::string>(), params);
}

void ClientSession::receiveRequest(const Json &id, const std::string &method, const Json &params) {
  try {
    writer_.write(answerMessage(id, answer(method, params)));
  } catch (const RequestError &error) {
    writer_.write(errorMessage(id, error.code, error.what()));
  } catch (const Refused &refusal) {
    writer_.write(errorMessage(id, ErrorCode::RequestFailed, refusal.what()));
  } catch (const Json::exception &error) {
    writer_.write(errorMessage(id, ErrorCode::InvalidParams, complaintAboutForm(method, error)));
  } catch (const std::exception &error) {
    log(fmt::format("{}: {}", method, error.what()));
    writer_.write(errorMessage(id, ErrorCode::InternalError, error.what()));
  }
}

Json ClientSession::answer(const std::string &method, const Json &params) {
  if (phase_ == Phase::ShutDown)
    throw RequestError(ErrorCode::InvalidRequest, "the server is shutting down");
  if (phase_ == Phase::Fresh && method != "initialize")
    throw RequestError(ErrorCode::ServerNotInitialized, "`initialize` must be the first request");
  if (const auto own = requests().find(method); own != requests().end())
    return (this->*own->second)(params);
  const auto feature = std::find_if(features().begin(), features().end(),
                                    [&](const Feature &candidate) { return candidate.method == method; });
  if (feature == features().end())
    throw RequestError(ErrorCode::MethodNotFound, fmt::format("unknown request `{}`", method));
  return askFeature(*feature, params);
}

void ClientSession::receiveNotification(const std::string &method, const Json &params) {
  if (method == "exit") {
    exitCode_ = phase_ == Phase::ShutDown ? 0 : 1;
    return;
  }
  const auto reaction = notifications().find(method);
  if (phase_ != Phase::Initialized || reaction == notifications().end())
    return; // the protocol wants both passed over in silence
  try {
    (this->*reaction->second)(params);
  } catch (const std::exception &error) {
    log(fmt::format("{}: {}", method, error.what()));
  }
}

const std::map<std::string_view, ClientSession::Answer> &ClientSession::requests() {
  static const std::map<std::string_view, Answer> kRequests = {
      {"initialize", &ClientSession::initialize},
      {"shutdown", &ClientSession::shutDown},
      {"textDocument/diagnostic", &ClientSession::pullDiagnostics},
      {"textDocument/codeAction", &ClientSession::codeActions},
      {"textDocument/formatting", &ClientSession::formatting},
      {"textDocument/rangeFormatting", &ClientSession::formatting},
      {"workspace/executeCommand", &ClientSession::execute},
      {"textDocument/documentColor", &ClientSession::colours},
      {"textDocument/colorPresentation", &ClientSession::colours},
  };
  return kRequests;
}

const std::map<std::string_view, ClientSession::Reaction> &ClientSession::notifications() {
  static const std::map<std::string_view, Reaction> kNotifications = {
      {"initialized", &ClientSession::initialized},
      {"textDocument/didOpen", &ClientSession::open},
      {"textDocument/didChange", &ClientSession::change},
      {"textDocument/didSave", &ClientSession::save},
      {"textDocument/didClose", &ClientSession::close},
      {"workspace/didChangeConfiguration", &ClientSession::changeSettings},
      {"workspace/didChangeWorkspaceFolders", &ClientSession::changeFolders},
      {"workspace/didChangeWatchedFiles", &ClientSession::changeFiles},
      {"window/workDoneProgress/cancel", &ClientSession::cancelProgress},
  };
  return kNotifications;
}

void ClientSession::notify(std::string_view method, Json params) {
  writer_.write(notificationMessage(method, std::move(params)));
}

void ClientSession::ask(std::string_view method, Json params) {
  writer_.write(requestMessage(fmt::format("feedhold-{}", ++lastAsked_), method, std::move(params)));
}

void ClientSession::show(Severity severity, const std::string &message) {
  const int type = severity == Severity::Error ? 1 : severity == Severity::Warning ? 2 : 3;
  notify("window/showMessage", {{"type", type}, {"message", message}});
}

void ClientSession::log(const std::string &message) {
  constexpr int kLog = 4;
  notify("window/logMessage", {{"type", kLog}, {"message", message}});
}

} // namespace feedhold::lsp
