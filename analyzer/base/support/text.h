// Small helpers on text that several libraries need.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace feedhold {

constexpr bool isBlank(char c) { return c == ' ' || c == '\t'; }
constexpr bool isDigit(char c) { return c >= '0' && c <= '9'; }
constexpr bool isLetter(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); }
constexpr char toUpper(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }

std::string toUpper(std::string_view text);
std::string toLower(std::string_view text);
std::string_view trimmed(std::string_view text);

/// As a control shows it: `12.5`, `-0.001`, `0`; no exponent, no zeros behind the last decimal, no `-0`.
std::string decimalText(double value, int decimals);

/// The candidate nearest to `word` by edit distance (a swap of two neighbours counts once), the first of equals, for
/// "did you mean"; absent when none is near (distance over a third of the word).  Case counts.
std::optional<std::string_view> nearestWord(std::string_view word, std::span<const std::string_view> candidates);

/// 64-bit FNV-1a over the bytes; stable across platforms and releases (fingerprints depend on it).
std::uint64_t stableHash(std::string_view bytes, std::uint64_t seed = 0xcbf29ce484222325ULL);

/// A pattern with `*` and `?` (not crossing `/`) and `**` (crossing it; `**/` may also stand for no folder at all)
/// against a whole path with `/` separators.
bool globMatches(std::string_view pattern, std::string_view path);

} // namespace feedhold
