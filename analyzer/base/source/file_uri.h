// The URIs of files (RFC 8089), as SARIF and editors want them.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace feedhold {

/// A part of a path (`c d/part.nc`) in a URI: everything but unreserved characters and the separators is escaped
/// (RFC 3986).
std::string escapedForUri(std::string_view path);

/// `file:///c%20d/part.nc`, of an absolute path with `/` between its parts.  On Windows that path begins with a drive,
/// `file:///C:/part.nc`, or with a server, `file://server/share/part.nc` (RFC 8089, E.2 and E.3).
std::string uriOfAbsolute(std::string_view path);

/// The same of any path, from the current folder on and without `..`.
std::string uriOfPath(const std::filesystem::path &path);

/// And back.  Of another scheme: empty.  A drive is an upper-case letter, as Windows says it.
std::filesystem::path pathOfUri(std::string_view uri);

} // namespace feedhold
