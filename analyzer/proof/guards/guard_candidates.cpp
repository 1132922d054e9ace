#include "proof/guards/guard_candidates.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace feedhold::prove {

using smt::LinearSum;
using smt::Number;
using smt::Term;
using smt::TermId;
using smt::TermKind;

namespace {

constexpr std::size_t kMostCandidateAtoms = 160;
constexpr std::size_t kMostInputs = 6; // of which each is compared with each other and with all constants
constexpr std::size_t kMostProjected = 48;

/// As it was written: a double is no short fraction.
Number decimal(double value) { return Number::parse(fmt::format("{}", value)).value_or(Number::fromDouble(value)); }

/// `term > 0`, or `>=`.
struct Inequality {
  TermId term;
  Comparison comparison;
};

class Candidates {
public:
  Candidates(AtomMaker &make, SymbolicInterpretation &interpretation, const Exploration &found,
             const std::vector<double> &constants)
      : make_(make), store_(interpretation.store()), found_(found), constants_(constants) {}

  std::vector<GuardAtom> of(const GuardSubject &subject) {
    for (const Query &query : subject.queries)
      speaksOf(query);
    for (const LoopInstance *loop : subject.loops)
      speaksOf(*loop);
    signs();
    relations();
    std::stable_sort(atoms_.begin(), atoms_.end(), [](const auto &a, const auto &b) { return a.rank < b.rank; });
    if (atoms_.size() > kMostCandidateAtoms)
      atoms_.erase(atoms_.begin() + kMostCandidateAtoms, atoms_.end());
    return std::move(atoms_);
  }

private:
  void take(std::optional<GuardAtom> atom) {
    if (atom && atom->holds != store_.yes() && atom->holds != store_.no() && isOfShop(*atom) &&
        known_.insert(atom->holds).second)
      atoms_.push_back(std::move(*atom));
  }
  /// A machinist bounds a variable by a whole number, or by one that the program writes: `#111 LE 14.5` is neither.
  /// A few variables are compared as they are or by factors, such as those between radius and diameter: `[2*#8] LT #4`,
  /// `#2 GE [#1+2*#7]`; with a number beside them only as they are, not `[2*#2] GE [#1+5]`.
  bool isOfShop(const GuardAtom &atom) const {
    const smt::LinearSum sum = store_.linear(atom.side);
    if (!atom.comparison || sum.terms.empty())
      return true;
    const Number factor = abs(sum.terms[0].second);
    const bool isPlainSum =
        std::all_of(sum.terms.begin(), sum.terms.end(), [&](const auto &part) { return abs(part.second) == factor; });
    if (sum.terms.size() > 1 && sum.constant.sign() == 0)
      return isPlainSum || sum.terms.size() <= 3;
    return isPlainSum && isWritten(-sum.constant / sum.terms[0].second);
  }
  /// A whole number, or one that the program writes.
  bool isWritten(const Number &bound) const {
    return bound.isInteger() || std::any_of(constants_.begin(), constants_.end(),
                                            [&](double constant) { return abs(bound) == abs(decimal(constant)); });
  }
  void meet(TermId term, bool isNear) {
    for (const TermId variable : smt::variablesOf(store_, term)) {
      if (!make_.isInput(variable))
        continue;
      const TermId number = make_.numberOf(variable);
      if (std::find(inputs_.begin(), inputs_.end(), number) == inputs_.end())
        inputs_.push_back(number);
      if (isNear)
        near_.insert(number);
    }
  }

  // ---- what the subject says itself ----

  void speaksOf(const Query &query) {
    std::vector<Inequality> wanted;
    meet(query.goal, true);
    says(query.goal, AtomRank::Claim, wanted);
    std::vector<Inequality> known;
    const bool isPath = query.goal == store_.no(); // the claim is that no run takes this path
    for (const TermId assumption : query.assumptions) {
      meet(assumption, isPath);
      says(assumption, isPath ? AtomRank::Claim : AtomRank::Path, known);
    }
    project(wanted, known);
  }
  void speaksOf(const LoopInstance &loop) {
    steps(loop);
    std::vector<Inequality> known;
    for (const Transition &iteration : loop.transitions)
      for (const TermId condition : iteration.conditions) {
        meet(condition, false);
        says(condition, AtomRank::Path, known);
      }
    for (const auto &[variable, value] : loop.first)
      meet(value, false);
  }
  /// What an iteration adds to a variable is near to why the loop ends.
  void steps(const LoopInstance &loop) {
    for (const Transition &iteration : loop.transitions)
      for (const auto &[variable, value] : iteration.next) {
        if (store_.sort(variable) == smt::Sort::Bool)
          continue;
        meet(store_.subtract(value, variable), true);
      }
    for (const LoopInstance::Value &value : loop.values)
      for (const auto &[term, factor] : store_.linear(value.generic).terms) {
        const auto &variables = smt::variablesOf(store_, term);
        if (std::find(variables.begin(), variables.end(), loop.iterations) != variables.end())
          meet(term, true);
      }
  }

  /// The comparisons of a condition, each and its opposite.
  void says(TermId condition, AtomRank rank, std::vector<Inequality> &inequalities) {
    const Term term = store_[condition]; // a copy: the store grows
    switch (term.kind) {
    case TermKind::And:
    case TermKind::Or:
    case TermKind::Not:
      for (const TermId part : term.arguments)
        says(part, rank, inequalities);
      return;
    case TermKind::Variable: take(make_.given(condition, rank)); return;
    case TermKind::Less:
    case TermKind::LessOrEqual: {
      const Comparison comparison = term.kind == TermKind::Less ? Comparison::Above : Comparison::NotBelow;
      says({store_.subtract(term.arguments[1], term.arguments[0]), comparison}, rank);
      inequalities.push_back({store_.subtract(term.arguments[1], term.arguments[0]), comparison});
      return;
    }
    case TermKind::Equal: {
      const TermId difference = store_.subtract(term.arguments[0], term.arguments[1]);
      take(make_.compare(difference, Comparison::Differs, rank));
      take(make_.compare(difference, Comparison::Equals, AtomRank::Path));
      for (const TermId side : {difference, store_.negate(difference)})
        inequalities.push_back({side, Comparison::NotBelow});
      return;
    }
    case TermKind::True:
    case TermKind::False:
    case TermKind::Number:
    case TermKind::Add:
    case TermKind::Multiply:
    case TermKind::Divide:
    case TermKind::Ite:
    case TermKind::Apply: return;
    }
  }
  void says(const Inequality &inequality, AtomRank rank) {
    const bool isStrict = inequality.comparison == Comparison::Above;
    for (const TermId side : {inequality.term, atFirstIteration(inequality.term)}) {
      take(make_.compare(side, inequality.comparison, rank));
      take(make_.compare(store_.negate(side), isStrict ? Comparison::NotBelow : Comparison::Above, rank));
    }
  }
  TermId atFirstIteration(TermId term) {
    for (const LoopInstance &loop : found_.loops)
      term = smt::substitute(store_, term, loop.first);
    return term;
  }

  // ---- projection ----

  /// What is wanted of a value that is no input holds when it holds at the bounds that are known of that value:
  /// `#10 LE #6` and a wanted `#10 LE #5` make `#6 LE #5` (Fourier and Motzkin, one variable after the other).
  void project(std::vector<Inequality> wanted, const std::vector<Inequality> &known) {
    for (std::size_t i = 0; i < wanted.size() && wanted.size() < kMostProjected; ++i) {
      const LinearSum sum = store_.linear(wanted[i].term);
      const auto other = std::find_if(sum.terms.begin(), sum.terms.end(),
                                      [&](const auto &part) { return !make_.isInput(part.first); });
      if (other == sum.terms.end())
        continue;
      for (const Inequality &bound : known)
        if (const auto least = without(other->first, other->second, wanted[i], bound)) {
          take(make_.compare(least->term, least->comparison, AtomRank::Projection));
          wanted.push_back(*least);
        }
    }
  }
  /// The least that `wanted` can be where `bound` holds.
  std::optional<Inequality> without(TermId variable, const Number &factor, const Inequality &wanted,
                                    const Inequality &bound) {
    for (const auto &[term, times] : store_.linear(bound.term).terms)
      if (term == variable && times.sign() == factor.sign())
        return Inequality{store_.subtract(wanted.term, store_.scale(factor / times, bound.term)),
                          bound.comparison == Comparison::Above ? Comparison::NotBelow : wanted.comparison};
    return std::nullopt;
  }

  // ---- what shops ask of arguments ----

  void signs() {
    for (const TermId input : inputs_) {
      const bool isNear = near_.contains(input);
      const AtomRank rank = isNear ? AtomRank::Sign : AtomRank::FarSign;
      const TermId negative = store_.negate(input);
      take(make_.given(input, rank));
      take(make_.compare(input, Comparison::Above, rank));
      take(make_.compare(input, Comparison::NotBelow, rank));
      take(make_.compare(input, Comparison::Differs, rank));
      take(make_.compare(negative, Comparison::Above, AtomRank::Pair));
      take(make_.compare(negative, Comparison::NotBelow, AtomRank::Pair));
    }
  }
  void relations() {
    std::vector<TermId> inputs = inputs_;
    std::stable_partition(inputs.begin(), inputs.end(), [&](TermId input) { return near_.contains(input); });
    if (inputs.size() > kMostInputs)
      inputs.erase(inputs.begin() + kMostInputs, inputs.end());
    for (const TermId input : inputs)
      for (const TermId other : inputs)
        if (input != other)
          for (const Comparison comparison : {Comparison::NotBelow, Comparison::Above})
            take(make_.compare(store_.subtract(input, other), comparison, AtomRank::Pair));
    for (const TermId input : inputs)
      for (const double constant : constants_) {
        const TermId distance = store_.subtract(input, store_.number(decimal(constant)));
        for (const Comparison comparison : {Comparison::NotBelow, Comparison::Above}) {
          take(make_.compare(distance, comparison, AtomRank::Bound));
          take(make_.compare(store_.negate(distance), comparison, AtomRank::Bound));
        }
      }
  }

  AtomMaker &make_;
  smt::TermStore &store_;
  const Exploration &found_;
  const std::vector<double> &constants_; // that the program writes
  std::vector<GuardAtom> atoms_;
  std::set<TermId> known_;
  std::vector<TermId> inputs_; // the numbers of those that the subject speaks of
  std::set<TermId> near_;      // of which its claim itself speaks
};

} // namespace

std::vector<GuardAtom> guardCandidates(AtomMaker &make, SymbolicInterpretation &interpretation,
                                       const GuardSubject &subject, const Exploration &found,
                                       const std::vector<double> &constants) {
  return Candidates(make, interpretation, found, constants).of(subject);
}

} // namespace feedhold::prove
