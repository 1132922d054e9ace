// From terms to a claim: negation normal form, nothing clever.
#include "proof/check/problem.h"

#include "base/support/check.h"

#include <map>

namespace feedhold::check {
namespace {

using smt::Sort;
using smt::Term;
using smt::TermId;
using smt::TermKind;

constexpr std::size_t kMostConstraints = 20'000;
constexpr std::size_t kMostMonomials = 2'000;
constexpr std::size_t kHighestDegree = 12;
constexpr std::size_t kDeepest = 400;

enum class Polarity : std::uint8_t { Positive, Negative };

Polarity opposite(Polarity polarity) {
  return polarity == Polarity::Positive ? Polarity::Negative : Polarity::Positive;
}

class Builder {
public:
  explicit Builder(const smt::TermStore &store) : store_(store) {}

  Result<UnsatProblem> build(std::span<const TermId> formulas) {
    const std::vector<TermId> all = smt::reachable(store_, formulas);
    for (TermId id : all)
      prepare(id);
    for (TermId id : all)
      if (!failed() && store_[id].kind == TermKind::Ite)
        defineIte(id);
    for (TermId formula : formulas)
      if (!failed())
        require(claim_.conjunction, formula, Polarity::Positive, 0);
    if (failed())
      return Error{failure_};
    return std::move(claim_);
  }

private:
  bool failed() const { return !failure_.empty(); }

  /// Variables and polynomials of one term; its arguments have theirs.
  void prepare(TermId id) {
    const Term &term = store_[id];
    switch (term.kind) {
    case TermKind::Number: polynomials_[id] = constant(term.number); return;
    case TermKind::Variable: prepareVariable(id); return;
    case TermKind::Ite: polynomials_[id] = newVariable("!ite" + std::to_string(++ites_), term.sort); return;
    case TermKind::Add:
    case TermKind::Multiply: prepareArithmetic(id); return;
    case TermKind::Divide:
    case TermKind::Apply: failure_ = "a quotient or a function is left in the formula"; return;
    case TermKind::True:
    case TermKind::False:
    case TermKind::Less:
    case TermKind::LessOrEqual:
    case TermKind::Equal:
    case TermKind::And:
    case TermKind::Or:
    case TermKind::Not: return;
    }
  }

  Polynomial newVariable(const std::string &name, Sort sort) {
    claim_.variables.push_back({name, sort == Sort::Real ? Range::Real : Range::Integer});
    return variable(static_cast<std::uint32_t>(claim_.variables.size() - 1));
  }

  void prepareVariable(TermId id) {
    const Term &term = store_[id];
    polynomials_[id] = newVariable(term.name, term.sort);
    if (term.sort != Sort::Bool)
      return;
    Polynomial upTo1 = constant(1);
    addTo(upTo1, polynomials_[id], -1);
    claim_.conjunction.constraints.push_back({polynomials_[id], Relation::NonNegative});
    claim_.conjunction.constraints.push_back({upTo1, Relation::NonNegative});
  }

  void prepareArithmetic(TermId id) {
    const Term &term = store_[id];
    Polynomial result = constant(term.kind == TermKind::Add ? 0 : 1);
    for (TermId argument : term.arguments) {
      const Polynomial &part = polynomials_[argument];
      if (term.kind == TermKind::Add)
        addTo(result, part);
      else if (result.size() * part.size() > kMostMonomials || degree(result) + degree(part) > kHighestDegree)
        failure_ = "a polynomial is too large";
      else
        result = multiply(result, part);
    }
    if (result.size() > kMostMonomials)
      failure_ = "a polynomial is too large";
    polynomials_[id] = std::move(result);
  }

  void defineIte(TermId id) {
    const Term &term = store_[id];
    Clause clause;
    for (Polarity polarity : {Polarity::Positive, Polarity::Negative}) {
      Conjunction &branch = clause.alternatives.emplace_back();
      require(branch, term.arguments[0], polarity, 0);
      TermId value = term.arguments[polarity == Polarity::Positive ? 1 : 2];
      addConstraint(branch, difference(id, value), Relation::Zero);
    }
    claim_.conjunction.clauses.push_back(std::move(clause));
  }

  Polynomial difference(TermId left, TermId right) {
    Polynomial result = polynomials_.at(left);
    addTo(result, polynomials_.at(right), -1);
    return result;
  }

  void addConstraint(Conjunction &target, Polynomial polynomial, Relation relation) {
    if (++constraints_ > kMostConstraints)
      failure_ = "the formula is too large";
    target.constraints.push_back({std::move(polynomial), relation});
  }

  void require(Conjunction &target, TermId id, Polarity polarity, std::size_t depth) {
    const Term &term = store_[id];
    const bool positive = polarity == Polarity::Positive;
    if (depth > kDeepest)
      failure_ = "the formula nests too deep";
    if (failed())
      return;
    switch (term.kind) {
    case TermKind::True:
    case TermKind::False:
      if ((term.kind == TermKind::True) != positive)
        addConstraint(target, constant(-1), Relation::NonNegative);
      return;
    case TermKind::Variable: {
      Polynomial literal = positive ? polynomials_.at(id) : scaled(polynomials_.at(id), -1);
      addTo(literal, constant(positive ? -1 : 0));
      return addConstraint(target, std::move(literal), Relation::Zero);
    }
    case TermKind::Less:
    case TermKind::LessOrEqual:
    case TermKind::Equal: return requireRelation(target, term, polarity);
    case TermKind::Not: return require(target, term.arguments[0], opposite(polarity), depth + 1);
    case TermKind::And:
    case TermKind::Or: return requireJunction(target, term, polarity, depth);
    case TermKind::Number:
    case TermKind::Add:
    case TermKind::Multiply:
    case TermKind::Divide:
    case TermKind::Ite:
    case TermKind::Apply: FEEDHOLD_UNREACHABLE("a number is no formula");
    }
  }

  void requireRelation(Conjunction &target, const Term &term, Polarity polarity) {
    const TermId left = term.arguments[0], right = term.arguments[1];
    const bool positive = polarity == Polarity::Positive;
    if (term.kind == TermKind::Equal && positive)
      return addConstraint(target, difference(left, right), Relation::Zero);
    if (term.kind == TermKind::Equal) {
      Clause apart;
      addConstraint(apart.alternatives.emplace_back(), difference(left, right), Relation::Positive);
      addConstraint(apart.alternatives.emplace_back(), difference(right, left), Relation::Positive);
      target.clauses.push_back(std::move(apart));
      return;
    }
    // not (left < right) is left - right >= 0
    const bool strict = (term.kind == TermKind::Less) == positive;
    addConstraint(target, positive ? difference(right, left) : difference(left, right),
                  strict ? Relation::Positive : Relation::NonNegative);
  }

  void requireJunction(Conjunction &target, const Term &term, Polarity polarity, std::size_t depth) {
    if ((term.kind == TermKind::And) == (polarity == Polarity::Positive)) {
      for (TermId argument : term.arguments)
        require(target, argument, polarity, depth + 1);
      return;
    }
    Clause clause;
    for (TermId argument : term.arguments)
      require(clause.alternatives.emplace_back(), argument, polarity, depth + 1);
    target.clauses.push_back(std::move(clause));
  }

  const smt::TermStore &store_;
  UnsatProblem claim_;
  std::map<TermId, Polynomial> polynomials_;
  std::size_t constraints_ = 0, ites_ = 0;
  std::string failure_;
};

} // namespace

Result<UnsatProblem> claimOf(const smt::TermStore &store, std::span<const TermId> formulas) {
  return Builder(store).build(formulas);
}

} // namespace feedhold::check
