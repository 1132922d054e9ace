// TermTable: which term has the same content.  Open addressing, with the hashes beside the indices: most terms that a
// proof makes are there already, and one look into memory tells so.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace feedhold::smt {

class TermTable {
public:
  /// The index with this hash for which `isSame(index)` is true.
  template <typename IsSame> std::optional<std::uint32_t> find(std::uint32_t hash, IsSame &&isSame) const {
    for (std::size_t place = hash & mask(); entries_[place].index != kNone; place = (place + 1) & mask())
      if (entries_[place].hash == hash && isSame(entries_[place].index))
        return entries_[place].index;
    return std::nullopt;
  }

  /// An index that is not in the table.
  void add(std::uint32_t hash, std::uint32_t index) {
    if (2 * ++size_ > entries_.size())
      for (const Entry &entry : std::exchange(entries_, std::vector<Entry>(2 * entries_.size())))
        if (entry.index != kNone)
          put(entry);
    put({hash, index});
  }

private:
  static constexpr std::uint32_t kNone = 0xffffffff;
  struct Entry {
    std::uint32_t hash = 0;
    std::uint32_t index = kNone;
  };

  std::size_t mask() const { return entries_.size() - 1; }
  void put(const Entry &entry) {
    std::size_t place = entry.hash & mask();
    while (entries_[place].index != kNone)
      place = (place + 1) & mask();
    entries_[place] = entry;
  }

  std::vector<Entry> entries_ = std::vector<Entry>(64); // a power of two
  std::size_t size_ = 0;
};

} // namespace feedhold::smt
