#include "base/source/path_text.h"

namespace feedhold {

namespace {

using Path = std::filesystem::path;

constexpr bool kHasServers = Path::preferred_separator == '\\';

bool isSeparator(Path::value_type c) { return c == '/' || c == Path::preferred_separator; }

/// `\\server`, and not `\server` or `\\\server`.
bool namesServer(const Path &path) {
  const Path::string_type &text = path.native();
  return kHasServers && text.size() > 2 && isSeparator(text[0]) && isSeparator(text[1]) && !isSeparator(text[2]);
}

/// What was made of a path, with the server of that path.
Path withServer(const Path &path, const Path &made) {
  if (!namesServer(path) || namesServer(made) || made.empty())
    return made;
  return Path::string_type(1, Path::preferred_separator) + made.native();
}

} // namespace

bool isAbsolutePath(const Path &path) { return namesServer(path) || path.is_absolute(); }

Path absolutePath(const Path &path) { return namesServer(path) ? path : std::filesystem::absolute(path); }

Path normalPath(const Path &path) { return withServer(path, path.lexically_normal()); }

Path canonicalPath(const Path &path, std::error_code &error) {
  return namesServer(path) ? normalPath(path) : std::filesystem::weakly_canonical(path, error);
}

std::string pathText(const Path &path) {
  const std::string text = path.generic_string();
  return namesServer(path) && !text.starts_with("//") ? "/" + text : text;
}

} // namespace feedhold
