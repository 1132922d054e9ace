// FiniteSet: a few numbers that are known one by one.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

namespace feedhold {

/// One to kMost different doubles in ascending order, or many: any number.  No member is NaN or -0.
class FiniteSet {
public:
  static constexpr std::size_t kMost = 8;

  constexpr FiniteSet() = default;
  static constexpr FiniteSet many() { return {}; }
  static constexpr FiniteSet constant(double value) {
    FiniteSet set;
    set.values_[0] = value + 0.0;
    set.count_ = 1;
    return set;
  }
  /// many() when there are more than fit, or one that is not finite; absent when there is none.
  static std::optional<FiniteSet> of(std::span<const double> values);

  constexpr bool isMany() const { return count_ == 0; }
  constexpr bool isConstant() const { return count_ == 1; }
  /// Ascending; empty for many().
  std::span<const double> values() const { return std::span(values_).first(count_); }
  bool contains(double value) const;

  /// The values of a function at the members; many() when one of them is not finite.
  template <typename Function> FiniteSet map(Function &&function) const {
    FiniteSet result;
    for (const double value : values()) {
      if (!result.insert(function(value)))
        return many();
    }
    return result;
  }

  /// Of the members that are wanted; absent when there is none.
  template <typename Predicate> std::optional<FiniteSet> filter(Predicate &&isWanted) const {
    if (isMany())
      return *this;
    FiniteSet result;
    for (const double value : values()) {
      if (isWanted(value))
        result.insert(value);
    }
    if (result.isMany())
      return std::nullopt;
    return result;
  }

  /// The values of a function at all pairs of members.
  template <typename Function>
  static FiniteSet combine(const FiniteSet &left, const FiniteSet &right, Function &&function) {
    FiniteSet result;
    for (const double first : left.values()) {
      for (const double second : right.values()) {
        if (!result.insert(function(first, second)))
          return many();
      }
    }
    return result;
  }

  friend bool operator==(const FiniteSet &left, const FiniteSet &right);

private:
  /// False when it does not fit.
  bool insert(double value);

  std::array<double, kMost> values_{};
  std::uint8_t count_ = 0;
};

bool leq(const FiniteSet &left, const FiniteSet &right);
FiniteSet join(const FiniteSet &left, const FiniteSet &right);
std::optional<FiniteSet> meet(const FiniteSet &left, const FiniteSet &right);
/// Two values stay two; then there are many.
FiniteSet widen(const FiniteSet &old, const FiniteSet &next);

} // namespace feedhold
