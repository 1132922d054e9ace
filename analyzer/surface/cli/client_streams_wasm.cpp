// The client in WebAssembly: what has started the program receives from it and sends to it, and can say whether
// anything has come (editors/vscode/src/server.ts).
#include "surface/cli/client_streams.h"

#include <emscripten.h>

#include <array>
#include <streambuf>

namespace feedhold {

namespace {

// How many bytes came; 0: none until then; -1: the client is gone.  A negative time has no end.
EM_JS(int, receiveBytes, (char *to, int most, double milliseconds),
      { return Module.receive ? Module.receive(HEAPU8.subarray(to, to + most), milliseconds) : -1; });

EM_JS(void, sendBytes, (const char *from, int count), {
  if (Module.send)
    Module.send(HEAPU8.slice(from, from + count));
});

class Received : public std::streambuf {
public:
  bool hasCome(std::optional<std::chrono::steady_clock::time_point> until) {
    if (isOver_ || gptr() != egptr())
      return true;
    constexpr double kWithoutEnd = -1;
    double wait = kWithoutEnd;
    if (until) {
      const auto left = *until - std::chrono::steady_clock::now();
      wait = std::max(0.0, std::chrono::duration<double, std::milli>(left).count());
    }
    const int count = receiveBytes(bytes_.data(), static_cast<int>(bytes_.size()), wait);
    isOver_ = count < 0;
    if (count > 0)
      setg(bytes_.data(), bytes_.data(), bytes_.data() + count);
    return count != 0;
  }

protected:
  int_type underflow() override {
    hasCome(std::nullopt);
    return gptr() == egptr() ? traits_type::eof() : traits_type::to_int_type(*gptr());
  }

private:
  std::array<char, std::size_t{1} << 16> bytes_{};
  bool isOver_ = false;
};

class Sent : public std::streambuf {
protected:
  std::streamsize xsputn(const char *from, std::streamsize count) override {
    waiting_.append(from, static_cast<std::size_t>(count));
    return count;
  }
  int_type overflow(int_type c) override {
    if (!traits_type::eq_int_type(c, traits_type::eof()))
      waiting_ += traits_type::to_char_type(c);
    return traits_type::not_eof(c);
  }
  int sync() override {
    sendBytes(waiting_.data(), static_cast<int>(waiting_.size()));
    waiting_.clear();
    return 0;
  }

private:
  std::string waiting_;
};

} // namespace

int serveClient(const lsp::ServerOptions &options) {
  Received received;
  Sent sent;
  std::istream in(&received);
  std::ostream out(&sent);
  return lsp::serveWithoutThreads(in, out, options, [&](auto until) { return received.hasCome(until); });
}

} // namespace feedhold
