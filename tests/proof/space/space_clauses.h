// Space clauses: claims about space that hold of a program, hardly hold, or hardly fail.
#pragma once

#include "proof/geometry/shapes.h"
#include "soundness/macro_programs.h"

#include <optional>

namespace feedhold::proof_tests {

/// A clause with a number left open, `@@`.
struct OpenClause {
  enum class Larger : std::uint8_t { Freer, Tighter }; // what a larger number does to the tool

  std::string text;
  Larger larger;
  double least = -30; // the number; less makes nothing of it

  std::string with(double number) const;
};

/// `way`: a point to which the tool comes on some run.
OpenClause openClause(soundness::Random &random, std::string_view name, const geometry::Point<double> &way);

} // namespace feedhold::proof_tests
