#include "proof/explore/invariant_candidates.h"

#include "proof/decide/linear_algebra.h"

#include <algorithm>
#include <set>

namespace feedhold::prove {

using smt::LinearSum;
using smt::Number;
using smt::Sort;
using smt::TermId;
using smt::TermKind;

namespace {

/// Relations between parts are looked for among so many: their number grows with the square.
constexpr std::size_t kMostRelated = 12;

class CandidateSearch {
public:
  CandidateSearch(smt::TermStore &store, const LoopTrial &trial)
      : store_(store), trial_(trial), zero_(store.number(Number(0))) {
    for (std::size_t i = 0; i < parts().size(); ++i)
      if (parts()[i].kind == PartKind::Free)
        (store.sort(parts()[i].symbol) == Sort::Bool ? flags_ : numbers_).push_back(i);
  }

  std::vector<TermId> run() {
    for (const std::size_t flag : flags_)
      offer(store_.logicalNot(parts()[flag].symbol));
    for (const std::size_t number : numbers_)
      bounds(parts()[number]);
    keptSums();
    restoredSums();
    growingSums();
    series();
    arrivalConditions();
    for (const TermId condition : trial_.conditions)
      iterationCondition(condition);
    std::sort(all_.begin(), all_.end());
    all_.erase(std::unique(all_.begin(), all_.end()), all_.end());
    return std::move(all_);
  }

private:
  const std::vector<LoopPart> &parts() const { return trial_.shape.parts; }
  void offer(TermId candidate) { all_.push_back(candidate); }
  TermId change(std::size_t iteration, std::size_t part) {
    return store_.subtract(trial_.left[iteration][part], parts()[part].symbol);
  }

  void bounds(const LoopPart &part) {
    offer(store_.lessOrEqual(part.arrival, part.symbol));
    offer(store_.lessOrEqual(part.symbol, part.arrival));
    offer(store_.lessOrEqual(zero_, part.symbol));
    offer(store_.lessOrEqual(part.symbol, zero_));
    offer(store_.less(zero_, part.symbol));
    offer(store_.less(part.symbol, zero_));
  }

  /// The parts that relations are looked for between, and the number of iterations behind them.
  std::size_t related() const { return std::min(numbers_.size(), kMostRelated); }

  /// Sums of parts that no iteration changes (Karr, "Affine relationships among variables of a program", 1976).
  void keptSums() {
    SumRows rows;
    const TermId one = store_.number(Number(1));
    for (std::size_t iteration = 0; iteration < trial_.left.size(); ++iteration) {
      for (std::size_t column = 0; column < related(); ++column)
        addSum(rows, iteration, column, change(iteration, numbers_[column]));
      rowOf(rows, iteration, one)[related()] += Number(1);
    }
    offerSums(std::move(rows));
  }
  /// Sums of parts that every iteration leaves as they were at the arrival: a coordinate of G90 and what it is
  /// computed from.
  void restoredSums() {
    SumRows rows;
    for (std::size_t iteration = 0; iteration < trial_.left.size(); ++iteration)
      for (std::size_t column = 0; column < related(); ++column) {
        const std::size_t part = numbers_[column];
        addSum(rows, iteration, column, store_.subtract(trial_.left[iteration][part], parts()[part].arrival));
      }
    rowOf(rows, 0, zero_)[related()] = Number(1); // the number of iterations has no share
    offerSums(std::move(rows));
  }

  /// By iteration and term: the factor of the term in the equation of each part, and of the number of iterations.
  using SumRows = std::map<std::pair<std::size_t, TermId>, std::vector<Number>>;

  std::vector<Number> &rowOf(SumRows &rows, std::size_t iteration, TermId term) {
    auto &row = rows[{iteration, term}];
    row.resize(related() + 1);
    return row;
  }
  void addSum(SumRows &rows, std::size_t iteration, std::size_t column, TermId term) {
    const LinearSum sum = store_.linear(term);
    for (const auto &[summand, factor] : sum.terms)
      rowOf(rows, iteration, summand)[column] += factor;
    rowOf(rows, iteration, store_.number(Number(1)))[column] += sum.constant;
  }
  void offerSums(SumRows rows) {
    std::vector<std::vector<Number>> matrix;
    for (auto &[key, row] : rows)
      matrix.push_back(std::move(row));
    for (const std::vector<Number> &factors : nullSpace(std::move(matrix), related() + 1)) {
      const auto [before, now] = sums(factors);
      offer(store_.equal(before, now));
    }
  }
  /// A sum of parts and of the number of iterations at the arrival, and before any iteration.
  std::pair<TermId, TermId> sums(const std::vector<Number> &factors) {
    TermId before = zero_;
    TermId now = store_.scale(factors.back(), trial_.iterations);
    for (std::size_t column = 0; column < related(); ++column) {
      const LoopPart &part = parts()[numbers_[column]];
      before = store_.add(before, store_.scale(factors[column], part.arrival));
      now = store_.add(now, store_.scale(factors[column], part.symbol));
    }
    return {before, now};
  }

  /// Sums of two that some iteration keeps and no iteration lowers, where every iteration changes both by a number.
  void growingSums() {
    std::vector<std::vector<Number>> changes(trial_.left.size());
    for (std::size_t iteration = 0; iteration < trial_.left.size(); ++iteration) {
      for (std::size_t column = 0; column < related(); ++column) {
        const TermId by = change(iteration, numbers_[column]);
        if (!store_.isNumber(by))
          return;
        changes[iteration].push_back(store_[by].number);
      }
      changes[iteration].emplace_back(1);
    }
    for (std::size_t i = 0; i < related() + 1; ++i)
      for (std::size_t j = i + 1; j < related() + 1; ++j)
        for (const auto &kept : changes)
          for (const int sign : {1, -1}) {
            const Number first = Number(sign) * kept[j];
            const Number second = Number(-sign) * kept[i];
            const bool grows = std::all_of(changes.begin(), changes.end(), [&](const auto &by) {
              return (first * by[i] + second * by[j]).sign() >= 0;
            });
            if (!grows || (first.isZero() && second.isZero()))
              continue;
            std::vector<Number> factors(related() + 1);
            factors[i] = first;
            factors[j] = second;
            const auto [before, now] = sums(factors);
            offer(store_.lessOrEqual(before, now));
          }
  }

  /// Parts that every iteration changes by the same polynomial of the number of iterations before it.  What is found
  /// of one part may show the change of another.
  void series() {
    const std::size_t rounds = trial_.search == InvariantSearch::Wide ? numbers_.size() : 1;
    std::set<std::size_t> known;
    for (std::size_t round = 0; round < rounds; ++round) {
      const std::size_t before = known.size();
      for (const std::size_t number : numbers_)
        if (!known.contains(number) && seriesOf(number))
          known.insert(number);
      if (known.size() == before)
        return;
    }
  }

  bool seriesOf(std::size_t part) {
    std::optional<TermId> by;
    for (std::size_t iteration = 0; iteration < trial_.left.size(); ++iteration) {
      if (by && *by != change(iteration, part))
        return false;
      by = change(iteration, part);
    }
    if (!by)
      return false;
    const auto differences = differencesOf(*by);
    if (!differences)
      return false;
    const TermId sum = store_.add(parts()[part].arrival, summed(*differences));
    offer(store_.equal(parts()[part].symbol, sum));
    const auto &variables = smt::variablesOf(store_, sum);
    const bool isClosed = std::ranges::none_of(numbers_, [&](std::size_t number) {
      return std::ranges::find(variables, parts()[number].symbol) != variables.end();
    });
    if (trial_.search == InvariantSearch::Wide && isClosed)
      closedForms_.emplace(parts()[part].symbol, sum);
    return true;
  }

  /// The forward differences at 0 of a polynomial of the number of iterations, without the zeros behind the last
  /// (Newton).  Absent: it is none, or of too high a degree.
  std::optional<std::vector<TermId>> differencesOf(TermId by) {
    constexpr std::size_t kChecked = 2; // differences that have to be 0 beyond the degree
    const std::size_t degree = trial_.search == InvariantSearch::Wide ? 5 : 1;
    const TermId shown = smt::substitute(store_, by, closedForms_);
    std::vector<TermId> values;
    for (std::size_t at = 0; at <= degree + kChecked; ++at) {
      const Number n(static_cast<std::int64_t>(at));
      smt::Substitution now{{trial_.iterations, store_.number(n)}};
      for (const Travel &travel : trial_.shape.travels)
        now.emplace(travel.distance, store_.scale(n, travel.step));
      values.push_back(smt::substitute(store_, shown, now));
    }
    std::vector<TermId> differences;
    while (!values.empty()) {
      differences.push_back(values.front());
      for (std::size_t at = 0; at + 1 < values.size(); ++at)
        values[at] = store_.subtract(values[at + 1], values[at]);
      values.pop_back();
    }
    if (std::any_of(differences.end() - kChecked, differences.end(), [&](TermId term) { return term != zero_; }))
      return std::nullopt;
    while (!differences.empty() && differences.back() == zero_)
      differences.pop_back();
    return differences;
  }

  /// The sum of the first `iterations` values: each difference times iterations over (its order + 1).
  TermId summed(const std::vector<TermId> &differences) {
    std::vector<Number> binomial{Number(1)}; // by power of the number of iterations
    TermId sum = zero_;
    for (std::size_t order = 0; order < differences.size(); ++order) {
      std::vector<Number> next(binomial.size() + 1);
      const Number k(static_cast<std::int64_t>(order));
      for (std::size_t power = 0; power < binomial.size(); ++power) { // times (iterations - k) / (k + 1)
        next[power + 1] += binomial[power] / (k + Number(1));
        next[power] -= k * binomial[power] / (k + Number(1));
      }
      binomial = std::move(next);
      sum = store_.add(sum, store_.multiply(differences[order], inPowers(binomial)));
    }
    return sum;
  }
  TermId inPowers(const std::vector<Number> &factors) {
    TermId sum = zero_;
    TermId power = store_.number(Number(1));
    for (const Number &factor : factors) {
      sum = store_.add(sum, store_.scale(factor, power));
      power = store_.multiply(power, trial_.iterations);
    }
    return sum;
  }

  /// What held of a variable at the arrival may hold of what becomes of it.
  void arrivalConditions() {
    smt::Substitution present;
    for (const std::size_t i : numbers_)
      if (store_[parts()[i].arrival].kind == TermKind::Variable)
        present.emplace(parts()[i].arrival, parts()[i].symbol);
    for (const TermId condition : trial_.arrival) {
      offer(smt::substitute(store_, condition, present));
      for (const TermId variable : smt::variablesOf(store_, condition))
        if (const auto part = present.find(variable); part != present.end())
          offer(smt::substitute(store_, condition, {*part}));
    }
  }

  void iterationCondition(TermId condition) {
    const TermKind kind = store_[condition].kind;
    if (kind == TermKind::Not && store_[store_[condition].arguments[0]].kind == TermKind::Equal) {
      const auto sides = store_[store_[condition].arguments[0]].arguments; // a loop that ends at one value
      offer(store_.lessOrEqual(sides[0], sides[1]));
      offer(store_.lessOrEqual(sides[1], sides[0]));
    }
    if ((numbers_.empty() && flags_.empty()) || (kind != TermKind::Less && kind != TermKind::LessOrEqual))
      return;
    offer(condition);
    offer(store_.logicalNot(condition));
    const auto sides = store_[condition].arguments;
    offer(store_.lessOrEqual(sides[0], sides[1]));
    if (trial_.arithmetic == Arithmetic::Exact)
      return;
    const TermId nearly = store_.number(Number(1) / Number(1 << 20)); // a step to the limit may pass it by rounding
    offer(store_.lessOrEqual(sides[0], store_.add(sides[1], nearly)));
  }

  smt::TermStore &store_;
  const LoopTrial &trial_;
  TermId zero_;
  std::vector<std::size_t> flags_;   // parts that are free: Bools
  std::vector<std::size_t> numbers_; // and numbers
  smt::Substitution closedForms_;    // of parts, over the number of iterations
  std::vector<TermId> all_;
};

} // namespace

std::vector<TermId> invariantCandidates(smt::TermStore &store, const LoopTrial &trial) {
  return CandidateSearch(store, trial).run();
}

} // namespace feedhold::prove
