// One thread reads, so that a request can be taken back while another one is answered; the calling thread works.  Where
// there are no threads, it reads all that has come before it works on any of it.
#include "surface/lsp/server.h"

#include "surface/lsp/session.h"

namespace feedhold::lsp {

namespace {

bool isMethod(const Incoming &incoming, std::string_view method) {
  return incoming.json.is_object() && incoming.json.value("method", Json()) == method;
}

/// False with the end of the stream and with `exit`, behind which nothing comes.
bool readOne(MessageReader &reader, EventQueue &queue) {
  Incoming incoming = reader.next();
  if (isMethod(incoming, "$/cancelRequest")) {
    if (const Json &params = incoming.json["params"]; params.is_object() && params.contains("id"))
      queue.cancel(params["id"]);
    return true;
  }
  const bool isLast =
      incoming.kind == Incoming::Kind::End || (isMethod(incoming, "exit") && !incoming.json.contains("id"));
  queue.push({.incoming = std::move(incoming)});
  return !isLast;
}

} // namespace

int serve(std::istream &in, std::ostream &out, const ServerOptions &options) {
  in.tie(nullptr); // reading would flush `out` from another thread than those that write to it
  EventQueue queue;
  MessageWriter writer(out);
  const std::jthread reading([&] {
    MessageReader reader(in);
    while (readOne(reader, queue)) {
    }
  });
  return ClientSession(queue, writer, options, Worker::Thread).run();
}

int serveWithoutThreads(std::istream &in, std::ostream &out, const ServerOptions &options, const HasCome &hasCome) {
  MessageReader reader(in);
  MessageWriter writer(out);
  bool isOver = false;
  EventQueue queue([&](std::optional<Clock::time_point> until) {
    for (; !isOver && hasCome(until); until = Clock::now())
      isOver = !readOne(reader, queue);
  });
  return ClientSession(queue, writer, options, Worker::Owner).run();
}

} // namespace feedhold::lsp
