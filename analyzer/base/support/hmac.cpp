#include "base/support/hmac.h"

#include "base/support/sha256.h"

namespace feedhold {

namespace {

/// Of the hash function.
constexpr std::size_t kBlockSize = 64;

/// The bytes of hexadecimal digits.
std::string bytesOf(std::string_view hexadecimal) {
  const auto valueOf = [](char digit) { return digit <= '9' ? digit - '0' : digit - 'a' + 10; };
  std::string bytes;
  for (std::size_t i = 0; i + 1 < hexadecimal.size(); i += 2)
    bytes += static_cast<char>(valueOf(hexadecimal[i]) * 16 + valueOf(hexadecimal[i + 1]));
  return bytes;
}

std::string masked(std::string key, char mask) {
  for (char &byte : key)
    byte = static_cast<char>(byte ^ mask);
  return key;
}

} // namespace

std::string hmacSha256(std::string_view key, std::string_view text) {
  std::string block = key.size() > kBlockSize ? bytesOf(sha256(key)) : std::string(key);
  block.resize(kBlockSize, '\0');
  const std::string inner = bytesOf(sha256(masked(block, 0x36) + std::string(text)));
  return sha256(masked(block, 0x5c) + inner);
}

bool isSameSecret(std::string_view a, std::string_view b) {
  if (a.size() != b.size())
    return false;
  unsigned difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    difference |= static_cast<unsigned char>(a[i] ^ b[i]);
  return difference == 0;
}

} // namespace feedhold
