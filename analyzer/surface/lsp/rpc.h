// The messages of JSON-RPC and the errors that the protocol names.
#pragma once

#include "surface/lsp/transport.h"

#include <stdexcept>
#include <string_view>

namespace feedhold::lsp {

enum class ErrorCode : int {
  ParseError = -32700,
  InvalidRequest = -32600,
  MethodNotFound = -32601,
  InvalidParams = -32602,
  InternalError = -32603,
  ServerNotInitialized = -32002,
  RequestCancelled = -32800,
  RequestFailed = -32803,
};

/// Thrown by what answers a request: the answer is this error.
struct RequestError : std::runtime_error {
  RequestError(ErrorCode code_, const std::string &message) : std::runtime_error(message), code(code_) {}
  ErrorCode code;
};

inline Json answerMessage(const Json &id, Json result) {
  return {{"jsonrpc", "2.0"}, {"id", id}, {"result", std::move(result)}};
}
inline Json errorMessage(const Json &id, ErrorCode code, std::string_view message) {
  return {{"jsonrpc", "2.0"}, {"id", id}, {"error", {{"code", static_cast<int>(code)}, {"message", message}}}};
}
inline Json notificationMessage(std::string_view method, Json params) {
  return {{"jsonrpc", "2.0"}, {"method", method}, {"params", std::move(params)}};
}
/// Null: the method takes no parameters; parameters that are null are no message of the protocol.
inline Json requestMessage(const Json &id, std::string_view method, Json params) {
  Json message = {{"jsonrpc", "2.0"}, {"id", id}, {"method", method}};
  if (!params.is_null())
    message["params"] = std::move(params);
  return message;
}

} // namespace feedhold::lsp
