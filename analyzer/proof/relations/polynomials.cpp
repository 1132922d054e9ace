#include "proof/relations/polynomials.h"

#include "proof/decide/linear_algebra.h"
#include "proof/smt/steps.h"

#include <algorithm>
#include <cstdint>

namespace feedhold::prove {

using smt::Number;

namespace {

using Point = std::vector<Number>;
using Row = std::vector<std::uint64_t>;

constexpr std::size_t kMostMonomials = 60;
constexpr std::size_t kSparePoints = 4;         // more than there are monomials: fewer satisfy equalities by chance
constexpr std::uint64_t kPrime = 2'147'483'647; // 2^31 - 1; products of two residues fit 64 bits

/// All of at most so high a degree, the lower ones first.
std::vector<Monomial> monomialsOf(const std::vector<std::size_t> &variables, std::size_t degree) {
  std::vector<Monomial> all{{}};
  std::size_t first = 0; // of the degree before
  for (std::size_t of = 1; of <= degree; ++of) {
    const std::size_t end = all.size();
    for (std::size_t i = first; i < end; ++i)
      for (const std::size_t variable : variables)
        if (all[i].empty() || all[i].back() <= variable) {
          Monomial next = all[i];
          next.push_back(variable);
          all.push_back(std::move(next));
        }
    first = end;
  }
  return all;
}

std::uint64_t power(std::uint64_t base, std::uint64_t exponent) {
  std::uint64_t result = 1;
  for (; exponent > 0; exponent /= 2, base = base * base % kPrime)
    if (exponent % 2 == 1)
      result = result * base % kPrime;
  return result;
}

std::uint64_t residue(const Number &whole) {
  const Number prime(static_cast<std::int64_t>(kPrime));
  return static_cast<std::uint64_t>((whole - prime * floor(whole / prime)).toDouble());
}

/// The points of which the values of the monomials do not depend linearly on those of points before: all that exact
/// algebra has to look at.  Found modulo a prime, where numbers do not grow.
std::vector<std::size_t> independent(const std::vector<Point> &points, const std::vector<Monomial> &monomials) {
  std::vector<std::size_t> chosen;
  std::vector<std::pair<std::size_t, Row>> echelon; // the column of the first 1, and the row
  for (std::size_t point = 0; point < points.size() && chosen.size() < monomials.size(); ++point) {
    smt::spend(monomials.size() * (1 + echelon.size()));
    std::vector<std::uint64_t> values;
    for (const Number &value : points[point])
      values.push_back(residue(value.numerator()) * power(residue(value.denominator()), kPrime - 2) % kPrime);
    Row row;
    for (const Monomial &monomial : monomials) {
      std::uint64_t product = 1;
      for (const std::size_t variable : monomial)
        product = product * values[variable] % kPrime;
      row.push_back(product);
    }
    for (const auto &[column, other] : echelon)
      if (const std::uint64_t factor = row[column]; factor != 0)
        for (std::size_t i = column; i < row.size(); ++i)
          row[i] = (row[i] + (kPrime - factor) * other[i]) % kPrime;
    const auto lead = std::ranges::find_if(row, [](std::uint64_t entry) { return entry != 0; });
    if (lead == row.end())
      continue;
    const std::uint64_t inverse = power(*lead, kPrime - 2);
    const auto column = static_cast<std::size_t>(lead - row.begin());
    for (std::uint64_t &entry : row)
      entry = entry * inverse % kPrime;
    echelon.emplace_back(column, std::move(row));
    chosen.push_back(point);
  }
  return chosen;
}

std::vector<PolynomialEquality> equalitiesOver(const std::vector<Point> &points,
                                               const std::vector<Monomial> &monomials) {
  std::vector<std::vector<Number>> rows;
  for (const std::size_t point : independent(points, monomials)) {
    std::vector<Number> row;
    for (const Monomial &monomial : monomials) {
      Number product(1);
      for (const std::size_t variable : monomial)
        product *= points[point][variable];
      row.push_back(std::move(product));
    }
    rows.push_back(std::move(row));
  }
  std::vector<PolynomialEquality> equalities;
  if (rows.size() == monomials.size())
    return equalities;
  smt::spend(10 * rows.size() * rows.size() * monomials.size());
  for (const std::vector<Number> &factors : nullSpace(std::move(rows), monomials.size())) {
    PolynomialEquality equality;
    for (std::size_t i = 0; i < factors.size(); ++i)
      if (!factors[i].isZero())
        equality.emplace_back(factors[i], monomials[i]);
    equalities.push_back(std::move(equality));
  }
  return equalities;
}

/// Few variables may have many powers.
std::size_t degreeFor(std::size_t variables) { return variables <= 2 ? 4 : variables == 3 ? 3 : 2; }

} // namespace

std::vector<PolynomialEquality> equalitiesAt(const std::vector<Point> &points, std::size_t variables) {
  std::vector<std::size_t> left;
  for (std::size_t variable = 0; variable < variables; ++variable)
    left.push_back(variable);
  if (points.size() < variables + 1 + kSparePoints)
    return {};
  std::vector<PolynomialEquality> all = equalitiesOver(points, monomialsOf(left, 1));
  for (const PolynomialEquality &linear : all) // solved for its last variable, which no other one contains
    std::erase(left, linear.back().second.empty() ? variables : linear.back().second.front());
  for (std::size_t degree = degreeFor(left.size()); degree > 1; --degree) {
    const std::vector<Monomial> monomials = monomialsOf(left, degree);
    if (monomials.size() > kMostMonomials || points.size() < monomials.size() + kSparePoints)
      continue;
    std::vector<PolynomialEquality> higher = equalitiesOver(points, monomials);
    std::ranges::move(higher, std::back_inserter(all));
    break;
  }
  return all;
}

} // namespace feedhold::prove
