// HMAC-SHA-256 (RFC 2104): shows that a text comes from somebody who knows a secret key.
#pragma once

#include <string>
#include <string_view>

namespace feedhold {

/// 64 lower-case hexadecimal digits.
std::string hmacSha256(std::string_view key, std::string_view text);

/// In a time that does not tell where two texts of one length differ.
bool isSameSecret(std::string_view a, std::string_view b);

} // namespace feedhold
