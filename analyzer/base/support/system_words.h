// What the operating system says of its errors.
#pragma once

#include <string>
#include <system_error>

namespace feedhold {

/// In the words of POSIX, which are the same everywhere; those of Windows depend on its language.
inline std::string inWords(const std::error_code &error) { return error.default_error_condition().message(); }

} // namespace feedhold
