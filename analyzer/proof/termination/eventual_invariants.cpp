#include "proof/termination/eventual_invariants.h"

#include "proof/decide/entails.h"

#include <algorithm>
#include <numeric>

namespace feedhold::prove {

using smt::Number;
using smt::Sort;
using smt::TermId;
using smt::TermKind;

namespace {

constexpr std::size_t kMostBounded = 5;
constexpr std::size_t kMostCandidates = 80;
constexpr int kMostWidenings = 6; // of an interval, before it has no end
constexpr Budget kEffortOfInvariant{.search = 20'000, .z3 = 0, .cvc5 = 0};

} // namespace

struct EventualInvariants::Trial {
  std::uint64_t work = 0;
  std::vector<Outcome> evidence = {};
  std::optional<smt::Model> broken = {}; // by the last question, if its answer had values
};

EventualInvariants::Found EventualInvariants::fromArrival(std::uint64_t mostWork) const {
  std::vector<std::size_t> iterations(loop_.transitions.size());
  std::iota(iterations.begin(), iterations.end(), std::size_t{0});
  const Start start{loop_.arrival, loop_.first};
  std::set<TermId> all = candidates(iterations);
  addIntervals(start, iterations, all);
  return found(start, iterations, {}, std::move(all), mostWork);
}

EventualInvariants::Found EventualInvariants::behind(std::size_t iteration, std::span<const std::size_t> iterations,
                                                     std::span<const TermId> known, std::uint64_t mostWork,
                                                     Tried tried) const {
  Start start{loop_.transitions[iteration].conditions, loop_.transitions[iteration].next};
  start.conditions.insert(start.conditions.end(), known.begin(), known.end());
  std::set<TermId> all = tried == Tried::All ? candidates(iterations) : ofConditions(iterations);
  if (tried == Tried::All)
    addIntervals(start, iterations, all);
  for (const TermId fact : known)
    all.erase(fact);
  return found(start, iterations, known, std::move(all), mostWork);
}

/// Houdini: candidates that do not hold are dropped until all that are left hold together.
EventualInvariants::Found EventualInvariants::found(const Start &start, std::span<const std::size_t> iterations,
                                                    std::span<const TermId> known, std::set<TermId> all,
                                                    std::uint64_t mostWork) const {
  Trial trial;
  std::vector<TermId> left;
  for (const TermId candidate : all)
    if (trial.work < mostWork && left.size() < kMostCandidates &&
        holds(trial, start.conditions, start.state, candidate))
      left.push_back(candidate);
  const std::size_t ofStart = trial.evidence.size();
  for (bool dropped = true; dropped && !left.empty();) {
    dropped = false;
    trial.evidence.erase(trial.evidence.begin() + static_cast<std::ptrdiff_t>(ofStart), trial.evidence.end());
    for (const std::size_t iteration : iterations) {
      const Transition &transition = loop_.transitions[iteration];
      for (std::size_t i = 0; i < left.size();) {
        if (trial.work > mostWork)
          return {{}, {}, trial.work};
        std::vector<TermId> conditions = transition.conditions;
        conditions.insert(conditions.end(), known.begin(), known.end());
        conditions.insert(conditions.end(), left.begin(), left.end());
        if (holds(trial, conditions, transition.next, left[i])) {
          ++i;
          continue;
        }
        dropped = true;
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(i));
        if (trial.broken)
          std::erase_if(left, [&](TermId other) {
            const auto value = smt::evaluate(store_, smt::substitute(store_, other, transition.next), *trial.broken);
            return value && !std::get<bool>(*value);
          });
        i = std::min(i, left.size());
      }
    }
  }
  if (left.empty())
    trial.evidence.clear();
  return {std::move(left), std::move(trial.evidence), trial.work};
}

bool EventualInvariants::holds(Trial &trial, std::span<const TermId> conditions, const smt::Substitution &state,
                               TermId candidate) const {
  const TermId goal = smt::substitute(store_, candidate, state);
  trial.broken.reset();
  if (goal == store_.yes())
    return true;
  Outcome outcome =
      discharge(store_, relevantQuery(store_, index_, interpretation_.facts(), conditions, goal), kEffortOfInvariant);
  trial.work += outcome.effort + 100;
  const bool proved = outcome.proved();
  if (proved)
    trial.evidence.push_back(std::move(outcome));
  else if (const smt::Model *model = outcome.counterexample())
    trial.broken = *model;
  return proved;
}

// ---- candidates ----

/// Of its variables and of what no iteration changes; and not of the latter alone.
bool EventualInvariants::isOfTheLoop(TermId term) const {
  return loop_.isOfState(interpretation_, store_, term) && !loop_.isConstant(interpretation_, store_, term);
}

std::vector<TermId> EventualInvariants::numbers() const {
  std::vector<TermId> numbers;
  for (const TermId variable : loop_.variables)
    if (store_.sort(variable) != Sort::Bool && loop_.deciding.contains(variable) && numbers.size() < kMostBounded)
      numbers.push_back(variable);
  return numbers;
}

/// Numbers, their sums and differences.
std::vector<TermId> EventualInvariants::forms() const {
  const std::vector<TermId> single = numbers();
  std::vector<TermId> forms = single;
  for (const TermId a : single)
    for (const TermId b : single)
      if (a < b) {
        forms.push_back(store_.subtract(a, b));
        forms.push_back(store_.add(a, b));
      }
  return forms;
}

std::set<TermId> EventualInvariants::ofConditions(std::span<const std::size_t> iterations) const {
  std::set<TermId> all;
  for (const std::size_t iteration : iterations)
    for (const TermId part : smt::reachable(store_, loop_.transitions[iteration].conditions))
      addComparison(part, iterations, all);
  std::erase_if(all, [&](TermId candidate) { return !isOfTheLoop(candidate); });
  return all;
}

std::set<TermId> EventualInvariants::candidates(std::span<const std::size_t> iterations) const {
  std::set<TermId> all = ofConditions(iterations);
  for (const TermId number : numbers()) {
    for (const int bound : {0, 1}) {
      all.insert(store_.lessOrEqual(store_.number(Number(bound)), number));
      all.insert(store_.lessOrEqual(number, store_.number(Number(-bound))));
    }
    const TermId half = store_.scale(Number(1) / Number(2), number);
    all.insert({store_.equal(number, store_.floor(number)), store_.equal(half, store_.floor(half))});
  }
  for (const std::size_t iteration : iterations) {
    for (const TermId number : numbers()) {
      const TermId next = loop_.transitions[iteration].next.at(number);
      if (!loop_.isConstant(interpretation_, store_, next))
        continue;
      all.insert(store_.lessOrEqual(number, next));
      all.insert(store_.lessOrEqual(next, number));
    }
  }
  const std::vector<TermId> single = numbers();
  for (const TermId a : single)
    for (const TermId b : single)
      if (a != b)
        all.insert(store_.lessOrEqual(a, b));
  std::erase_if(all, [&](TermId candidate) { return !isOfTheLoop(candidate); });
  return all;
}

/// What an iteration asks for, and what is left of that behind an iteration that adds fixed amounts.
void EventualInvariants::addComparison(TermId condition, std::span<const std::size_t> iterations,
                                       std::set<TermId> &all) const {
  const TermKind kind = store_[condition].kind;
  if ((kind != TermKind::Less && kind != TermKind::LessOrEqual && kind != TermKind::Equal) || !isOfTheLoop(condition))
    return;
  const std::vector<TermId> sides = store_[condition].arguments;
  if (store_.sort(sides[0]) == Sort::Bool)
    return;
  std::vector<TermId> forms{condition, store_.lessOrEqual(sides[0], sides[1])};
  if (kind == TermKind::Equal)
    forms.push_back(store_.lessOrEqual(sides[1], sides[0]));
  if (interpretation_.arithmetic() !=
      Arithmetic::Exact) { // a last step comes to the limit, or as near as rounding lets it
    const TermId nearly = store_.number(Number(1) / Number(1 << 20));
    forms.push_back(store_.lessOrEqual(sides[1], sides[0]));
    forms.push_back(store_.lessOrEqual(sides[1], store_.add(sides[0], nearly)));
  }
  all.insert(forms.begin(), forms.end());
  for (const std::size_t iteration : iterations) {
    smt::Substitution back;
    for (const auto &[variable, next] : loop_.transitions[iteration].next)
      if (store_.sort(variable) != Sort::Bool)
        if (const TermId step = store_.subtract(next, variable); store_.isNumber(step))
          back.emplace(variable, store_.subtract(variable, step));
    for (const TermId form : forms)
      all.insert(smt::substitute(store_, form, back));
  }
}

/// A form that is a number at the start, and that each iteration moves, turns or leaves: all it can be.
void EventualInvariants::addIntervals(const Start &start, std::span<const std::size_t> iterations,
                                      std::set<TermId> &all) const {
  for (const TermId form : forms()) {
    const TermId first = smt::substitute(store_, form, start.state);
    if (!store_.isNumber(first))
      continue;
    Number low = store_[first].number;
    Number high = low;
    bool hasLow = true;
    bool hasHigh = true;
    bool changed = true;
    for (int step = 0; changed && (hasLow || hasHigh); ++step) {
      changed = false;
      for (const std::size_t iteration : iterations) {
        const TermId next = smt::substitute(store_, form, loop_.transitions[iteration].next);
        const TermId moved = store_.subtract(next, form);
        const TermId turned = store_.add(next, form);
        if (!store_.isNumber(next) && !store_.isNumber(moved) && !store_.isNumber(turned)) {
          hasLow = hasHigh = false;
          break;
        }
        const bool isMove = store_.isNumber(moved);
        const bool isFixed = store_.isNumber(next);
        const Number least = isFixed  ? store_[next].number
                             : isMove ? low + store_[moved].number
                                      : store_[turned].number - high;
        const Number most = isFixed  ? store_[next].number
                            : isMove ? high + store_[moved].number
                                     : store_[turned].number - low;
        if (least < low) {
          low = least;
          changed = true;
          hasLow = hasLow && step < kMostWidenings;
        }
        if (most > high) {
          high = most;
          changed = true;
          hasHigh = hasHigh && step < kMostWidenings;
        }
      }
      if (step > 2 * kMostWidenings)
        break;
    }
    if (hasLow)
      all.insert(store_.lessOrEqual(store_.number(low), form));
    if (hasHigh)
      all.insert(store_.lessOrEqual(form, store_.number(high)));
  }
}

} // namespace feedhold::prove
