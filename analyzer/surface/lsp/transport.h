// Transport: messages with `Content-Length` headers on streams, as the base protocol of language servers frames them.
#pragma once

#include <nlohmann/json.hpp>

#include <istream>
#include <mutex>
#include <ostream>
#include <string>

namespace feedhold::lsp {

using Json = nlohmann::json;

/// What came in.
struct Incoming {
  enum class Kind : std::uint8_t {
    Message, // `json` is what the client wrote
    Broken,  // `why` says what was wrong with it; the next one may be right
    End,     // the stream is closed
  };
  Kind kind;
  Json json = {};
  std::string why = {};
};

/// Finds its way back after a broken header or body: at the next `Content-Length:`.
class MessageReader {
public:
  /// The largest program (SourceFile::kLargestSize) does not fit an editor; a length beyond this is a mistake.
  static constexpr std::size_t kLongest = std::size_t{256} << 20;

  explicit MessageReader(std::istream &in) : in_(in) {}
  Incoming next();

private:
  std::istream &in_;
};

/// May be called from any thread.
class MessageWriter {
public:
  explicit MessageWriter(std::ostream &out) : out_(out) {}
  void write(const Json &message);

private:
  std::ostream &out_;
  std::mutex mutex_;
};

} // namespace feedhold::lsp
