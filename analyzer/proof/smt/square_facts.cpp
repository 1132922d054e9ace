#include "proof/smt/square_facts.h"

#include "proof/smt/steps.h"

#include <cmath>
#include <optional>

namespace feedhold::smt {
namespace {

constexpr std::size_t kMostSquares = 3; // of a sum: coordinates in space

/// A sum of squares that is at most a number, or at most another square.
struct SquareSum {
  std::vector<std::pair<TermId, Number>> squared; // with their factors, above 0
  Number most;
  std::optional<std::pair<TermId, Number>> other; // instead of `most`
};

std::optional<TermId> rootOfSquare(const TermStore &store, TermId id) {
  const Term &term = store[id];
  const bool isSquare =
      term.kind == TermKind::Multiply && term.arguments.size() == 2 && term.arguments[0] == term.arguments[1];
  return isSquare ? std::optional(term.arguments[0]) : std::nullopt;
}

/// What `left <= right` says.
std::optional<SquareSum> squareSumOf(TermStore &store, TermId left, TermId right) {
  const LinearSum sum = store.linear(store.subtract(left, right)); // at most 0
  if (sum.terms.size() > kMostSquares + 1)
    return std::nullopt;
  SquareSum found;
  for (const auto &[term, factor] : sum.terms) {
    const std::optional<TermId> root = rootOfSquare(store, term);
    if (!root || (factor.sign() < 0 && found.other))
      return std::nullopt;
    if (factor.sign() < 0)
      found.other = std::pair(*root, -factor);
    else
      found.squared.emplace_back(*root, factor);
  }
  found.most = -sum.constant;
  const bool isBounded = found.other ? found.most.sign() <= 0 : found.most.sign() >= 0;
  return isBounded ? std::optional(std::move(found)) : std::nullopt;
}

class SquareFacts {
public:
  explicit SquareFacts(TermStore &store) : store_(store) {}

  void take(TermId formula) {
    const Term term = store_[formula]; // a copy: terms are made
    spend(1 + term.arguments.size());
    if (term.kind == TermKind::And || term.kind == TermKind::Or)
      for (const TermId part : term.arguments)
        take(part);
    else if (term.kind == TermKind::Less || term.kind == TermKind::LessOrEqual)
      takeComparison(formula, term.arguments[0], term.arguments[1]);
  }
  std::vector<TermId> facts;

private:
  void takeComparison(TermId comparison, TermId left, TermId right) {
    const std::optional<SquareSum> sum = squareSumOf(store_, left, right);
    if (!sum)
      return;
    for (const auto &[x, factor] : sum->squared) {
      if (!sum->other)
        say(comparison, x, store_.number(rootBounds(sum->most / factor).high));
      else if (factor >= sum->other->second)
        say(store_.logicalAnd(comparison, store_.lessOrEqual(store_.number(Number(0)), sum->other->first)), x,
            sum->other->first);
    }
  }
  void say(TermId condition, TermId x, TermId most) {
    facts.push_back(store_.implies(
        condition, store_.logicalAnd(store_.lessOrEqual(store_.negate(most), x), store_.lessOrEqual(x, most))));
  }

  TermStore &store_;
};

} // namespace

std::vector<TermId> squareFacts(TermStore &store, std::span<const TermId> formulas) {
  SquareFacts found(store);
  for (const TermId formula : formulas)
    found.take(formula);
  return std::move(found.facts);
}

/// With few digits: proofs over such numbers are much shorter.
RootBounds rootBounds(const Number &value) {
  const Number grain(std::int64_t{1} << 30);
  const double root = std::sqrt(value.toDouble());
  if (!std::isfinite(root))
    return {Number(0), value + Number(1)};
  const Number low = floor(Number::fromDouble(root) * grain) / grain;
  const Number high = low + Number(2) / grain;
  return {low * low <= value ? low : Number(0), value <= high * high ? high : value + Number(1)};
}

} // namespace feedhold::smt
