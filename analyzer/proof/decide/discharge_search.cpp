// Depth-first: linear arithmetic; then clauses, those with one alternative left first; then products; then splits of
// integers and signs.  A branch whose refutation does not use what the branch assumed refutes its parent at once.
#include "proof/decide/discharge_search.h"

#include "proof/decide/cancel.h"
#include "proof/decide/discharge_products.h"
#include "proof/decide/discharge_tree.h"

#include <algorithm>
#include <array>
#include <span>

namespace feedhold::prove {
namespace {

using check::Clause;
using check::Conjunction;
using check::Constraint;
using check::Relation;

constexpr std::size_t kDeepest = 250;
constexpr std::size_t kMostRounds = 60;
/// At one level of products: tangents can go on for ever.
constexpr std::size_t kMostRoundsOfSquares = 6;
constexpr std::size_t kMostSignSplits = 5;
constexpr std::size_t kMostIntegerSplits = 24;

constexpr ProductLimits kProductLevels[] = {{.degree = 2, .factors = 1},
                                            {.degree = 2, .factors = 2},
                                            {.degree = 3, .factors = 2},
                                            {.degree = 3, .factors = 3},
                                            {.degree = 4, .factors = 3}};

constexpr std::size_t kAll = 1'000'000;
constexpr Strategy kStrategies[] = {{Strategy::Order::NewestFirst, 2, 0},
                                    {Strategy::Order::OldestFirst, kAll, 2},
                                    {Strategy::Order::NewestFirst, kAll, 2},
                                    {Strategy::Order::OldestFirst, kAll, 12}};
/// Before integers are split: degree 2.
constexpr std::size_t kPlainLevels = 2;

Number valueAt(const Polynomial &polynomial, const std::vector<Number> &values) {
  Number sum;
  for (const auto &[monomial, coefficient] : polynomial) {
    Number term = coefficient;
    for (std::uint32_t index : monomial)
      term *= values[index];
    sum += term;
  }
  return sum;
}

bool holds(const Constraint &constraint, const Number &value) {
  switch (constraint.relation) {
  case Relation::NonNegative: return value.sign() >= 0;
  case Relation::Positive: return value.sign() > 0;
  case Relation::Zero: return value.isZero();
  }
  return false;
}

bool holds(const Conjunction &conjunction, const std::vector<Number> &values) {
  for (const Constraint &constraint : conjunction.constraints)
    if (!holds(constraint, valueAt(constraint.polynomial, values)))
      return false;
  return std::all_of(conjunction.clauses.begin(), conjunction.clauses.end(), [&](const Clause &clause) {
    return std::any_of(clause.alternatives.begin(), clause.alternatives.end(),
                       [&](const Conjunction &alternative) { return holds(alternative, values); });
  });
}

class Search {
public:
  Search(const check::UnsatProblem &claim, const Strategy &strategy, std::uint64_t workLimit)
      : claim_(claim), workLimit_(workLimit), rows_(claim.variables.size()), products_(strategy) {}

  SearchResult run() {
    SearchResult result;
    Tree tree = under(claim_.conjunction, {});
    if (tree)
      result.answer = Found{numbered(*tree, claim_)};
    else if (satisfied_)
      result.answer = Satisfied{*satisfied_};
    else
      result.answer = NotFound{failure_};
    result.work = work();
    result.reasoning = reasoning_;
    return result;
  }

private:
  struct Depth {
    std::size_t steps = 0, integerSplits = 0, signSplits = 0;
    std::set<std::uint32_t> atZero; ///< variables whose sign was split
    std::set<Polynomial> borders;   ///< what was split elsewhere
  };

  std::uint64_t work() const { return rows_.work() + products_.work(); }

  Tree giveUp(std::string reason) {
    if (failure_.empty())
      failure_ = std::move(reason);
    return nullptr;
  }

  /// Refutes what is assumed so far together with more.
  Tree under(const Conjunction &more, const Depth &depth) {
    const Scope scope = enter(more);
    Tree tree = refute(depth);
    for (auto tightening = scope.tightenings.rbegin(); tree && tightening != scope.tightenings.rend(); ++tightening)
      tree = tightenTree(tightening->first, tightening->second, std::move(tree));
    leave(scope);
    return tree;
  }

  struct Scope {
    smt::Simplex::Mark mark;
    std::size_t hypotheses, clauses;
    Range firstRange;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> tightenings; ///< hypothesis, what it gives
  };

  Scope enter(const Conjunction &more) {
    Scope scope{rows_.mark(), active_.size(), activeClauses_.size(), {}, {}};
    scope.firstRange = {static_cast<std::uint32_t>(pool_.size()),
                        static_cast<std::uint32_t>(pool_.size() + more.constraints.size()),
                        static_cast<std::uint32_t>(clausePool_.size()),
                        static_cast<std::uint32_t>(clausePool_.size() + more.clauses.size())};
    for (const Constraint &constraint : more.constraints)
      assume(constraint);
    for (const Clause &clause : more.clauses) {
      activeClauses_.push_back(static_cast<std::uint32_t>(clausePool_.size()));
      clausePool_.push_back(&clause);
    }
    for (std::uint32_t index = scope.firstRange.firstHypothesis; index < scope.firstRange.endHypothesis; ++index) {
      std::optional<Constraint> stronger = check::tightened(claim_, *pool_[index]);
      if (!stronger || !improves(*stronger, *pool_[index]))
        continue;
      scope.tightenings.emplace_back(index, static_cast<std::uint32_t>(pool_.size()));
      owned_.push_back(std::make_unique<Constraint>(std::move(*stronger)));
      assume(*owned_.back());
    }
    return scope;
  }

  void assume(const Constraint &constraint) {
    const std::uint32_t index = static_cast<std::uint32_t>(pool_.size());
    pool_.push_back(&constraint);
    active_.push_back({index, &constraint});
    RowSource source{{index}, {}, {}};
    if (constraint.relation == Relation::Zero)
      source.multiplier = Monomial();
    rows_.add(std::move(source), constraint.polynomial, constraint.relation);
  }

  void leave(const Scope &scope) {
    rows_.undo(scope.mark);
    active_.resize(scope.hypotheses);
    activeClauses_.resize(scope.clauses);
  }

  static bool improves(const Constraint &stronger, const Constraint &constraint) {
    if (constraint.relation == Relation::Positive)
      return true;
    const auto &[monomial, coefficient] = *stronger.polynomial.rbegin();
    return check::scaled(constraint.polynomial, coefficient / constraint.polynomial.at(monomial)) !=
           stronger.polynomial;
  }

  /// Refutes what is assumed so far.
  Tree refute(const Depth &depth) {
    if (depth.steps > kDeepest)
      return giveUp("gave up: too many cases");
    std::array<std::size_t, std::size(kProductLevels)> roundsOfSquares{};
    for (std::size_t round = 0; round < kMostRounds; ++round) {
      throwIfCancelled();
      const smt::Simplex::Status status = rows_.check(rows_.work() + remaining());
      if (status == smt::Simplex::Status::Infeasible)
        return leaf(rows_.contradiction());
      if (status == smt::Simplex::Status::OutOfBudget || remaining() == 0)
        return giveUp("gave up: the search for a certificate used up its budget");
      const std::vector<Number> point = rows_.point();
      if (satisfies(claim_, point)) {
        satisfied_ = point;
        return nullptr;
      }
      if (std::optional<std::uint32_t> clause = clauseToSplit())
        return splitClause(*clause, depth);
      if (addProducts(0, kPlainLevels, roundsOfSquares))
        continue;
      if (std::optional<Polynomial> difference = integersThatMeet())
        return splitInteger(*difference, 0, depth);
      if (!addProducts(kPlainLevels, std::size(kProductLevels), roundsOfSquares))
        return splitDomain(point, depth);
    }
    return giveUp("products of hypotheses led to no contradiction");
  }

  std::uint64_t remaining() const { return work() >= workLimit_ ? 0 : workLimit_ - work(); }

  bool addProducts(std::size_t firstLevel, std::size_t endLevel, std::span<std::size_t> roundsOfSquares) {
    for (std::size_t level = firstLevel; level < endLevel; ++level) {
      const ProductLimits &limits = kProductLevels[level];
      std::vector<Candidate> rows = products_.violated(rows_, active_, limits, remaining());
      const bool onlySquares =
          std::all_of(rows.begin(), rows.end(), [](const Candidate &row) { return !row.source.squares.empty(); });
      if (rows.empty() || (onlySquares && ++roundsOfSquares[level] > kMostRoundsOfSquares))
        continue;
      reasoning_ = SearchResult::Reasoning::Products;
      for (Candidate &row : rows)
        rows_.add(std::move(row.source), row.polynomial, row.relation);
      return true;
    }
    return false;
  }

  /// Of the clauses that the point breaks: the first with at most one alternative left, or the one with the fewest.
  std::optional<std::uint32_t> clauseToSplit() {
    std::optional<std::uint32_t> best;
    std::size_t fewest = 0;
    const std::vector<std::uint32_t> clauses = activeClauses_; // which grow and shrink while alternatives are tried
    for (std::uint32_t index : clauses) {
      const Clause &clause = *clausePool_[index];
      if (openSplits_.contains(index) || isSatisfiedByRows(clause))
        continue;
      std::size_t open = 0;
      for (const Conjunction &alternative : clause.alternatives)
        open += isOpen(alternative) ? 1 : 0;
      if (open <= 1)
        return index;
      if (!best || open < fewest) {
        best = index;
        fewest = open;
      }
    }
    return best;
  }

  bool isSatisfiedByRows(const Clause &clause) const {
    return std::any_of(clause.alternatives.begin(), clause.alternatives.end(),
                       [&](const Conjunction &alternative) { return isSatisfiedByRows(alternative); });
  }

  bool isSatisfiedByRows(const Conjunction &conjunction) const {
    for (const Constraint &constraint : conjunction.constraints)
      if (isViolated(rows_, {{}, constraint.polynomial, constraint.relation}))
        return false;
    return std::all_of(conjunction.clauses.begin(), conjunction.clauses.end(),
                       [&](const Clause &clause) { return isSatisfiedByRows(clause); });
  }

  /// Linear arithmetic alone does not exclude it.
  bool isOpen(const Conjunction &alternative) {
    throwIfCancelled();
    const Scope scope = enter(alternative);
    const bool open = rows_.check(rows_.work() + remaining()) != smt::Simplex::Status::Infeasible;
    leave(scope);
    pool_.resize(scope.firstRange.firstHypothesis);
    clausePool_.resize(scope.firstRange.firstClause);
    return open;
  }

  Tree splitClause(std::uint32_t index, const Depth &depth) {
    openSplits_.insert(index);
    Tree tree = splitAlternatives(index, depth);
    openSplits_.erase(index);
    return tree;
  }

  Tree splitAlternatives(std::uint32_t index, Depth depth) {
    ++depth.steps;
    std::vector<Branch> branches;
    for (const Conjunction &alternative : clausePool_[index]->alternatives) {
      const Range range = nextRange(alternative);
      Tree tree = under(alternative, depth);
      if (!tree || !tree->uses(range))
        return tree;
      branches.push_back({range, std::move(tree)});
    }
    return splitTree(check::ClauseSplit{index}, std::move(branches));
  }

  Range nextRange(const Conjunction &more) const {
    const auto hypotheses = static_cast<std::uint32_t>(pool_.size());
    const auto clauses = static_cast<std::uint32_t>(clausePool_.size());
    return {hypotheses, hypotheses + static_cast<std::uint32_t>(more.constraints.size()), clauses,
            clauses + static_cast<std::uint32_t>(more.clauses.size())};
  }

  Tree splitInTwo(Step step, const Constraint &first, const Constraint &second, const Depth &depth) {
    std::vector<Branch> branches;
    for (const Constraint *side : {&first, &second}) {
      ownedConjunctions_.push_back(std::make_unique<Conjunction>(Conjunction{{*side}, {}}));
      const Conjunction &assumption = *ownedConjunctions_.back();
      const Range range = nextRange(assumption);
      Tree tree = under(assumption, depth);
      if (!tree || !tree->uses(range))
        return tree;
      branches.push_back({range, std::move(tree)});
    }
    return splitTree(std::move(step), std::move(branches));
  }

  Tree splitDomain(const std::vector<Number> &point, Depth depth) {
    ++depth.steps;
    for (std::uint32_t index = 0; index < point.size(); ++index)
      if (claim_.variables[index].range == check::Range::Integer && !point[index].isInteger())
        return splitInteger(check::variable(index), smt::floor(point[index]), depth);
    if (std::optional<std::uint32_t> variable = variableToSignSplit(point, depth)) {
      depth.atZero.insert(*variable);
      if (++depth.signSplits > kMostSignSplits)
        return giveUp("no certificate of low degree was found");
      if (claim_.variables[*variable].range == check::Range::Integer)
        return splitInteger(check::variable(*variable), -1, depth);
      return splitSign(check::variable(*variable), depth);
    }
    for (std::uint32_t index : activeClauses_)
      if (!openSplits_.contains(index) && clausePool_[index]->alternatives.size() > 1)
        return splitClause(index, depth);
    if (std::optional<Polynomial> border = signToSplit(point, depth)) {
      depth.borders.insert(*border);
      if (++depth.signSplits > kMostSignSplits)
        return giveUp("no certificate of low degree was found");
      return splitSign(*border, depth);
    }
    return giveUp("no certificate of low degree was found");
  }

  Tree splitSign(const Polynomial &border, const Depth &depth) {
    return splitInTwo(check::SignSplit{border}, {border, Relation::NonNegative},
                      {check::scaled(border, -1), Relation::Positive}, depth);
  }

  /// A factor of a product that is not what its factors say: knowing its sign helps most.
  std::optional<std::uint32_t> variableToSignSplit(const std::vector<Number> &point, const Depth &depth) const {
    for (const auto &[monomial, error] : rows_.brokenProducts(point))
      for (std::uint32_t index : monomial)
        if (!depth.atZero.contains(index) && !hasSign(index))
          return index;
    return std::nullopt;
  }

  bool hasSign(std::uint32_t index) const {
    return std::any_of(active_.begin(), active_.end(), [&](const ActiveHypothesis &hypothesis) {
      const Polynomial &polynomial = hypothesis.constraint->polynomial;
      auto found = polynomial.find(Monomial{index});
      const Number constant = check::constantOf(polynomial);
      return hypothesis.constraint->relation != Relation::Zero && found != polynomial.end() &&
             polynomial.size() == (constant.isZero() ? 1 : 2) && constant.sign() <= 0;
    });
  }

  Tree splitInteger(const Polynomial &polynomial, const Number &bound, Depth depth) {
    if (++depth.integerSplits > kMostIntegerSplits)
      return giveUp("gave up: too many integers to try");
    return splitInTwo(check::IntegerSplit{polynomial, bound}, check::atMost(polynomial, bound),
                      check::atLeast(polynomial, bound + 1), depth);
  }

  /// k - q of integers that stand beside the same real (k*h and q*h): at most 0 or at least 1 decides k*h against q*h.
  std::optional<Polynomial> integersThatMeet() {
    auto isInteger = [&](std::uint32_t index) { return claim_.variables[index].range == check::Range::Integer; };
    std::map<std::uint32_t, std::set<std::uint32_t>> beside;
    for (const ActiveHypothesis &hypothesis : active_)
      for (const auto &[monomial, coefficient] : hypothesis.constraint->polynomial)
        for (std::size_t side = 0; monomial.size() == 2 && side < 2; ++side)
          if (isInteger(monomial[side]) && !isInteger(monomial[1 - side]))
            beside[monomial[1 - side]].insert(monomial[side]);
    for (const auto &[real, integers] : beside) {
      for (std::uint32_t first : integers) {
        for (std::uint32_t second : integers) {
          if (first >= second || !splitPairs_.emplace(first, second).second)
            continue;
          Polynomial difference = check::variable(first);
          check::addTo(difference, check::variable(second), -1);
          return difference;
        }
      }
    }
    return std::nullopt;
  }

  /// x - v for the product x*y that is farthest from what its factors say, v being near where x stands.
  std::optional<Polynomial> signToSplit(const std::vector<Number> &point, const Depth &depth) const {
    std::optional<Polynomial> border;
    Number farthest;
    for (const auto &[monomial, error] : rows_.brokenProducts(point)) {
      for (std::uint32_t index : monomial) {
        Polynomial here = check::variable(index);
        check::addTo(here, check::constant(-smt::floor(point[index] * 8) / 8));
        if (error <= farthest || depth.borders.contains(here))
          continue;
        farthest = error;
        border = std::move(here);
      }
    }
    return border;
  }

  const check::UnsatProblem &claim_;
  const std::uint64_t workLimit_;
  Rows rows_;
  Products products_;
  std::vector<const Constraint *> pool_;
  std::vector<const Clause *> clausePool_;
  std::vector<ActiveHypothesis> active_;
  std::vector<std::uint32_t> activeClauses_;
  std::vector<std::unique_ptr<Constraint>> owned_;
  std::vector<std::unique_ptr<Conjunction>> ownedConjunctions_;
  std::set<std::uint32_t> openSplits_; ///< clauses of which an alternative is assumed
  std::set<std::pair<std::uint32_t, std::uint32_t>> splitPairs_;
  std::optional<std::vector<Number>> satisfied_;
  std::string failure_;
  SearchResult::Reasoning reasoning_ = SearchResult::Reasoning::Linear;
};

} // namespace

bool satisfies(const check::UnsatProblem &claim, const std::vector<Number> &values) {
  for (std::size_t index = 0; index < values.size(); ++index)
    if (claim.variables[index].range == check::Range::Integer && !values[index].isInteger())
      return false;
  return holds(claim.conjunction, values);
}

SearchResult searchCertificate(const check::UnsatProblem &claim, std::uint64_t workLimit) {
  SearchResult result{NotFound{"gave up: no budget is left"}};
  std::uint64_t spent = 0;
  // All of them for a short while, then all for longer.
  for (const std::uint64_t slice : {workLimit / 16, workLimit / 4}) {
    for (const Strategy &strategy : kStrategies) {
      if (spent >= workLimit)
        break;
      result = Search(claim, strategy, std::min(slice, workLimit - spent)).run();
      spent += result.work;
      result.work = spent;
      if (!std::holds_alternative<NotFound>(result.answer))
        return result;
      // Without products, all strategies do the same: one of them may have what is left.
      if (result.reasoning == SearchResult::Reasoning::Linear && spent >= slice && spent < workLimit &&
          slice < workLimit / 4) {
        result = Search(claim, strategy, workLimit - spent).run();
        result.work += spent;
        return result;
      }
      if (result.reasoning == SearchResult::Reasoning::Linear)
        return result;
    }
  }
  return result;
}

} // namespace feedhold::prove
