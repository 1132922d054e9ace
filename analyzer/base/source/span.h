// Span: a half-open range of bytes of one file.
#pragma once

#include "base/support/id.h"

#include <compare>
#include <cstdint>

namespace feedhold {

using FileId = Id<struct FileTag>;

struct Span {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;

  constexpr std::uint32_t size() const { return end - begin; }
  constexpr bool empty() const { return begin == end; }
  constexpr bool contains(Span inner) const { return begin <= inner.begin && inner.end <= end; }
  friend constexpr auto operator<=>(const Span &, const Span &) = default;
};

/// The smallest span that covers both.
constexpr Span cover(Span a, Span b) { return {a.begin < b.begin ? a.begin : b.begin, a.end > b.end ? a.end : b.end}; }

} // namespace feedhold
