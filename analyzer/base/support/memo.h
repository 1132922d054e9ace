// Memo: what a pure function gave for a text, for all threads.
#pragma once

#include <cstddef>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>

namespace feedhold {

/// Answers never depend on what is remembered: the function has to give the same for the same text.  Forgets all when
/// the texts grow beyond a bound.
template <typename Value> class Memo {
public:
  explicit Memo(std::size_t mostBytes) : mostBytes_(mostBytes) {}

  std::optional<Value> find(const std::string &text) const {
    const std::scoped_lock lock(mutex_);
    const auto known = values_.find(text);
    return known == values_.end() ? std::nullopt : std::optional(known->second);
  }

  void keep(std::string text, Value value) {
    const std::scoped_lock lock(mutex_);
    if (bytes_ + text.size() > mostBytes_) {
      values_.clear();
      bytes_ = 0;
    }
    const std::size_t size = text.size();
    if (values_.emplace(std::move(text), std::move(value)).second)
      bytes_ += size;
  }

private:
  std::size_t mostBytes_;
  std::size_t bytes_ = 0; ///< of the texts
  mutable std::mutex mutex_;
  std::unordered_map<std::string, Value> values_;
};

} // namespace feedhold
