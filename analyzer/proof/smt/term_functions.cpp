// Applications of functions, and what folds in them.
#include "base/support/check.h"
#include "proof/smt/exact_angles.h"
#include "proof/smt/term.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace feedhold::smt {
namespace {

constexpr std::array<std::string_view, 16> kNames = {"floor", "sqrt",   "sin",     "cos", "tan",   "asin",
                                                     "acos",  "atan2",  "ln",      "exp", "power", "bitand",
                                                     "bitor", "bitxor", "nearest", "near"};

/// Products stay readable up to here; higher powers remain applications.
constexpr int kHighestPower = 8;

/// Of two whole numbers that are not negative and below 2^53; elsewhere controls differ.
std::optional<Number> bitwise(Function function, const Number &left, const Number &right) {
  const Number limit = Number(std::int64_t{1} << 53);
  for (const Number *side : {&left, &right})
    if (!side->isInteger() || side->sign() < 0 || *side >= limit)
      return std::nullopt;
  std::int64_t a = left.toRational()->numerator(), b = right.toRational()->numerator();
  if (function == Function::BitAnd)
    return Number(a & b);
  return Number(function == Function::BitOr ? (a | b) : (a ^ b));
}

std::optional<Number> ofConstant(Function function, const Number &value) {
  switch (function) {
  case Function::Floor: return floor(value);
  case Function::Sqrt: return value.sign() < 0 ? std::nullopt : exactSquareRoot(value);
  case Function::Sin: return exactSine(value);
  case Function::Cos: return exactSine(value + 90);
  case Function::Tan: return exactTangent(value);
  case Function::Asin: return exactArcSine(value);
  case Function::Acos: {
    std::optional<Number> angle = exactArcSine(value);
    return angle ? std::optional(Number(90) - *angle) : std::nullopt;
  }
  case Function::Ln: return value == Number(1) ? std::optional(Number(0)) : std::nullopt;
  case Function::Exp: return value.isZero() ? std::optional(Number(1)) : std::nullopt;
  case Function::Nearest: {
    const double nearest = value.toDouble();
    return std::isfinite(nearest) ? std::optional(Number::fromDouble(nearest)) : std::nullopt;
  }
  case Function::Near:
  case Function::Atan2:
  case Function::Power:
  case Function::BitAnd:
  case Function::BitOr:
  case Function::BitXor: return std::nullopt;
  }
  return std::nullopt;
}

} // namespace

TermId TermStore::apply(Function function, TermId argument) { return apply(function, std::array{argument}); }

TermId TermStore::apply(Function function, std::span<const TermId> arguments) {
  FEEDHOLD_CHECK(arguments.size() == arity(function), "a function got the wrong number of arguments");
  for (TermId argument : arguments)
    FEEDHOLD_CHECK(sort(argument) != Sort::Bool, "a Bool is no number");
  if (std::optional<TermId> simpler = folded(function, arguments))
    return *simpler;
  return intern({.kind = TermKind::Apply,
                 .sort = function == Function::Floor ? Sort::Int : Sort::Real,
                 .function = function,
                 .arguments = {arguments.begin(), arguments.end()},
                 .number = {},
                 .name = {}});
}

std::optional<TermId> TermStore::folded(Function function, std::span<const TermId> arguments) {
  if (function == Function::Floor)
    return foldedFloor(arguments[0]);
  if (arguments.size() == 1 && isNumber(arguments[0])) {
    std::optional<Number> value = ofConstant(function, terms_[arguments[0]].number);
    return value ? std::optional(number(*value)) : std::nullopt;
  }
  if (function == Function::Nearest)
    return foldedNearest(arguments[0]);
  if (arguments.size() == 1 || !isNumber(arguments[1]))
    return std::nullopt;
  const Number right = terms_[arguments[1]].number;
  if (function == Function::Power && right.isInteger() && right.sign() > 0 && right <= Number(kHighestPower))
    return multiply(std::vector<TermId>(static_cast<std::size_t>(right.toDouble()), arguments[0]));
  const bool isBitwise = function == Function::BitAnd || function == Function::BitOr || function == Function::BitXor;
  if (isBitwise && isNumber(arguments[0]))
    if (std::optional<Number> value = bitwise(function, terms_[arguments[0]].number, right))
      return number(*value);
  return std::nullopt;
}

/// floor(x + n) is floor(x) + n for whole n.
std::optional<TermId> TermStore::foldedFloor(TermId argument) {
  if (sort(argument) == Sort::Int)
    return argument;
  LinearSum sum = linear(argument), whole, rest;
  whole.constant = smt::floor(sum.constant);
  rest.constant = sum.constant - whole.constant;
  for (const auto &part : sum.terms)
    (part.second.isInteger() && sort(part.first) == Sort::Int ? whole : rest).terms.push_back(part);
  if (rest.terms.empty())
    return fromLinear(whole);
  if (whole.terms.empty() && whole.constant.isZero())
    return std::nullopt;
  TermId left = fromLinear(whole);
  return add(left, floor(fromLinear(rest)));
}

bool TermStore::isRootOfNumber(TermId id) const {
  const Term &term = terms_[id];
  return term.kind == TermKind::Apply && term.function == Function::Sqrt && isNumber(term.arguments[0]) &&
         terms_[term.arguments[0]].number.sign() >= 0;
}

/// The roots of two numbers are one root: `sqrt(2) * sqrt(8)` is 4.  A number that they make is returned.
Number TermStore::joinRoots(std::vector<TermId> &factors) {
  const auto isRoot = [this](TermId factor) { return isRootOfNumber(factor); };
  if (std::ranges::count_if(factors, isRoot) < 2)
    return Number(1);
  Number square(1);
  for (const TermId factor : factors)
    if (isRoot(factor))
      square *= terms_[terms_[factor].arguments[0]].number;
  std::erase_if(factors, isRoot);
  const TermId root = apply(Function::Sqrt, number(square));
  if (isNumber(root))
    return terms_[root].number;
  factors.push_back(root);
  return Number(1);
}

/// The root of a number times a sum, as a number times it would be.
std::optional<TermId> TermStore::spreadRoot(const std::vector<TermId> &factors) {
  if (factors.size() != 2 || isRootOfNumber(factors[0]) == isRootOfNumber(factors[1]))
    return std::nullopt;
  const auto [root, other] =
      isRootOfNumber(factors[0]) ? std::pair(factors[0], factors[1]) : std::pair(factors[1], factors[0]);
  if (terms_[other].kind != TermKind::Add)
    return std::nullopt;
  const LinearSum sum = linear(other);
  std::vector<TermId> parts{scale(sum.constant, root)};
  for (const auto &[term, factor] : sum.terms)
    parts.push_back(scale(factor, multiply(term, root)));
  return add(parts);
}

/// What is a double stays; and rounding is the same on both sides of 0.
std::optional<TermId> TermStore::foldedNearest(TermId argument) {
  const Term &term = terms_[argument];
  if (term.kind == TermKind::Apply && term.function == Function::Sqrt && isNumber(term.arguments[0])) {
    const Number square = terms_[term.arguments[0]].number;
    const double value = square.toDouble();
    if (value >= 0 && std::isfinite(value) && Number::fromDouble(value) == square)
      return number(Number::fromDouble(std::sqrt(value))); // IEEE 754: rounded to the nearest
  }
  if (term.kind == TermKind::Apply && term.function == Function::Nearest)
    return argument;
  const LinearSum sum = linear(argument);
  if (sum.terms.empty() || sum.terms.front().second.sign() > 0)
    return std::nullopt;
  return negate(apply(Function::Nearest, negate(argument)));
}

std::string_view nameOf(Function function) { return kNames[static_cast<std::size_t>(function)]; }

std::size_t arity(Function function) {
  switch (function) {
  case Function::Atan2:
  case Function::Power:
  case Function::BitAnd:
  case Function::BitOr:
  case Function::BitXor:
  case Function::Near: return 2;
  case Function::Floor:
  case Function::Sqrt:
  case Function::Sin:
  case Function::Cos:
  case Function::Tan:
  case Function::Asin:
  case Function::Acos:
  case Function::Ln:
  case Function::Exp:
  case Function::Nearest: return 1;
  }
  FEEDHOLD_UNREACHABLE("a new function needs its arity");
}

} // namespace feedhold::smt
