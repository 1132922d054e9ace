// CodeSet: which codes of one modal group may be in force.
#pragma once

#include "base/support/check.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace feedhold {

/// Codes by their index in the group (below 64), and apart from them "as at entry": what the caller had in force,
/// which may be any of them.  Never empty.
class CodeSet {
public:
  static constexpr std::size_t kMostCodes = 64;

  /// As at entry.
  constexpr CodeSet() : CodeSet(0, AtEntry::Possible) {}
  static constexpr CodeSet atEntry() { return CodeSet(0, AtEntry::Possible); }
  static constexpr CodeSet of(std::size_t index) { return CodeSet(bitOf(index), AtEntry::Impossible); }

  constexpr bool mayBeAtEntry() const { return atEntry_ == AtEntry::Possible; }
  /// Set on some path; what entry may bring is not asked.
  constexpr bool contains(std::size_t index) const { return (codes_ & bitOf(index)) != 0; }
  /// May be in force, be it set on some path or at entry.
  constexpr bool mayBe(std::size_t index) const { return mayBeAtEntry() || contains(index); }
  constexpr bool isOnly(std::size_t index) const { return !mayBeAtEntry() && codes_ == bitOf(index); }
  /// One code set on all paths.
  constexpr bool isSingle() const { return !mayBeAtEntry() && (codes_ & (codes_ - 1)) == 0; }
  /// That one; absent: there may be several, or none.
  constexpr std::optional<std::uint8_t> only() const {
    return isSingle() && codes_ != 0 ? std::optional(static_cast<std::uint8_t>(std::countr_zero(codes_)))
                                     : std::nullopt;
  }
  /// The codes set on some path, as bits.
  constexpr std::uint64_t codes() const { return codes_; }

  friend constexpr bool operator==(const CodeSet &, const CodeSet &) = default;
  friend constexpr bool leq(const CodeSet &left, const CodeSet &right) {
    return (left.codes_ & ~right.codes_) == 0 && (!left.mayBeAtEntry() || right.mayBeAtEntry());
  }
  friend constexpr CodeSet join(const CodeSet &left, const CodeSet &right) {
    const bool mayBeAtEntry = left.mayBeAtEntry() || right.mayBeAtEntry();
    return CodeSet(left.codes_ | right.codes_, mayBeAtEntry ? AtEntry::Possible : AtEntry::Impossible);
  }

private:
  enum class AtEntry : std::uint8_t { Impossible, Possible };

  constexpr CodeSet(std::uint64_t codes, AtEntry atEntry) : codes_(codes), atEntry_(atEntry) {}
  static constexpr std::uint64_t bitOf(std::size_t index) {
    FEEDHOLD_CHECK(index < kMostCodes, "a modal group with more than 64 codes");
    return std::uint64_t{1} << index;
  }

  std::uint64_t codes_;
  AtEntry atEntry_;
};

} // namespace feedhold
