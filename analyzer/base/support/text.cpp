// Case, trimming, spelling suggestions, a stable hash and glob patterns.
#include "base/support/text.h"

#include <algorithm>
#include <fmt/format.h>
#include <numeric>
#include <vector>

namespace feedhold {

std::string toUpper(std::string_view text) {
  std::string result(text);
  for (char &c : result)
    c = toUpper(c);
  return result;
}

std::string toLower(std::string_view text) {
  std::string result(text);
  for (char &c : result)
    c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return result;
}

std::string decimalText(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.')
      text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r\n\v\f";
  const std::size_t first = text.find_first_not_of(kSpace);
  if (first == std::string_view::npos)
    return {};
  return text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

namespace {

/// Insertions, deletions, replacements, and swaps of two neighbours (optimal string alignment): a swap is one slip
/// of the typing hand.
std::size_t editDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> beforeLast(b.size() + 1);
  std::vector<std::size_t> last(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, replaced});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], beforeLast[j - 2] + 1);
    }
    std::swap(beforeLast, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

} // namespace

std::optional<std::string_view> nearestWord(std::string_view word, std::span<const std::string_view> candidates) {
  std::optional<std::string_view> nearest;
  std::size_t limit = word.size() / 3;
  for (const std::string_view candidate : candidates) {
    const std::size_t distance = editDistance(word, candidate);
    if (distance > limit || (nearest && distance == limit))
      continue;
    nearest = candidate;
    limit = distance;
  }
  return nearest;
}

std::uint64_t stableHash(std::string_view bytes, std::uint64_t seed) {
  constexpr std::uint64_t kPrime = 0x100000001b3ULL;
  std::uint64_t hash = seed;
  for (const char c : bytes) {
    hash ^= static_cast<unsigned char>(c);
    hash *= kPrime;
  }
  return hash;
}

namespace {

/// The places in the path that the pattern read so far can have reached.
using Reached = std::vector<bool>;

/// `**/` at the start of a segment stands for any number of folders, none among them.
Reached passFolders(const Reached &from, std::string_view path) {
  Reached to = from;
  bool any = false;
  for (std::size_t at = 0; at < path.size(); ++at) {
    any = any || from[at];
    if (any && path[at] == '/')
      to[at + 1] = true;
  }
  return to;
}

enum class Crossing { StopsAtSlash, CrossesSlash };

Reached passStar(const Reached &from, std::string_view path, Crossing crossing) {
  Reached to = from;
  for (std::size_t at = 0; at < path.size(); ++at)
    if (to[at] && (crossing == Crossing::CrossesSlash || path[at] != '/'))
      to[at + 1] = true;
  return to;
}

Reached passCharacter(const Reached &from, std::string_view path, char wanted) {
  Reached to(from.size(), false);
  for (std::size_t at = 0; at < path.size(); ++at)
    to[at + 1] = from[at] && (wanted == '?' ? path[at] != '/' : path[at] == wanted);
  return to;
}

} // namespace

bool globMatches(std::string_view pattern, std::string_view path) {
  Reached reached(path.size() + 1, false);
  reached[0] = true;
  for (std::size_t at = 0; at < pattern.size();) {
    const std::string_view rest = pattern.substr(at);
    if (rest.starts_with("**/") && (at == 0 || pattern[at - 1] == '/')) {
      reached = passFolders(reached, path);
      at += 3;
    } else if (rest.starts_with("**")) {
      reached = passStar(reached, path, Crossing::CrossesSlash);
      at += 2;
    } else {
      reached =
          rest[0] == '*' ? passStar(reached, path, Crossing::StopsAtSlash) : passCharacter(reached, path, rest[0]);
      ++at;
    }
  }
  return reached.back();
}

} // namespace feedhold
