// Shared cache: verdicts on a web server, so that colleagues, editors and a build server prove each program once.  Any
// server does that answers GET and PUT; the transfer is left to the program `curl`.
//
// A verdict is believed when it is signed: its record says what was proved, but not every step of it, so that reading
// cannot show that it is right (docs/decisions/0020-signed-verdicts.md).
#pragma once

#include <atomic>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace feedhold {

/// May be used from several threads.  After the first request that fails the server is not asked again.
class SharedCache {
public:
  /// `url`: a folder of the server, `http://..` or `https://..`; `key`: the secret of those who may write.
  SharedCache(std::string url, std::string key) : url_(std::move(url)), key_(std::move(key)) {}

  /// Absent: the server does not have it, or it is not signed with the key.
  std::optional<std::string> fetch(const std::string &name);
  void store(const std::string &name, const std::string &entry);

  /// What went wrong, for people; a line each.
  std::vector<std::string> problems() const;

private:
  struct Reply {
    int status = 0; // of HTTP
    std::string body;
  };
  std::optional<Reply> request(const std::string &name, const std::vector<std::string> &options,
                               const std::string &input);
  std::string signatureOf(const std::string &name, std::string_view entry) const;
  void giveUp(std::string reason);

  std::string url_;
  std::string key_;
  std::atomic<bool> isOff_ = false;
  std::atomic<std::size_t> unsigned_ = 0;
  mutable std::mutex mutex_;
  std::string failure_; // why it is off
};

} // namespace feedhold
