#include "base/source/file_uri.h"

#include "base/source/path_text.h"
#include "base/support/text.h"

#include <fmt/format.h>

#include <charconv>

namespace feedhold {

namespace {

constexpr std::string_view kScheme = "file://";

/// `C:` in front of a path.
bool beginsWithDrive(std::string_view path) { return path.size() >= 2 && isLetter(path[0]) && path[1] == ':'; }

std::string withoutEscapes(std::string_view text) {
  std::string result;
  for (std::size_t at = 0; at < text.size(); ++at) {
    unsigned value = 0;
    const char *digits = text.data() + at + 1;
    if (text[at] == '%' && at + 2 < text.size() && std::from_chars(digits, digits + 2, value, 16).ptr == digits + 2) {
      result += static_cast<char>(value);
      at += 2;
    } else {
      result += text[at];
    }
  }
  return result;
}

} // namespace

std::string escapedForUri(std::string_view path) {
  constexpr std::string_view kPlain = "0123456789-._~/";
  std::string text;
  for (const char c : path) {
    if (isLetter(c) || kPlain.find(c) != std::string_view::npos)
      text += c;
    else
      text += fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return text;
}

std::string uriOfAbsolute(std::string_view path) {
  if (beginsWithDrive(path))
    return fmt::format("{}/{}{}", kScheme, path.substr(0, 2), escapedForUri(path.substr(2)));
  if (path.starts_with("//")) // a server
    path.remove_prefix(2);
  return fmt::format("{}{}", kScheme, escapedForUri(path));
}

std::string uriOfPath(const std::filesystem::path &path) {
  return uriOfAbsolute(pathText(normalPath(absolutePath(path))));
}

std::filesystem::path pathOfUri(std::string_view uri) {
  if (!uri.starts_with(kScheme))
    return {};
  uri.remove_prefix(kScheme.size());
  const std::string_view host = uri.substr(0, uri.find('/'));
  std::string path = withoutEscapes(uri.substr(host.size()));
  // Roots have names on Windows alone.
  if (const bool isDrive = std::filesystem::path(path.substr(path.empty() ? 0 : 1)).has_root_name(); isDrive) {
    path.erase(0, 1);
    path.front() = toUpper(path.front());
    return path;
  }
  if (const std::filesystem::path share = "//" + withoutEscapes(host) + path;
      host != "localhost" && share.has_root_name())
    return share;
  return path;
}

} // namespace feedhold
