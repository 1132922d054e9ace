#include "proof/smt/term.h"

#include "base/support/check.h"
#include "proof/smt/steps.h"

#include <algorithm>
#include <array>
#include <functional>
#include <iterator>

namespace feedhold::smt {
namespace {

std::size_t mix(std::size_t seed, std::size_t value) {
  return seed ^ (value + 0x9E3779B97F4A7C15u + (seed << 6) + (seed >> 2));
}

std::uint32_t hashOf(const Term &term) {
  std::size_t hash = mix(static_cast<std::size_t>(term.kind), static_cast<std::size_t>(term.function));
  for (TermId argument : term.arguments)
    hash = mix(hash, argument.index());
  hash = mix(mix(hash, term.number.hash()), std::hash<std::string>()(term.name));
  return static_cast<std::uint32_t>((hash * 0x9E3779B97F4A7C15u) >> 32);
}

bool areSame(const Term &a, const Term &b) {
  return a.kind == b.kind && a.sort == b.sort && a.function == b.function && a.arguments == b.arguments &&
         a.number == b.number && a.name == b.name;
}

/// Ascending, each term once, without factors of 0.
void combine(std::vector<std::pair<TermId, Number>> &terms) {
  std::ranges::stable_sort(terms, std::less(), [](const auto &part) { return part.first; });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < terms.size();) {
    std::pair<TermId, Number> sum = std::move(terms[i]);
    for (++i; i < terms.size() && terms[i].first == sum.first; ++i)
      sum.second += terms[i].second;
    if (!sum.second.isZero())
      terms[kept++] = std::move(sum);
  }
  terms.erase(terms.begin() + static_cast<std::ptrdiff_t>(kept), terms.end());
}

} // namespace

TermStore::TermStore() {
  intern({.kind = TermKind::False, .sort = Sort::Bool, .arguments = {}, .number = {}, .name = {}});
  intern({.kind = TermKind::True, .sort = Sort::Bool, .arguments = {}, .number = {}, .name = {}});
}

TermId TermStore::number(const Number &value) {
  return intern({.kind = TermKind::Number,
                 .sort = value.isInteger() ? Sort::Int : Sort::Real,
                 .arguments = {},
                 .number = value,
                 .name = {}});
}

TermId TermStore::variable(std::string_view name, Sort sort) {
  if (auto known = variables_.find(name); known != variables_.end()) {
    FEEDHOLD_CHECK(terms_[known->second].sort == sort, "one name has two sorts");
    return known->second;
  }
  TermId id =
      intern({.kind = TermKind::Variable, .sort = sort, .arguments = {}, .number = {}, .name = std::string(name)});
  variables_.emplace(name, id);
  return id;
}

TermId TermStore::variableNamed(std::string_view name) const {
  auto known = variables_.find(name);
  FEEDHOLD_CHECK(known != variables_.end(), "no variable of that name");
  return known->second;
}

TermId TermStore::intern(Term term) {
  constexpr std::uint64_t kSought = 10, kMade = 30;
  const std::uint64_t size = 1 + term.arguments.size() + term.number.words();
  spend(kSought + 2 * size);
  const std::uint32_t hash = hashOf(term);
  if (const auto known = known_.find(hash, [&](std::uint32_t index) { return areSame(terms_[TermId(index)], term); }))
    return TermId(*known);
  spend(kMade + 2 * size);
  shapes_.push_back(shapeOf(term));
  const TermId id = terms_.add(std::move(term));
  negations_.push_back(id);
  known_.add(hash, id.index());
  return id;
}

TermShape TermStore::shapeOf(const Term &term) const {
  constexpr std::uint32_t kMost = 1'000'000;
  TermShape shape{.monomials = term.kind == TermKind::Add ? 0U : 1U,
                  .degree = 0,
                  .depth = 0,
                  .words = static_cast<std::uint32_t>(term.number.words()),
                  .size = 1,
                  .hasFunctions = term.kind == TermKind::Divide || term.kind == TermKind::Apply,
                  .hasRounding = isRounding(term),
                  .hasSquares = isSquareOfSum(*this, term)};
  const auto capped = [](std::uint64_t size) {
    return static_cast<std::uint32_t>(std::min<std::uint64_t>(size, kMost));
  };
  for (const TermId argument : term.arguments) {
    const TermShape &inner = shapes_[argument.index()];
    shape.depth = std::max(shape.depth, inner.depth);
    shape.words = std::max(shape.words, inner.words);
    shape.size = capped(std::uint64_t{shape.size} + inner.size);
    shape.hasFunctions = shape.hasFunctions || inner.hasFunctions;
    shape.hasRounding = shape.hasRounding || inner.hasRounding;
    shape.hasSquares = shape.hasSquares || inner.hasSquares;
    if (term.kind == TermKind::Add) {
      shape.monomials = capped(std::uint64_t{shape.monomials} + inner.monomials);
      shape.degree = std::max(shape.degree, inner.degree);
    } else if (term.kind == TermKind::Multiply) {
      shape.monomials = capped(std::uint64_t{shape.monomials} * inner.monomials);
      shape.degree = capped(std::uint64_t{shape.degree} + inner.degree);
    }
  }
  if (term.kind == TermKind::Divide || term.kind == TermKind::Apply || term.kind == TermKind::Ite)
    shape.depth = capped(std::uint64_t{shape.depth} + 1);
  if (term.kind != TermKind::Add && term.kind != TermKind::Multiply)
    shape.degree = term.kind == TermKind::Number ? 0 : 1;
  return shape;
}

LinearSum TermStore::linear(TermId term) const {
  FEEDHOLD_CHECK(sort(term) != Sort::Bool, "a Bool is no number");
  LinearSum sum;
  auto addOne = [&](TermId part) {
    const Term &node = terms_[part];
    if (node.kind == TermKind::Number)
      sum.constant += node.number;
    else if (node.kind == TermKind::Multiply && isNumber(node.arguments[0]))
      sum.terms.emplace_back(node.arguments[1], terms_[node.arguments[0]].number);
    else
      sum.terms.emplace_back(part, Number(1));
  };
  if (terms_[term].kind != TermKind::Add) {
    addOne(term);
    return sum;
  }
  spend(3 * terms_[term].arguments.size());
  for (TermId part : terms_[term].arguments)
    addOne(part);
  return sum;
}

TermId TermStore::fromLinear(const LinearSum &sum) {
  std::vector<TermId> parts;
  Sort sumSort = Sort::Int;
  for (const auto &[term, factor] : sum.terms) {
    if (factor == Number(1)) {
      parts.push_back(term);
    } else {
      Sort partSort = factor.isInteger() ? sort(term) : Sort::Real;
      TermId coefficient = number(factor);
      parts.push_back(intern(
          {.kind = TermKind::Multiply, .sort = partSort, .arguments = {coefficient, term}, .number = {}, .name = {}}));
    }
    if (sort(parts.back()) == Sort::Real)
      sumSort = Sort::Real;
  }
  if (parts.empty())
    return number(sum.constant);
  if (!sum.constant.isZero()) {
    parts.push_back(number(sum.constant));
    if (!sum.constant.isInteger())
      sumSort = Sort::Real;
  }
  if (parts.size() == 1)
    return parts.front();
  return intern({.kind = TermKind::Add, .sort = sumSort, .arguments = std::move(parts), .number = {}, .name = {}});
}

TermId TermStore::add(std::span<const TermId> terms) {
  LinearSum sum;
  for (TermId term : terms) {
    LinearSum part = linear(term);
    sum.constant += part.constant;
    spend(8 * part.terms.size());
    std::ranges::move(part.terms, std::back_inserter(sum.terms));
  }
  combine(sum.terms);
  return fromLinear(sum);
}

TermId TermStore::add(TermId left, TermId right) {
  if (isNumber(left) && isNumber(right))
    return number(terms_[left].number + terms_[right].number);
  return add(std::array{left, right});
}

LinearSum TermStore::difference(TermId left, TermId right) const {
  LinearSum sum = linear(left), taken = linear(right);
  spend(8 * (sum.terms.size() + taken.terms.size()));
  sum.constant -= taken.constant;
  for (auto &[term, factor] : taken.terms)
    sum.terms.emplace_back(term, -factor);
  combine(sum.terms);
  return sum;
}

TermId TermStore::subtract(TermId left, TermId right) { return fromLinear(difference(left, right)); }

TermId TermStore::scale(const Number &factor, TermId term) {
  if (factor.isZero())
    return number(0);
  LinearSum sum = linear(term);
  sum.constant *= factor;
  for (auto &part : sum.terms)
    part.second *= factor;
  return fromLinear(sum);
}

TermId TermStore::multiply(std::span<const TermId> terms) {
  Number constant(1);
  std::vector<TermId> factors;
  auto take = [&](TermId term, auto &&self) -> void {
    const Term &node = terms_[term];
    FEEDHOLD_CHECK(node.sort != Sort::Bool, "a Bool is no number");
    if (node.kind == TermKind::Number)
      constant *= node.number;
    else if (node.kind != TermKind::Multiply)
      factors.push_back(term);
    else
      for (TermId part : node.arguments)
        self(part, self); // at most two levels: a constant times a product
  };
  for (TermId term : terms)
    take(term, take);
  constant *= joinRoots(factors);
  if (factors.empty() || constant.isZero())
    return number(constant);
  std::sort(factors.begin(), factors.end());
  if (factors.size() == 1)
    return scale(constant, factors.front());
  if (const auto sum = spreadRoot(factors))
    return scale(constant, *sum);
  bool whole = std::all_of(factors.begin(), factors.end(), [this](TermId factor) { return sort(factor) == Sort::Int; });
  return scale(constant, intern({.kind = TermKind::Multiply,
                                 .sort = whole ? Sort::Int : Sort::Real,
                                 .arguments = std::move(factors),
                                 .number = {},
                                 .name = {}}));
}

TermId TermStore::multiply(TermId left, TermId right) { return multiply(std::array{left, right}); }

TermId TermStore::divide(TermId dividend, TermId divisor) {
  LinearSum above = linear(dividend), below = linear(divisor);
  if (below.terms.empty() && !below.constant.isZero())
    return scale(Number(1) / below.constant, dividend);
  // These foldings agree with reading every quotient by 0 as 0, so that they cannot contradict one another there.
  if (above.terms.empty() && above.constant.isZero())
    return number(0);
  Number factor(1);
  if (below.terms.size() == 1 && below.constant.isZero()) {
    factor /= below.terms[0].second;
    divisor = below.terms[0].first;
  }
  if (above.terms.size() == 1 && above.constant.isZero()) {
    factor *= above.terms[0].second;
    dividend = above.terms[0].first;
  }
  return scale(
      factor,
      intern(
          {.kind = TermKind::Divide, .sort = Sort::Real, .arguments = {dividend, divisor}, .number = {}, .name = {}}));
}

bool TermStore::isWhole(const LinearSum &sum) const {
  return std::all_of(sum.terms.begin(), sum.terms.end(),
                     [this](const auto &part) { return part.second.isInteger() && sort(part.first) == Sort::Int; });
}

TermId TermStore::less(TermId left, TermId right) { return compare(TermKind::Less, left, right); }

TermId TermStore::lessOrEqual(TermId left, TermId right) { return compare(TermKind::LessOrEqual, left, right); }

TermId TermStore::equal(TermId left, TermId right) {
  if (sort(left) == Sort::Bool)
    return logicalAnd(implies(left, right), implies(right, left));
  return compare(TermKind::Equal, left, right);
}

/// `left - right` over its first factor: a sum that begins with factor 1, beside a constant.
TermId TermStore::compare(TermKind kind, TermId left, TermId right) {
  const auto decided = [&](const Number &less, const Number &more) {
    const bool holds = kind == TermKind::Less          ? less < more
                       : kind == TermKind::LessOrEqual ? less <= more
                                                       : less == more;
    return holds ? yes() : no();
  };
  if (isNumber(left) && isNumber(right))
    return decided(terms_[left].number, terms_[right].number);
  LinearSum sum = difference(left, right);
  if (sum.terms.empty())
    return decided(sum.constant, Number());
  const Number first = sum.terms.front().second;
  Number bound = -sum.constant / first;
  sum.constant = Number();
  for (auto &part : sum.terms)
    part.second /= first;
  const bool isUpper = first.sign() > 0;
  if (const auto exact = sum.terms.size() == 1 && bound.isZero() ? roundedBy(sum.terms[0].first) : std::nullopt) {
    const TermId zero = number(Number()); // what is rounded has the sign of what it was
    return isUpper ? compare(kind, *exact, zero) : compare(kind, zero, *exact);
  }
  if (isWhole(sum)) { // x < 5/2 is x <= 2 for an integer
    if (kind == TermKind::Equal && !bound.isInteger())
      return no();
    if (kind == TermKind::Less)
      bound = isUpper ? smt::ceiling(bound) - 1 : smt::floor(bound) + 1;
    else if (kind == TermKind::LessOrEqual)
      bound = isUpper ? smt::floor(bound) : smt::ceiling(bound);
    if (kind == TermKind::Less)
      kind = TermKind::LessOrEqual;
  }
  TermId side = fromLinear(sum), constant = number(bound);
  std::vector<TermId> sides =
      isUpper || kind == TermKind::Equal ? std::vector{side, constant} : std::vector{constant, side};
  return intern({.kind = kind, .sort = Sort::Bool, .arguments = std::move(sides), .number = {}, .name = {}});
}

std::optional<TermId> TermStore::roundedBy(TermId id) const {
  const Term &term = terms_[id];
  return term.kind == TermKind::Apply && term.function == Function::Nearest ? std::optional(term.arguments[0])
                                                                            : std::nullopt;
}

TermId TermStore::logicalAnd(std::span<const TermId> terms) { return junction(TermKind::And, terms); }

TermId TermStore::logicalAnd(TermId left, TermId right) { return logicalAnd(std::array{left, right}); }

TermId TermStore::logicalOr(std::span<const TermId> terms) { return junction(TermKind::Or, terms); }

TermId TermStore::logicalOr(TermId left, TermId right) { return logicalOr(std::array{left, right}); }

TermId TermStore::junction(TermKind kind, std::span<const TermId> terms) {
  const TermId neutral = kind == TermKind::And ? yes() : no(), deciding = kind == TermKind::And ? no() : yes();
  std::vector<TermId> parts;
  for (TermId term : terms) {
    FEEDHOLD_CHECK(sort(term) == Sort::Bool, "a number is no Bool");
    spend(2 + 2 * terms_[term].arguments.size());
    if (terms_[term].kind == kind)
      parts.insert(parts.end(), terms_[term].arguments.begin(), terms_[term].arguments.end());
    else if (term != neutral)
      parts.push_back(term);
  }
  std::sort(parts.begin(), parts.end());
  parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
  for (TermId part : parts)
    if (part == deciding || std::binary_search(parts.begin(), parts.end(), logicalNot(part)))
      return deciding;
  if (parts.empty())
    return neutral;
  if (parts.size() == 1)
    return parts.front();
  return intern({.kind = kind, .sort = Sort::Bool, .arguments = std::move(parts), .number = {}, .name = {}});
}

TermId TermStore::logicalNot(TermId id) {
  if (negations_[id.index()] == id) {
    const TermId found = negation(id); // makes terms
    negations_[id.index()] = found;
  }
  return negations_[id.index()];
}

TermId TermStore::negation(TermId id) {
  const Term &term = terms_[id];
  FEEDHOLD_CHECK(term.sort == Sort::Bool, "a number is no Bool");
  if (id == yes() || id == no())
    return id == yes() ? no() : yes();
  if (term.kind == TermKind::Not)
    return term.arguments[0];
  if (term.kind == TermKind::Less || term.kind == TermKind::LessOrEqual) {
    TermId left = term.arguments[0], right = term.arguments[1];
    return term.kind == TermKind::Less ? lessOrEqual(right, left) : less(right, left);
  }
  return intern({.kind = TermKind::Not, .sort = Sort::Bool, .arguments = {id}, .number = {}, .name = {}});
}

TermId TermStore::ite(TermId condition, TermId thenTerm, TermId elseTerm) {
  if (condition == yes() || thenTerm == elseTerm)
    return thenTerm;
  if (condition == no())
    return elseTerm;
  if (sort(thenTerm) == Sort::Bool)
    return logicalAnd(implies(condition, thenTerm), logicalOr(condition, elseTerm));
  if (terms_[condition].kind == TermKind::Not)
    return ite(terms_[condition].arguments[0], elseTerm, thenTerm);
  auto under = [&](TermId branch, std::size_t side) {
    const Term &node = terms_[branch];
    return node.kind == TermKind::Ite && node.arguments[0] == condition ? node.arguments[side] : branch;
  };
  thenTerm = under(thenTerm, 1);
  elseTerm = under(elseTerm, 2);
  if (thenTerm == elseTerm)
    return thenTerm;
  Sort sortOfBoth = sort(thenTerm) == Sort::Int && sort(elseTerm) == Sort::Int ? Sort::Int : Sort::Real;
  return intern({.kind = TermKind::Ite,
                 .sort = sortOfBoth,
                 .arguments = {condition, thenTerm, elseTerm},
                 .number = {},
                 .name = {}});
}

TermId TermStore::truncate(TermId term) { return ite(less(term, number(0)), ceiling(term), floor(term)); }

TermId TermStore::absolute(TermId term) { return ite(less(term, number(0)), negate(term), term); }

} // namespace feedhold::smt
