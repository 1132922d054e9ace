// Sines, tangents and their inverses where they are rational, and enclosures elsewhere.  Angles in degrees.
#pragma once

#include "proof/smt/number.h"

#include <optional>

namespace feedhold::smt {

/// Rational at multiples of 30 degrees only (Niven's theorem), and there not at the odd multiples of 60.
std::optional<Number> exactSine(const Number &degrees);
std::optional<Number> exactTangent(const Number &degrees);
std::optional<Number> exactArcSine(const Number &sine);

struct Enclosure {
  Number low;
  Number high;
};
/// low <= sin(degrees) <= high, a few billionths of a thousandth wide.
Enclosure encloseSine(const Number &degrees);

} // namespace feedhold::smt
