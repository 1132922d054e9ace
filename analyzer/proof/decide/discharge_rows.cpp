#include "proof/decide/discharge_rows.h"

#include "proof/smt/steps.h"

#include <algorithm>

namespace feedhold::prove {
namespace {

smt::LinearRelation linear(check::Relation relation) {
  switch (relation) {
  case check::Relation::NonNegative: return smt::LinearRelation::NonNegative;
  case check::Relation::Positive: return smt::LinearRelation::Positive;
  case check::Relation::Zero: return smt::LinearRelation::Zero;
  }
  return smt::LinearRelation::Zero;
}

/// Long fractions would breed longer ones.
Number plain(const Number &value) {
  constexpr int kGrain = 1024;
  return value.words() <= 2 ? value : smt::floor(value * kGrain) / kGrain;
}

} // namespace

Rows::Rows(std::size_t variables) : variableCount_(variables) {
  for (std::uint32_t index = 0; index < variables; ++index)
    columns_.emplace(Monomial{index}, simplex_.addColumn());
}

void Rows::add(RowSource source, const Polynomial &polynomial, check::Relation relation) {
  smt::Simplex::Form form;
  for (const auto &[monomial, coefficient] : polynomial) {
    if (monomial.empty())
      continue;
    auto known = columns_.find(monomial);
    if (known == columns_.end())
      known = columns_.emplace(monomial, simplex_.addColumn(plain(value(monomial).real))).first;
    form.emplace_back(known->second, coefficient);
  }
  std::sort(form.begin(), form.end(), [](const auto &a, const auto &b) { return a.first < b.first; });
  sources_.push_back(std::move(source));
  simplex_.require(static_cast<std::uint32_t>(sources_.size() - 1), form, check::constantOf(polynomial),
                   linear(relation));
}

check::Combination Rows::contradiction() const {
  check::Combination result;
  for (const auto &[reason, multiplier] : simplex_.conflict()) {
    const RowSource &source = sources_[reason];
    if (source.multiplier)
      result.equalities.push_back({Polynomial{{*source.multiplier, multiplier}}, source.hypotheses[0]});
    else
      result.products.push_back({multiplier, source.hypotheses, source.squares});
  }
  return result;
}

DeltaNumber Rows::value(const Monomial &monomial) const {
  if (monomial.empty())
    return {Number(1), Number()};
  if (auto known = columns_.find(monomial); known != columns_.end())
    return simplex_.value(known->second);
  Number product(1);
  for (std::uint32_t index : monomial)
    product *= simplex_.value(columns_.at(Monomial{index})).real;
  return {product, Number()};
}

DeltaNumber Rows::value(const Polynomial &polynomial) const {
  smt::spend(10 * polynomial.size());
  DeltaNumber sum;
  for (const auto &[monomial, coefficient] : polynomial)
    sum += value(monomial) * coefficient;
  return sum;
}

std::size_t Rows::newMonomials(const Polynomial &polynomial) const {
  return static_cast<std::size_t>(std::count_if(polynomial.begin(), polynomial.end(), [&](const auto &part) {
    return !part.first.empty() && !columns_.contains(part.first);
  }));
}

std::vector<Number> Rows::point() const {
  smt::spend(10 * variableCount_);
  const Number delta = simplex_.smallDelta();
  std::vector<Number> values;
  for (std::uint32_t index = 0; index < variableCount_; ++index) {
    const DeltaNumber &value = simplex_.value(columns_.at(Monomial{index}));
    values.push_back(value.real + value.infinitesimal * delta);
  }
  return values;
}

std::vector<Monomial> Rows::quadraticMonomials() const {
  std::vector<Monomial> found;
  for (const auto &[monomial, column] : columns_)
    if (monomial.size() == 2)
      found.push_back(monomial);
  return found;
}

std::vector<std::pair<Monomial, Number>> Rows::brokenProducts(const std::vector<Number> &point) const {
  const Number delta = simplex_.smallDelta();
  std::vector<std::pair<Monomial, Number>> broken;
  for (const Monomial &monomial : quadraticMonomials()) {
    const DeltaNumber &stands = simplex_.value(columns_.at(monomial));
    const Number error = stands.real + stands.infinitesimal * delta - point[monomial[0]] * point[monomial[1]];
    if (!error.isZero())
      broken.emplace_back(monomial, abs(error));
  }
  return broken;
}

bool isViolated(const Rows &rows, const Candidate &candidate) {
  const DeltaNumber value = rows.value(candidate.polynomial);
  const DeltaNumber zero;
  switch (candidate.relation) {
  case check::Relation::NonNegative: return value < zero;
  case check::Relation::Positive: return value <= zero;
  case check::Relation::Zero: return value != zero;
  }
  return false;
}

} // namespace feedhold::prove
