// Store<T, IdType>: the only owner of its values; hands out ids, never pointers that outlive an `add`.
#pragma once

#include "base/support/check.h"

#include <span>
#include <utility>
#include <vector>

namespace feedhold {

template <typename T, typename IdType> class Store {
public:
  IdType add(T value) {
    values_.push_back(std::move(value));
    return IdType(values_.size() - 1);
  }
  const T &operator[](IdType id) const {
    FEEDHOLD_CHECK(id.index() < values_.size(), "the id belongs to another store");
    return values_[id.index()];
  }
  T &operator[](IdType id) { return const_cast<T &>(std::as_const(*this)[id]); }

  std::size_t size() const { return values_.size(); }
  bool empty() const { return values_.empty(); }
  void reserve(std::size_t count) { values_.reserve(count); }
  /// Cuts the store back to `count` values: how a parser takes back a guess.
  void truncate(std::size_t count) {
    values_.erase(values_.begin() + static_cast<std::ptrdiff_t>(count), values_.end());
  }

  auto begin() const { return values_.begin(); }
  auto end() const { return values_.end(); }
  /// The values from `first` up to, not including, `last`.
  std::span<const T> slice(IdType first, IdType last) const {
    FEEDHOLD_CHECK(first <= last && last.index() <= values_.size(), "the ids belong to another store");
    return std::span<const T>(values_).subspan(first.index(), last.index() - first.index());
  }
  std::size_t capacityBytes() const { return values_.capacity() * sizeof(T); }

private:
  std::vector<T> values_;
};

} // namespace feedhold
