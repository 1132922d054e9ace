// An entry as the server has it: a line with the signature, then the bytes.
#include "findings/session/shared_cache.h"

#include "base/support/hmac.h"
#include "base/support/process.h"

#include <fmt/format.h>

#include <charconv>

namespace feedhold {

namespace {

constexpr std::string_view kSignature = "feedhold signature 1 ";
constexpr int kFound = 200;
constexpr int kMissing = 404;
constexpr std::size_t kStatusDigits = 3;
/// A verdict has some kilobytes.
constexpr std::size_t kMostBytes = std::size_t{1} << 26;
constexpr ProcessLimits kLimits{.processorSeconds = 30, .watchdogSeconds = 40, .mostBytes = kMostBytes};

bool isDone(int status) { return status >= 200 && status < 300; }

} // namespace

std::optional<SharedCache::Reply> SharedCache::request(const std::string &name, const std::vector<std::string> &options,
                                                       const std::string &input) {
  if (isOff_)
    return std::nullopt;
  // The server's name and password, if it asks for them, come from ~/.netrc, as for other uses of curl.
  std::vector<std::string> command = {"curl", "--silent",   "--location", "--netrc-optional", "--connect-timeout",
                                      "3",    "--max-time", "30",         "--write-out",      "%{http_code}"};
  command.insert(command.end(), options.begin(), options.end());
  command.push_back(fmt::format("{}/{}", url_, name));
  Result<ProcessOutput> output = runProgram(command, input, kLimits);
  if (!output) {
    giveUp("it needs the program `curl`: " + output.error().message);
    return std::nullopt;
  }
  if (output.value().end == ProcessOutput::End::Killed || output.value().exitCode != 0) {
    giveUp("the server does not answer, or not to the end");
    return std::nullopt;
  }
  std::string body = std::move(output.take().output);
  Reply reply;
  if (body.size() >= kStatusDigits) {
    const char *status = body.data() + body.size() - kStatusDigits;
    std::from_chars(status, status + kStatusDigits, reply.status);
    body.resize(body.size() - kStatusDigits);
  }
  reply.body = std::move(body);
  return reply;
}

std::optional<std::string> SharedCache::fetch(const std::string &name) {
  std::optional<Reply> reply = request(name, {}, "");
  if (!reply)
    return std::nullopt;
  if (reply->status != kFound) {
    if (reply->status != kMissing)
      giveUp(fmt::format("the server answers GET with status {}", reply->status));
    return std::nullopt;
  }
  const std::size_t line = reply->body.find('\n');
  const std::string_view head = std::string_view(reply->body).substr(0, line);
  const std::string_view entry =
      line == std::string::npos ? std::string_view() : std::string_view(reply->body).substr(line + 1);
  if (!head.starts_with(kSignature) || !isSameSecret(head.substr(kSignature.size()), signatureOf(name, entry))) {
    ++unsigned_;
    return std::nullopt;
  }
  return std::string(entry);
}

void SharedCache::store(const std::string &name, const std::string &entry) {
  const auto reply = request(name,
                             {"--request", "PUT", "--header", "Content-Type: application/octet-stream", "--header",
                              "Expect:", "--data-binary", "@-"},
                             fmt::format("{}{}\n{}", kSignature, signatureOf(name, entry), entry));
  if (reply && !isDone(reply->status))
    giveUp(fmt::format("the server answers PUT with status {}", reply->status));
}

/// The name is signed, too: a right verdict at another's place would be a wrong one.
std::string SharedCache::signatureOf(const std::string &name, std::string_view entry) const {
  return hmacSha256(key_, fmt::format("{}\n{}", name, entry));
}

void SharedCache::giveUp(std::string reason) {
  const std::lock_guard lock(mutex_);
  if (isOff_.exchange(true))
    return;
  failure_ = std::move(reason);
}

std::vector<std::string> SharedCache::problems() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> problems;
  if (!failure_.empty())
    problems.push_back(fmt::format("the shared cache {} is not used any further: {}", url_, failure_));
  if (unsigned_ != 0)
    problems.push_back(fmt::format("{} verdict{} of the shared cache {} not signed with your key, and {} proved anew",
                                   unsigned_.load(), unsigned_ == 1 ? "" : "s", unsigned_ == 1 ? "is" : "are",
                                   unsigned_ == 1 ? "was" : "were"));
  return problems;
}

} // namespace feedhold
