// Finite sets: sorted arrays of a few doubles.
#include "inference/domain/finite_set.h"

#include <algorithm>
#include <cmath>

namespace feedhold {

std::optional<FiniteSet> FiniteSet::of(std::span<const double> values) {
  if (values.empty())
    return std::nullopt;
  FiniteSet result;
  for (const double value : values) {
    if (!result.insert(value))
      return many();
  }
  return result;
}

bool FiniteSet::contains(double value) const {
  const auto members = values();
  return isMany() || std::find(members.begin(), members.end(), value) != members.end();
}

bool operator==(const FiniteSet &left, const FiniteSet &right) {
  return std::ranges::equal(left.values(), right.values());
}

bool FiniteSet::insert(double value) {
  if (!std::isfinite(value))
    return false;
  auto *const end = values_.data() + count_;
  auto *const at = std::lower_bound(values_.data(), end, value);
  if (at != end && *at == value)
    return true;
  if (count_ == kMost)
    return false;
  std::move_backward(at, end, end + 1);
  *at = value + 0.0;
  ++count_;
  return true;
}

bool leq(const FiniteSet &left, const FiniteSet &right) {
  if (right.isMany())
    return true;
  return !left.isMany() && std::ranges::includes(right.values(), left.values());
}

FiniteSet join(const FiniteSet &left, const FiniteSet &right) {
  if (left.isMany() || right.isMany())
    return FiniteSet::many();
  std::array<double, 2 * FiniteSet::kMost> both{};
  const auto rest = std::ranges::set_union(left.values(), right.values(), both.begin()).out;
  const auto size = static_cast<std::size_t>(rest - both.begin());
  return *FiniteSet::of(std::span(both).first(size));
}

std::optional<FiniteSet> meet(const FiniteSet &left, const FiniteSet &right) {
  if (left.isMany())
    return right;
  return left.filter([&](double value) { return right.contains(value); });
}

FiniteSet widen(const FiniteSet &old, const FiniteSet &next) {
  // Each member more costs a round of the loop: a flag that a loop sets keeps its two values, and a counter becomes
  // a range in the second round.
  constexpr std::size_t kMostInLoops = 2;
  const FiniteSet both = join(old, next);
  return both == old || both.values().size() <= kMostInLoops ? both : FiniteSet::many();
}

} // namespace feedhold
