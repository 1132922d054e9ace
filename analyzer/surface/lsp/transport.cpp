#include "surface/lsp/transport.h"

#include "base/support/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

namespace feedhold::lsp {

namespace {

constexpr std::string_view kLength = "content-length:";
/// Of a header line; a longer one is no header.
constexpr std::size_t kLongestLine = 1 << 16;

enum class Line : std::uint8_t { Read, TooLong, End };

/// Up to a line feed, which is left out; of what is too long the last bytes are kept, since a header may stand there.
Line readLine(std::istream &in, std::string &line) {
  line.clear();
  Line result = Line::Read;
  for (int c = in.get(); c != '\n'; c = in.get()) {
    if (c == std::istream::traits_type::eof())
      return Line::End;
    line += static_cast<char>(c);
    if (line.size() >= 2 * kLongestLine) {
      line.erase(0, kLongestLine);
      result = Line::TooLong;
    }
  }
  return result;
}

std::optional<std::size_t> numberIn(std::string_view text) {
  text = trimmed(text);
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size())
    return std::nullopt;
  return value;
}

Incoming broken(std::string why) { return {.kind = Incoming::Kind::Broken, .why = std::move(why)}; }

Incoming readBody(std::istream &in, std::size_t length) {
  std::string body;
  // In pieces: a length that is a mistake does not take its memory at once.
  constexpr std::size_t kPiece = 1 << 16;
  while (body.size() < length) {
    const std::size_t before = body.size();
    body.resize(std::min(length, before + kPiece));
    in.read(body.data() + before, static_cast<std::streamsize>(body.size() - before));
    if (!in)
      return {.kind = Incoming::Kind::End};
  }
  Json json = Json::parse(body, nullptr, false);
  if (json.is_discarded())
    return broken("the message is not valid JSON");
  return {.kind = Incoming::Kind::Message, .json = std::move(json)};
}

} // namespace

Incoming MessageReader::next() {
  std::optional<std::size_t> length;
  bool isBroken = false;
  for (std::string line;;) {
    const Line read = readLine(in_, line);
    if (read == Line::End)
      return {.kind = Incoming::Kind::End};
    const std::size_t at = toLower(line).rfind(kLength);
    if (read == Line::TooLong || (at != 0 && at != std::string::npos))
      isBroken = true; // the body before it was longer than its length said
    if (at != std::string::npos) {
      length = numberIn(std::string_view(line).substr(at + kLength.size()));
      isBroken = isBroken || !length;
    } else if (trimmed(line).empty() && (length || isBroken)) {
      break;
    } else if (!trimmed(line).empty() && line.find(':') == std::string::npos) {
      isBroken = true;
    }
  }
  if (!length)
    return broken("a message needs a `Content-Length` header with a number");
  if (*length > kLongest)
    return broken(fmt::format("a message of {} bytes exceeds the limit of {} bytes", *length, kLongest));
  return readBody(in_, *length);
}

void MessageWriter::write(const Json &message) {
  // Text of programs may hold bytes that are no UTF-8; they become U+FFFD.
  const std::string body = message.dump(-1, ' ', false, Json::error_handler_t::replace);
  const std::lock_guard lock(mutex_);
  out_ << "Content-Length: " << body.size() << "\r\n\r\n" << body << std::flush;
}

} // namespace feedhold::lsp
