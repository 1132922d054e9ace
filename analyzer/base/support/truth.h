// Truth: what is known of a condition: it is false, it is true, or it may be either.
#pragma once

#include <cstdint>

namespace feedhold {

/// The possible outcomes as set bits; never empty.
enum class Truth : std::uint8_t { False = 1, True = 2, Maybe = 3 };

constexpr Truth truthOf(bool value) { return value ? Truth::True : Truth::False; }

constexpr bool mayBeTrue(Truth truth) { return (static_cast<unsigned>(truth) & 2U) != 0; }
constexpr bool mayBeFalse(Truth truth) { return (static_cast<unsigned>(truth) & 1U) != 0; }

/// The truth with these possible outcomes, of which at least one is possible.
constexpr Truth truthOfOutcomes(bool canBeTrue, bool canBeFalse) {
  return static_cast<Truth>((canBeTrue ? 2U : 0U) | (canBeFalse ? 1U : 0U));
}

constexpr Truth negate(Truth truth) { return truthOfOutcomes(mayBeFalse(truth), mayBeTrue(truth)); }

constexpr Truth join(Truth left, Truth right) {
  return truthOfOutcomes(mayBeTrue(left) || mayBeTrue(right), mayBeFalse(left) || mayBeFalse(right));
}

constexpr Truth conjunction(Truth left, Truth right) {
  return truthOfOutcomes(mayBeTrue(left) && mayBeTrue(right), mayBeFalse(left) || mayBeFalse(right));
}

constexpr Truth disjunction(Truth left, Truth right) { return negate(conjunction(negate(left), negate(right))); }

} // namespace feedhold
