// The server where there are no threads: messages before work, and the findings that a thread would find.
#include "dialects/registry.h"
#include "rules/registry.h"
#include "surface/lsp/server.h"
#include "surface/lsp/transport.h"

#include <gtest/gtest.h>

#include <sstream>
#include <vector>

namespace feedhold::lsp {
namespace {

std::string framed(const Json &message) {
  const std::string body = message.dump();
  return "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body;
}

Json notification(const char *method, const Json &params) {
  return {{"jsonrpc", "2.0"}, {"method", method}, {"params", params}};
}

Json request(int id, const char *method, const Json &params) {
  return {{"jsonrpc", "2.0"}, {"id", id}, {"method", method}, {"params", params}};
}

Json opening(const std::string &text) {
  return notification(
      "textDocument/didOpen",
      {{"textDocument", {{"uri", "untitled:O1"}, {"languageId", "macrob"}, {"version", 1}, {"text", text}}}});
}

Json change(int version, const std::string &text) {
  return notification("textDocument/didChange", {{"textDocument", {{"uri", "untitled:O1"}, {"version", version}}},
                                                 {"contentChanges", {{{"text", text}}}}});
}

class LspWithoutThreads : public testing::Test {
protected:
  /// Each part is sent when the server has nothing left to do.
  std::vector<Json> said(const std::vector<std::string> &parts, int expectedCode = 0) {
    std::stringstream in, out;
    std::size_t next = 0;
    const auto hasCome = [&](std::optional<std::chrono::steady_clock::time_point> until) {
      if (in.rdbuf()->in_avail() > 0)
        return true;
      if (until)
        return false;
      if (next < parts.size())
        in << parts[next++];
      return true;
    };
    EXPECT_EQ(serveWithoutThreads(in, out, kOptions, hasCome), expectedCode);
    std::vector<Json> messages;
    MessageReader reader(out);
    for (Incoming incoming = reader.next(); incoming.kind == Incoming::Kind::Message; incoming = reader.next())
      messages.push_back(incoming.json);
    return messages;
  }
  static std::vector<std::string> codesOfLast(const std::vector<Json> &messages) {
    std::vector<std::string> codes;
    for (const Json &message : messages)
      if (message.value("method", "") == "textDocument/publishDiagnostics") {
        codes.clear();
        for (const Json &diagnostic : message["params"]["diagnostics"])
          codes.push_back(diagnostic["code"]);
      }
    return codes;
  }

  const ServerOptions kOptions{
      .known = {allDialects(), allRules()}, .version = "0", .cache = std::nullopt, .pages = std::nullopt};
  const std::string kBeginning = framed(request(1, "initialize", {{"capabilities", Json::object()}}));
  const std::string kEnd = framed(request(9, "shutdown", nullptr)) + framed(notification("exit", nullptr));
};

TEST_F(LspWithoutThreads, FindingsWithAndWithoutFlow) {
  const auto codes = codesOfLast(said({kBeginning + framed(opening("O1\n#1-1\nGOTO99\nM30\n")), kEnd}));
  EXPECT_EQ(codes, (std::vector<std::string>{"missing-equals", "goto-missing-label", "unreachable-block"}));
}

TEST_F(LspWithoutThreads, AllThatHasComeIsReadBeforeAnyOfItIsWorkedOn) {
  const auto messages =
      said({kBeginning + framed(opening("O1\n#1-1\nM30\n")) + framed(change(2, "O1\nG04P10\nM30\n")), kEnd});
  int published = 0;
  for (const Json &message : messages)
    if (message.value("method", "") == "textDocument/publishDiagnostics") {
      EXPECT_EQ(message["params"]["version"], 2);
      ++published;
    }
  EXPECT_GT(published, 0);
  EXPECT_TRUE(codesOfLast(messages).empty());
}

TEST_F(LspWithoutThreads, ARequestThatIsTakenBack) {
  const Json place = {{"textDocument", {{"uri", "untitled:O1"}}}, {"position", {{"line", 1}, {"character", 1}}}};
  const auto messages = said(
      {kBeginning + framed(opening("O1\n#1=1\nM30\n")),
       framed(request(2, "textDocument/hover", place)) + framed(notification("$/cancelRequest", {{"id", 2}})), kEnd});
  constexpr int kCancelled = -32800;
  int answered = 0;
  for (const Json &message : messages)
    if (message.value("id", Json()) == 2) {
      EXPECT_EQ(message["error"]["code"], kCancelled);
      ++answered;
    }
  EXPECT_EQ(answered, 1);
}

TEST_F(LspWithoutThreads, AClientThatIsGone) { said({kBeginning}, 1); }

} // namespace
} // namespace feedhold::lsp
