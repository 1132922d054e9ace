// SHA-256 (FIPS 180-4): a name for bytes that nobody can give to other bytes.
#pragma once

#include <string>
#include <string_view>

namespace feedhold {

/// 64 lower-case hexadecimal digits.
std::string sha256(std::string_view bytes);

} // namespace feedhold
