#include "proof/guards/guard_atoms.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace feedhold::prove {

using smt::LinearSum;
using smt::Number;
using smt::TermId;
using smt::TermKind;

namespace {

/// Larger numbers come from search, not from a shop.
const Number kLargest(1'000'000);

/// Whole factors, and a constant that a short decimal says.
void makeReadable(LinearSum &sum) {
  Number common(1);
  for (const auto &[term, factor] : sum.terms)
    common = lcm(common, factor.denominator());
  if (!(common * sum.constant * Number(1'000)).isInteger())
    common = lcm(common, sum.constant.denominator());
  sum.constant *= common;
  for (auto &part : sum.terms)
    part.second *= common;
}

bool isLarge(const LinearSum &sum) {
  return abs(sum.constant) > kLargest ||
         std::any_of(sum.terms.begin(), sum.terms.end(), [](const auto &part) { return abs(part.second) > kLargest; });
}

std::string bracketed(const std::string &text) {
  return text.find_first_of("+-*/", 1) == std::string::npos ? text : "[" + text + "]";
}

} // namespace

AtomMaker::AtomMaker(SymbolicInterpretation &interpretation, const ProgramSet &programs, const Dialect &dialect)
    : store_(interpretation.store()), comparesExactly_(dialect.behaviour.equalTolerance == 0) {
  for (const auto &[variable, value] : interpretation.entryValues()) {
    const VariableRange *row = variable < kFirstNamedVariable ? findVariable(dialect, variable) : nullptr;
    if (row && row->kind == VariableKind::System)
      continue;
    names_.emplace(value.number, programs.nameOfVariable(variable));
    numbers_.emplace(value.number, value.vacant);
    vacancies_.emplace(value.vacant, value.number);
  }
}

TermId AtomMaker::numberOf(TermId input) const {
  const auto vacancy = vacancies_.find(input);
  return vacancy != vacancies_.end() ? vacancy->second : input;
}

bool AtomMaker::isSimple(TermId term) const {
  const std::vector<TermId> below = smt::reachable(store_, std::array{term});
  return std::all_of(below.begin(), below.end(), [&](TermId part) {
    const TermKind kind = store_[part].kind;
    return kind == TermKind::Number || kind == TermKind::Add || kind == TermKind::Multiply || numbers_.contains(part);
  });
}

std::optional<GuardAtom> AtomMaker::given(TermId input, AtomRank rank) {
  const TermId number = numberOf(input);
  const auto found = numbers_.find(number);
  if (found == numbers_.end())
    return std::nullopt;
  const std::string &name = names_.at(number);
  return GuardAtom{store_.logicalNot(found->second), name + " NE #0", name + "EQ#0", rank, number, std::nullopt};
}

std::optional<GuardAtom> AtomMaker::compare(TermId term, Comparison comparison, AtomRank rank) {
  if (!isSimple(term))
    return std::nullopt;
  LinearSum sum = store_.linear(term);
  if (sum.terms.empty())
    return std::nullopt;
  const bool isEquality = comparison == Comparison::Differs || comparison == Comparison::Equals;
  if (isEquality)
    return comparesExactly_ ? equality(term, comparison, rank) : std::nullopt;
  makeReadable(sum);
  const auto sides = isLarge(sum) ? std::nullopt : this->sides(sum, comparison);
  if (!sides)
    return std::nullopt;
  const TermId zero = store_.number(Number(0));
  return GuardAtom{comparison == Comparison::Above ? store_.less(zero, term) : store_.lessOrEqual(zero, term),
                   fmt::format("{} {} {}", sides->left, sides->relation, sides->right),
                   fmt::format("{}{}{}", sides->left, sides->opposite, sides->right),
                   isLinear(sum) ? rank : AtomRank::Curved,
                   term,
                   comparison};
}

/// The control tells a vacant variable from any number, but takes it as 0 in a sum: a sum is compared with 0.
std::optional<GuardAtom> AtomMaker::equality(TermId term, Comparison comparison, AtomRank rank) {
  LinearSum sum = store_.linear(term);
  const bool isLone = sum.terms.size() == 1 && numbers_.contains(sum.terms[0].first);
  Number value;
  if (isLone) {
    value = -sum.constant / sum.terms[0].second;
    sum = {Number(0), {{sum.terms[0].first, Number(1)}}};
  }
  makeReadable(sum);
  const auto left = isLarge(sum) || abs(value) > kLargest ? std::nullopt : side(sum);
  const auto right = shopText(store_, store_.number(value), names_);
  if (!left || !right || right->find('/') != std::string::npos)
    return std::nullopt;
  const TermId equal = store_.equal(term, store_.number(Number(0)));
  const TermId vacant = isLone ? numbers_.at(sum.terms[0].first) : store_.no();
  const TermId equals = store_.logicalAnd(store_.logicalNot(vacant), equal);
  const bool differs = comparison == Comparison::Differs;
  return GuardAtom{differs ? store_.logicalNot(equals) : equals,
                   fmt::format("{} {} {}", *left, differs ? "NE" : "EQ", *right),
                   fmt::format("{}{}{}", *left, differs ? "EQ" : "NE", *right),
                   isLinear(sum) ? rank : AtomRank::Curved,
                   term,
                   comparison};
}

bool AtomMaker::isLinear(const LinearSum &sum) const {
  return std::all_of(sum.terms.begin(), sum.terms.end(),
                     [&](const auto &part) { return numbers_.contains(part.first); });
}

/// What is added on one side, what is taken away on the other; a variable first, a lone number last.
std::optional<AtomMaker::Sides> AtomMaker::sides(LinearSum sum, Comparison comparison) {
  LinearSum more, less;
  for (const auto &[term, factor] : sum.terms)
    (factor.sign() > 0 ? more : less).terms.emplace_back(term, abs(factor));
  const bool isTurned = more.terms.empty();
  if (isTurned)
    more.constant = sum.constant;
  else if (less.terms.empty())
    less.constant = -sum.constant;
  else
    (sum.constant.sign() > 0 ? more : less).constant = abs(sum.constant);
  const auto left = side(isTurned ? less : more);
  const auto right = side(isTurned ? more : less);
  if (!left || !right)
    return std::nullopt;
  if (comparison == Comparison::Above)
    return Sides{*left, isTurned ? "LT" : "GT", isTurned ? "GE" : "LE", *right};
  return Sides{*left, isTurned ? "LE" : "GE", isTurned ? "GT" : "LT", *right};
}

std::optional<std::string> AtomMaker::side(const LinearSum &sum) {
  const auto text = shopText(store_, store_.fromLinear(sum), names_);
  return text ? std::optional(bracketed(*text)) : std::nullopt;
}

} // namespace feedhold::prove
