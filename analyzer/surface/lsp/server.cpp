// One thread reads, so that a request can be taken back while another one is answered; the calling thread works.
#include "surface/lsp/server.h"

#include "surface/lsp/session.h"

namespace feedhold::lsp {

namespace {

bool isMethod(const Incoming &incoming, std::string_view method) {
  return incoming.json.is_object() && incoming.json.value("method", Json()) == method;
}

/// Ends with the stream or with `exit`, behind which nothing comes.
void readAll(std::istream &in, EventQueue &queue) {
  MessageReader reader(in);
  for (;;) {
    Incoming incoming = reader.next();
    if (isMethod(incoming, "$/cancelRequest")) {
      if (const Json &params = incoming.json["params"]; params.is_object() && params.contains("id"))
        queue.cancel(params["id"]);
      continue;
    }
    const bool isLast =
        incoming.kind == Incoming::Kind::End || (isMethod(incoming, "exit") && !incoming.json.contains("id"));
    queue.push({.incoming = std::move(incoming)});
    if (isLast)
      return;
  }
}

} // namespace

int serve(std::istream &in, std::ostream &out, const ServerOptions &options) {
  in.tie(nullptr); // reading would flush `out` from another thread than those that write to it
  EventQueue queue;
  MessageWriter writer(out);
  std::jthread reader([&] { readAll(in, queue); });
  return ClientSession(queue, writer, options).run();
}

} // namespace feedhold::lsp
