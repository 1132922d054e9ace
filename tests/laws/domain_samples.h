// Random numbers, intervals and grids for the laws of the lattices, each with some of its members.
#pragma once

// A law with || or && stands in parentheses of its own: RC_ASSERT would evaluate both sides.

#include "base/support/rational.h"
#include "inference/domain/number.h"

#include <rapidcheck.h>
#include <vector>

namespace feedhold::laws {

int between(int least, int most);

/// A number as programs write it: whole, a quarter, a thousandth; seldom tiny or huge.
double anyDouble();
Decimal anyDecimal();
Rational anyRational();

/// With bounds like anyDouble(), or none on a side.
Interval anyInterval();
/// The bounds where they are finite, and some numbers between them.
std::vector<double> membersOf(const Interval &interval);

Grid anyGrid();
std::vector<Rational> membersOf(const Grid &grid);

/// An abstract number with values that it must hold, by reading.
struct Sample {
  AbstractNumber number;
  std::vector<double> computed;
  std::vector<Rational> real;
};

/// Of no operation: a constant, a range, some constants joined.
Sample simpleSample();
/// The result of a few operations on simple ones.
Sample anySample();

Sample joined(const Sample &left, const Sample &right);
/// Every value is held.
void expectSound(const Sample &sample);

} // namespace feedhold::laws
