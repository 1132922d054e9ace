// Any messages to the language server: the first byte says how they are sent, each line of the rest is the body of one.
// The session begins and ends as it should, so that whatever comes between must be answered or passed over.
#include "base/support/check.h"
#include "dialects/registry.h"
#include "rules/registry.h"
#include "surface/lsp/server.h"
#include "surface/lsp/transport.h"

#include <fmt/format.h>

#include <array>
#include <sstream>
#include <string>
#include <string_view>

namespace {

using namespace feedhold;

// Bits of the first byte.
constexpr unsigned kUnframed = 1;    // the bytes go as they are: headers are fuzzed, too
constexpr unsigned kBytes = 2;       // characters are counted as UTF-8, not as UTF-16
constexpr unsigned kPulls = 4;       // the client asks for diagnostics
constexpr unsigned kRefreshes = 8;   // ... and wants to be told when to ask again
constexpr unsigned kAfterAFlow = 16; // the session ends with a check of the document that the seeds are about

constexpr std::string_view kChecked = R"({"jsonrpc":"2.0","id":"check","method":"textDocument/diagnostic",)"
                                      R"("params":{"textDocument":{"uri":"file:///feedhold-fuzz/a.nc"}}})";

/// Proofs take longer than a round may.
constexpr std::array<std::string_view, 3> kProving = {"onSave", "onType", "feedhold.prove"};

std::string framed(std::string_view body) { return fmt::format("Content-Length: {}\r\n\r\n{}", body.size(), body); }

std::string beginning(unsigned how) {
  const std::string_view encoding = how & kBytes ? "utf-8" : "utf-16";
  const std::string_view pulls = how & kPulls ? R"(,"textDocument":{"diagnostic":{}})" : "";
  const std::string_view refreshes = how & kRefreshes ? "true" : "false";
  return framed(fmt::format(R"({{"jsonrpc":"2.0","id":"begin","method":"initialize","params":{{"processId":null,)"
                            R"("rootUri":"file:///feedhold-fuzz","initializationOptions":{{"proofs":"off"}},)"
                            R"("capabilities":{{"general":{{"positionEncodings":["{}"]}}{},"workspace":)"
                            R"({{"diagnostics":{{"refreshSupport":{}}}}}}}}}}})",
                            encoding, pulls, refreshes)) +
         framed(R"({"jsonrpc":"2.0","method":"initialized","params":{}})");
}

std::string ending(unsigned how) {
  return (how & kAfterAFlow ? framed(kChecked) : std::string()) +
         framed(R"({"jsonrpc":"2.0","id":"end","method":"shutdown"})") + framed(R"({"jsonrpc":"2.0","method":"exit"})");
}

bool leaves(std::string_view body) {
  const lsp::Json json = lsp::Json::parse(body, nullptr, false);
  return json.is_object() && json.value("method", lsp::Json()) == "exit";
}

/// What is sent, and whether the server must stay until the end of it.
struct Sent {
  std::string text;
  bool endsInOrder = true;
};

Sent messagesIn(std::string_view bytes, unsigned how) {
  if (how & kUnframed)
    return {std::string(bytes), false}; // its last header may swallow the end
  Sent sent;
  for (std::size_t begin = 0; begin < bytes.size();) {
    const std::size_t end = std::min(bytes.find('\n', begin), bytes.size());
    const std::string_view body = bytes.substr(begin, end - begin);
    sent.text += framed(body);
    sent.endsInOrder = sent.endsInOrder && !leaves(body);
    begin = end + 1;
  }
  return sent;
}

void run(std::string_view bytes, unsigned how) {
  for (const std::string_view proving : kProving)
    if (bytes.find(proving) != std::string_view::npos)
      return;
  const lsp::ServerOptions options{
      .known = {allDialects(), allRules()}, .version = "fuzz", .cache = std::nullopt, .pages = std::nullopt};
  const Sent sent = messagesIn(bytes, how);
  std::istringstream in(beginning(how) + sent.text + ending(how));
  std::stringstream out;
  const int code = lsp::serve(in, out, options);
  FEEDHOLD_CHECK(code == 0 || (code == 1 && !sent.endsInOrder), "the session did not end in order");
  lsp::MessageReader reader(out);
  std::size_t answers = 0;
  for (lsp::Incoming said = reader.next(); said.kind != lsp::Incoming::Kind::End; said = reader.next()) {
    FEEDHOLD_CHECK(said.kind == lsp::Incoming::Kind::Message, "the server said what is no message");
    const lsp::Json id = said.json.value("id", lsp::Json());
    answers += !said.json.contains("method") && (id == "begin" || id == "end") ? 1 : 0;
  }
  FEEDHOLD_CHECK(answers >= 2 || !sent.endsInOrder, "a request was not answered");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
  if (size != 0)
    run({reinterpret_cast<const char *>(data + 1), size - 1}, data[0]);
  return 0;
}
