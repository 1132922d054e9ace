// Id<Tag>: a four-byte index that cannot be mixed up with another kind of index.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>

namespace feedhold {

template <typename Tag> class Id {
public:
  constexpr explicit Id(std::size_t index) : index_(static_cast<std::uint32_t>(index)) {}
  constexpr std::uint32_t index() const { return index_; }
  constexpr Id next() const { return Id(index_ + 1); }
  friend constexpr auto operator<=>(Id, Id) = default;

private:
  std::uint32_t index_;
};

} // namespace feedhold
