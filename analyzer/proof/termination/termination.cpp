#include "proof/termination/termination.h"

#include "proof/decide/entails.h"
#include "proof/smt/steps.h"
#include "proof/termination/eventual_invariants.h"
#include "proof/termination/ranking_synthesis.h"

#include <algorithm>
#include <array>
#include <set>

namespace feedhold::prove {

using smt::Number;
using smt::TermId;
using smt::TermKind;

namespace {

constexpr std::size_t kMostRankings = 60;
constexpr std::size_t kMostPhases = 3;
constexpr std::size_t kMostDecreasing = 16;
constexpr std::size_t kLikely = 4;      // ranking functions, the first of them
constexpr std::size_t kMostModels = 24; // of an iteration, the latest
constexpr std::size_t kMostChoices = 4; // of what an iteration takes of a ranking function
/// A ranking function that needs more is seldom the right one; what is linear takes less.
constexpr Budget kEffort{.search = 200'000, .z3 = 0, .cvc5 = 0};
/// Of one that is only tried.
constexpr Budget kLittle{.search = 8'000, .z3 = 0, .cvc5 = 0};
/// For all questions about one loop.
constexpr std::uint64_t kMostWork = 1'500'000;
constexpr std::uint64_t kMostSteps = 3 * kStepsOfWork * kMostWork;

class RankingSearch {
public:
  RankingSearch(const SymbolicInterpretation &interpretation, smt::TermStore &store, const LoopInstance &loop,
                std::span<const AwaitedRead> awaited)
      : interpretation_(interpretation), store_(store), loop_(loop), awaited_(awaited), index_(store) {
    index_.add(interpretation.facts());
  }

  Termination run() {
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < loop_.transitions.size(); ++i)
      all.push_back(i);
    models_.resize(all.size());
    candidates_ = candidateRankings();
    result_.proved = attempt([&] { return rankQuickly(all); }) || rankWithSupport([&] { return rankQuickly(all); }) ||
                     attempt([&] { return rank(all); }) || rankWithSupport([&] { return rank(all); });
    if (!result_.proved)
      result_.reason = "no ranking function was found: no value provably falls at every iteration";
    return std::move(result_);
  }

private:
  /// A failed attempt leaves no trace in the result.
  template <typename Rank> bool attempt(Rank &&rankIt) {
    const std::size_t rankings = result_.rankings.size();
    const std::size_t evidence = result_.evidence.size();
    if (rankIt())
      return true;
    result_.rankings.erase(result_.rankings.begin() + static_cast<std::ptrdiff_t>(rankings), result_.rankings.end());
    result_.evidence.erase(result_.evidence.begin() + static_cast<std::ptrdiff_t>(evidence), result_.evidence.end());
    return false;
  }

  /// None is left, or one that never comes twice in a row.
  bool isOver(const std::vector<std::size_t> &iterations) {
    return iterations.empty() || (iterations.size() == 1 && !canFollow(iterations.front(), iterations.front()));
  }
  /// By the conditions of the loop alone.
  bool rankQuickly(std::vector<std::size_t> iterations) {
    return withLittle([&] {
      while (!iterations.empty() && (lower(iterations, likely()) || lowerChosen(iterations, likely()))) {
      }
      return isOver(iterations);
    });
  }
  /// Iterations that can follow one another in a cycle are ranked together.
  bool rank(std::vector<std::size_t> iterations) {
    if (!phases_.empty())
      std::erase_if(iterations, [&](std::size_t iteration) { return holds(iteration, store_.no(), result_.evidence); });
    if (isOver(iterations) || waitForInput(iterations))
      return true;
    if (withLittle([&] { return lower(iterations, candidates_) || lowerChosen(iterations, candidates_); }) ||
        lowerByProgram(iterations))
      return rank(iterations);
    // A last step that comes to its limit as near as rounding lets it.
    if (interpretation_.arithmetic() != Arithmetic::Exact &&
        afterIteration(iterations, EventualInvariants::Tried::Conditions))
      return true;
    if (withLittle([&] {
          const std::vector<TermId> chosen = choices();
          return lower(iterations, chosen) || lowerChosen(iterations, chosen);
        }))
      return rank(iterations);
    if (iterations.size() > 12 || work_ > kMostWork)
      return false;
    const auto cycles = cyclesOf(iterations);
    if (cycles.size() == 1 && cycles.front().size() == iterations.size())
      return inPhases(iterations) || (lower(iterations, likely()) && rank(iterations)) ||
             afterIteration(iterations, EventualInvariants::Tried::All) ||
             (lower(iterations, candidates_) && rank(iterations)) || afterPhase(iterations);
    return std::all_of(cycles.begin(), cycles.end(), [&](const auto &cycle) { return rank(cycle); });
  }
  /// Each of them reads an awaited input at one place, and goes on with another value: a run cannot make these
  /// iterations alone without end.
  bool waitForInput(const std::vector<std::size_t> &iterations) {
    return std::ranges::any_of(awaited_, [&](const AwaitedRead &first) {
      std::vector<Outcome> evidence;
      const bool allWait = std::ranges::all_of(iterations, [&](std::size_t iteration) {
        return std::ranges::any_of(awaited_, [&](const AwaitedRead &read) {
          return read.place == first.place && read.clause == first.clause && isRead(read, iteration) &&
                 holds(iteration, read.isOther, evidence);
        });
      });
      if (!allWait)
        return false;
      std::ranges::move(evidence, std::back_inserter(result_.evidence));
      result_.awaited = first.clause;
      return true;
    });
  }
  /// In this iteration, and not before the loop.
  bool isRead(const AwaitedRead &read, std::size_t iteration) const {
    const std::vector<TermId> variables = smt::variablesOf(store_, loop_.transitions[iteration].conditions);
    return !loop_.isFixed(interpretation_, read.number) && std::ranges::binary_search(variables, read.number);
  }

  std::vector<TermId> likely() const {
    return {candidates_.begin(),
            candidates_.begin() + static_cast<std::ptrdiff_t>(std::min(kLikely, candidates_.size()))};
  }
  template <typename Try> bool withLittle(Try &&tried) {
    const Budget before = std::exchange(effort_, kLittle);
    const bool found = tried();
    effort_ = before;
    return found;
  }

  /// With more facts that hold before every iteration.
  template <typename Rank> bool rankWithSupport(Rank &&rankIt) {
    if (!support_)
      support_ = EventualInvariants(interpretation_, store_, loop_).fromArrival(kMostWork / 4);
    work_ = 0;
    return !support_->facts.empty() && within(*support_, rankIt);
  }

  /// An iteration that is made again and again is made once: what it leaves, and every iteration keeps, holds from then
  /// on.  So all iterations are ranked where that holds, and the others without this one.
  bool afterIteration(const std::vector<std::size_t> &iterations, EventualInvariants::Tried tried) {
    if (phases_.size() >= kMostPhases)
      return false;
    const EventualInvariants lasting(interpretation_, store_, loop_);
    for (const std::size_t iteration : iterations) {
      if (work_ > kMostWork)
        return false;
      const EventualInvariants::Found found = lasting.behind(iteration, iterations, phases_, kMostWork / 8, tried);
      work_ += found.work;
      if (found.facts.empty())
        continue;
      std::vector<std::size_t> others = iterations;
      std::erase(others, iteration);
      if (within(found, [&] { return rank(iterations); }) && rank(others))
        return true;
    }
    return false;
  }
  template <typename Rank> bool within(const EventualInvariants::Found &found, Rank &&rankIt) {
    const std::size_t before = phases_.size();
    phases_.insert(phases_.end(), found.facts.begin(), found.facts.end());
    const bool ranked = attempt(rankIt);
    phases_.erase(phases_.begin() + static_cast<std::ptrdiff_t>(before), phases_.end());
    if (ranked)
      result_.evidence.insert(result_.evidence.end(), found.evidence.begin(), found.evidence.end());
    return ranked;
  }

  /// Ranking functions of which each falls when the one before it is negative.
  bool inPhases(const std::vector<std::size_t> &iterations) {
    for (const std::size_t depth : {2u, 3u}) {
      RankingSynthesis synthesis(interpretation_, index_, store_, loop_, iterations, phases_);
      const auto nested = synthesis.nested(depth);
      work_ += synthesis.work();
      if (!nested)
        continue;
      candidates_.insert(candidates_.begin(), nested->back());
      if (rankOnceNegative(*nested, 0, iterations))
        return true;
    }
    return false;
  }
  bool rankOnceNegative(const std::vector<TermId> &nested, std::size_t at, const std::vector<std::size_t> &iterations) {
    if (at + 1 == nested.size())
      return rank(iterations);
    return rankOnceNegative(nested[at], iterations, [&] { return rankOnceNegative(nested, at + 1, iterations); });
  }
  /// Every iteration lowers it, without a bound: it is below -1 from some iteration on, and ranking assumes that.
  template <typename Rank>
  bool rankOnceNegative(TermId decreasing, const std::vector<std::size_t> &iterations, Rank &&rankIt) {
    std::vector<Outcome> evidence;
    if (!isOfState(decreasing) || !std::all_of(iterations.begin(), iterations.end(), [&](std::size_t iteration) {
          return decreases(decreaseOf(decreasing, iteration), iteration, evidence);
        }))
      return false;
    phases_.push_back(store_.less(decreasing, store_.number(Number(-1))));
    const bool ranked = attempt(rankIt);
    phases_.pop_back();
    if (ranked)
      std::move(evidence.begin(), evidence.end(), std::back_inserter(result_.evidence));
    return ranked;
  }

  /// What every iteration lowers, without a bound, is below -1 after some iterations and from then on: there the
  /// iterations are ranked again.  Phases of a loop in which a ranking function rises before it falls (Leike, Heizmann,
  /// "Ranking templates for linear loops", 2015: multiphase).
  bool afterPhase(const std::vector<std::size_t> &iterations) {
    if (phases_.size() >= kMostPhases)
      return false;
    std::vector<TermId> decreasing = decreasingRankings(iterations);
    RankingSynthesis synthesis(interpretation_, index_, store_, loop_, iterations, phases_);
    if (const auto found = synthesis.decreasing())
      decreasing.insert(decreasing.begin(), *found);
    work_ += synthesis.work();
    return std::any_of(decreasing.begin(), decreasing.end(), [&](TermId each) {
      return rankOnceNegative(each, iterations, [&] { return rank(iterations); });
    });
  }
  /// The amount by which a candidate rises may fall.
  std::vector<TermId> decreasingRankings(const std::vector<std::size_t> &iterations) {
    std::set<TermId> seen;
    for (const TermId ranking : candidates_)
      for (const std::size_t iteration : iterations) {
        const TermId rise = store_.negate(decreaseOf(ranking, iteration));
        if (!isConstant(rise) && seen.size() < kMostDecreasing)
          seen.insert(rise);
      }
    return {seen.begin(), seen.end()};
  }

  /// By a linear ranking function, if there is one.
  bool lowerByProgram(std::vector<std::size_t> &iterations) {
    if (iterations.size() > kMostDecreasing || work_ > kMostWork)
      return false;
    RankingSynthesis synthesis(interpretation_, index_, store_, loop_, iterations, phases_);
    bool lowered = false;
    for (const std::size_t iteration : iterations) {
      const auto ranking = synthesis.loweredBy(iteration);
      if (ranking && lower(iterations, {*ranking})) {
        lowered = true;
        break;
      }
    }
    work_ += synthesis.work();
    return lowered;
  }

  /// Takes away the iterations that lower a ranking function which no other iteration raises.
  bool lower(std::vector<std::size_t> &iterations, const std::vector<TermId> &candidates) {
    return std::ranges::any_of(candidates,
                               [&](TermId ranking) { return isOfState(ranking) && lower(iterations, ranking, {}); });
  }
  /// By one of which an iteration that another one follows takes an amount that depends on conditions.
  bool lowerChosen(std::vector<std::size_t> &iterations, const std::vector<TermId> &candidates) {
    return std::ranges::any_of(candidates, [&](TermId ranking) {
      return isOfState(ranking) && isChosen(ranking, iterations) && lower(iterations, ranking, iterations);
    });
  }
  /// What some iteration takes of it depends on conditions.
  bool isChosen(TermId ranking, const std::vector<std::size_t> &iterations) {
    return std::ranges::any_of(iterations, [&](std::size_t iteration) {
      const TermId exact = smt::withoutRounding(store_, decreaseOf(ranking, iteration));
      return std::ranges::any_of(smt::reachable(store_, std::array{exact}),
                                 [&](TermId part) { return store_[part].kind == TermKind::Ite; });
    });
  }
  /// Asks with what is known of the state behind the iteration because one of the followers comes next.  A run without
  /// end has no last iteration: what the last one does to a ranking function does not matter, such as a depth that is
  /// set to its limit.
  template <typename Ask> auto followed(std::size_t iteration, const std::vector<std::size_t> &followers, Ask &&ask) {
    const std::size_t before = phases_.size();
    if (!followers.empty())
      phases_.push_back(conditionsBehind(iteration, followers));
    auto answer = ask();
    phases_.resize(before, store_.yes());
    return answer;
  }
  /// `followers`: behind each iteration comes one of these; empty: or none.
  bool lower(std::vector<std::size_t> &iterations, TermId ranking, const std::vector<std::size_t> &followers) {
    std::vector<Outcome> evidence;
    RankingFunction found{.value = ranking, .isLate = !phases_.empty(), .isFollowed = !followers.empty()};
    for (const std::size_t iteration : iterations) {
      const TermId decrease = decreaseOf(ranking, iteration);
      if (isBounded(ranking, decrease, iteration, evidence) &&
          followed(iteration, followers, [&] { return decreases(decrease, iteration, evidence); })) {
        found.decrease = found.iterations.empty() ? decrease : found.decrease;
        found.iterations.push_back(iteration);
      } else if (!followed(iteration, followers,
                           [&] { return holds(iteration, store_.lessOrEqual(zero(), decrease), evidence); })) {
        return false;
      }
    }
    if (found.iterations.empty())
      return false;
    std::erase_if(iterations, [&](std::size_t iteration) {
      return std::find(found.iterations.begin(), found.iterations.end(), iteration) != found.iterations.end();
    });
    result_.rankings.push_back(std::move(found));
    std::move(evidence.begin(), evidence.end(), std::back_inserter(result_.evidence));
    return true;
  }
  /// Of the conditions of one of the followers those that speak of the state alone.
  TermId conditionsBehind(std::size_t iteration, const std::vector<std::size_t> &followers) {
    std::vector<TermId> any;
    for (const std::size_t follower : followers) {
      std::vector<TermId> all;
      for (const TermId condition : loop_.transitions[follower].conditions)
        if (isOfState(condition))
          all.push_back(smt::substitute(store_, condition, loop_.transitions[iteration].next));
      any.push_back(store_.logicalAnd(all));
    }
    return store_.logicalOr(any);
  }
  TermId decreaseOf(TermId ranking, std::size_t iteration) {
    return store_.subtract(ranking, smt::substitute(store_, ranking, loop_.transitions[iteration].next));
  }
  bool isBounded(TermId ranking, TermId decrease, std::size_t iteration, std::vector<Outcome> &evidence) {
    return mayLower(decrease) && holds(iteration, store_.lessOrEqual(zero(), ranking), evidence);
  }
  /// By an amount that no iteration changes and that is positive, or by a fixed one.
  bool decreases(TermId decrease, std::size_t iteration, std::vector<Outcome> &evidence) {
    if (!mayLower(decrease))
      return false;
    if (isConstant(decrease))
      return holds(iteration, store_.less(zero(), decrease), evidence);
    const TermId exact = smt::withoutRounding(store_, decrease);
    if (exact != decrease && isConstant(exact))
      return decreasesByHalf(exact, decrease, iteration, evidence);
    for (const TermId choice : constantChoices(exact))
      if (decreasesByHalf(choice, decrease, iteration, evidence))
        return true;
    for (const int parts : {1, 10, 1000, 1'000'000}) {
      if (holds(iteration, store_.lessOrEqual(store_.number(Number(1) / Number(parts)), decrease), evidence))
        return true;
      if (store_.sort(decrease) == smt::Sort::Int)
        return false;
    }
    return false;
  }
  /// Rounding takes less of it than half.
  bool decreasesByHalf(TermId amount, TermId decrease, std::size_t iteration, std::vector<Outcome> &evidence) {
    const TermId half = store_.scale(Number(1) / Number(2), amount);
    return holds(iteration, store_.less(zero(), amount), evidence) &&
           holds(iteration, store_.lessOrEqual(half, decrease), evidence);
  }
  /// What a number that depends on conditions is in one of the cases, where no iteration changes that.
  std::vector<TermId> constantChoices(TermId term) {
    std::vector<TermId> found;
    for (const TermId part : smt::reachable(store_, std::array{term}))
      if (store_[part].kind == TermKind::Ite && store_.sort(part) != smt::Sort::Bool)
        for (const std::size_t i : {1u, 2u}) {
          const TermId choice = smt::substitute(store_, term, {{part, store_[part].arguments[i]}});
          if (isConstant(choice) && mayLower(choice) && found.size() < kMostChoices)
            found.push_back(choice);
        }
    return found;
  }
  bool mayLower(TermId decrease) const { return !store_.isNumber(decrease) || store_[decrease].number.sign() > 0; }

  bool isConstant(TermId term) const { return loop_.isConstant(interpretation_, store_, term); }
  /// What an iteration reads anew may be another number in the next one, whatever the state is: it ranks nothing.
  bool isOfState(TermId term) const { return loop_.isOfState(interpretation_, store_, term); }
  bool holds(std::size_t iteration, TermId goal, std::vector<Outcome> &evidence) {
    if (goal == store_.yes())
      return true;
    if (work_ > kMostWork || isBroken(iteration, goal))
      return false;
    std::vector<TermId> conditions = loop_.transitions[iteration].conditions;
    conditions.insert(conditions.end(), phases_.begin(), phases_.end());
    Outcome outcome =
        discharge(store_, relevantQuery(store_, index_, interpretation_.facts(), conditions, goal), effort_);
    const bool proved = outcome.proved();
    work_ += outcome.effort;
    if (proved)
      evidence.push_back(std::move(outcome));
    else if (const smt::Model *model = outcome.counterexample()) {
      if (models_[iteration].size() == kMostModels)
        models_[iteration].erase(models_[iteration].begin());
      models_[iteration].push_back(*model);
    }
    return proved;
  }
  /// By a state before the iteration that has been met in the search.
  bool isBroken(std::size_t iteration, TermId goal) const {
    const auto is = [&](TermId formula, const smt::Model &model, bool truth) {
      const auto value = smt::evaluate(store_, formula, model);
      return value && std::get<bool>(*value) == truth;
    };
    return std::any_of(models_[iteration].begin(), models_[iteration].end(), [&](const smt::Model &model) {
      return is(goal, model, false) &&
             std::all_of(phases_.begin(), phases_.end(), [&](TermId phase) { return is(phase, model, true); });
    });
  }
  TermId zero() { return store_.number(Number(0)); }

  /// What the conditions of the iterations keep from below, the number of iterations apart.
  std::vector<TermId> candidateRankings() {
    std::set<TermId> seen;
    std::vector<TermId> all;
    const auto offer = [&](TermId ranking) {
      if (all.size() < kMostRankings && !isConstant(ranking) && seen.insert(ranking).second)
        all.push_back(ranking);
    };
    for (const TermId hint : loop_.rankingHints)
      offer(hint);
    for (const Transition &transition : loop_.transitions)
      for (const TermId condition : transition.conditions)
        offerSides(condition, offer);
    for (const TermId variable : loop_.variables)
      if (store_.sort(variable) != smt::Sort::Bool && loop_.deciding.contains(variable)) {
        offer(variable);
        offer(store_.negate(variable));
      }
    const std::vector<TermId> single = all;
    for (std::size_t i = 0; i < single.size() && i < 8; ++i)
      for (std::size_t j = i + 1; j < single.size() && j < 8; ++j)
        offer(store_.add(single[i], single[j]));
    return all;
  }
  /// Distances without their sign, and the larger of two ranking functions.
  std::vector<TermId> choices() {
    std::set<TermId> found;
    for (const Transition &transition : loop_.transitions)
      for (const TermId part : smt::reachable(store_, transition.conditions)) {
        if (const auto distance = distanceOf(part); distance && found.size() < kMostDecreasing)
          found.insert(store_.absolute(*distance));
        if (store_[part].kind == TermKind::Or || store_[part].kind == TermKind::And)
          for (const TermId ranking : largerOf(part))
            found.insert(ranking);
      }
    std::vector<TermId> numbers = loop_.variables;
    std::erase_if(numbers,
                  [&](TermId each) { return store_.sort(each) == smt::Sort::Bool || !loop_.deciding.contains(each); });
    for (const TermId each : numbers)
      found.insert(store_.absolute(each));
    for (const TermId a : numbers)
      for (const TermId b : numbers)
        if (a < b && found.size() < kMostDecreasing)
          found.insert(larger(a, b));
    return {found.begin(), found.end()};
  }
  TermId larger(TermId a, TermId b) { return store_.ite(store_.lessOrEqual(a, b), b, a); }
  /// Of how far each of the cases is from being over.
  std::vector<TermId> largerOf(TermId junction) {
    std::vector<TermId> distances;
    for (const TermId part : std::vector<TermId>(store_[junction].arguments))
      if (const auto distance = distanceOf(part)) // a conjunction is denied: what it says from below ends the loop
        distances.push_back(store_[junction].kind == TermKind::Or ? *distance : store_.negate(*distance));
    std::vector<TermId> found;
    for (std::size_t i = 0; i < distances.size() && i < 4; ++i)
      for (std::size_t j = i + 1; j < distances.size() && j < 4; ++j)
        found.push_back(larger(distances[i], distances[j]));
    return found;
  }
  /// Between the sides of a comparison; absent where no iteration changes it.
  std::optional<TermId> distanceOf(TermId compared) {
    const TermKind kind = store_[compared].kind;
    if (kind != TermKind::Less && kind != TermKind::LessOrEqual && kind != TermKind::Equal)
      return std::nullopt;
    const std::vector<TermId> sides = store_[compared].arguments;
    if (store_.sort(sides[0]) == smt::Sort::Bool)
      return std::nullopt;
    const TermId distance = store_.subtract(sides[1], sides[0]);
    return isConstant(distance) ? std::nullopt : std::optional(distance);
  }
  template <typename Offer> void offerSides(TermId condition, Offer &&offer) {
    const TermKind kind = store_[condition].kind;
    if (kind == TermKind::Not)
      return offerSides(store_[condition].arguments[0], offer);
    if (kind != TermKind::Less && kind != TermKind::LessOrEqual && kind != TermKind::Equal)
      return;
    const TermId left = store_[condition].arguments[0];
    const TermId right = store_[condition].arguments[1];
    offer(store_.subtract(right, left));
    if (kind == TermKind::Equal)
      offer(store_.subtract(left, right));
  }

  // ---- which iteration can follow which ----

  std::vector<std::vector<std::size_t>> cyclesOf(const std::vector<std::size_t> &iterations) {
    const std::size_t count = iterations.size();
    std::vector<std::vector<bool>> reaches(count, std::vector<bool>(count));
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = 0; j < count; ++j)
        reaches[i][j] = canFollow(iterations[i], iterations[j]);
    for (std::size_t k = 0; k < count; ++k)
      for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = 0; j < count; ++j)
          reaches[i][j] = reaches[i][j] || (reaches[i][k] && reaches[k][j]);
    std::vector<std::vector<std::size_t>> cycles;
    std::vector<bool> placed(count);
    for (std::size_t i = 0; i < count; ++i) {
      if (placed[i] || !reaches[i][i])
        continue; // happens once at most
      cycles.emplace_back();
      for (std::size_t j = i; j < count; ++j)
        if (!placed[j] && reaches[i][j] && reaches[j][i]) {
          placed[j] = true;
          cycles.back().push_back(iterations[j]);
        }
    }
    return cycles;
  }
  /// What is not of the loop itself is read anew in the second iteration: other variables stand for it.
  bool canFollow(std::size_t first, std::size_t second) {
    const Transition &before = loop_.transitions[first];
    smt::Substitution next = before.next;
    std::vector<TermId> conditions = before.conditions;
    conditions.insert(conditions.end(), phases_.begin(), phases_.end());
    std::vector<TermId> goals;
    for (const TermId phase : phases_)
      goals.push_back(smt::substitute(store_, phase, next));
    for (const TermId condition : loop_.transitions[second].conditions) {
      for (const TermId variable : smt::variablesOf(store_, condition))
        if (!loop_.isFixed(interpretation_, variable) && !next.contains(variable))
          next.emplace(variable, store_.variable("again " + store_[variable].name, store_.sort(variable)));
      goals.push_back(smt::substitute(store_, condition, next));
    }
    const TermId impossible = store_.logicalNot(store_.logicalAnd(goals));
    Outcome outcome = discharge(store_, relevantQuery(store_, index_, interpretation_.facts(), conditions, impossible),
                                Budget::quick());
    work_ += outcome.effort;
    if (!outcome.proved())
      return true;
    result_.evidence.push_back(std::move(outcome));
    return false;
  }

  const SymbolicInterpretation &interpretation_;
  smt::TermStore &store_;
  const LoopInstance &loop_;
  std::span<const AwaitedRead> awaited_;
  FactIndex index_;
  std::vector<TermId> candidates_;
  std::vector<TermId> phases_;                       // hold from some iteration on
  std::optional<EventualInvariants::Found> support_; // what holds before every iteration, once it was looked for
  std::vector<std::vector<smt::Model>> models_;      // by iteration: states before it
  Budget effort_ = kEffort;                          // of one question
  std::uint64_t work_ = 0;
  Termination result_;
};

std::optional<std::size_t> recurrentIterationOf(const SymbolicInterpretation &interpretation, smt::TermStore &store,
                                                const LoopInstance &loop) {
  Entailment entails(store);
  for (std::size_t i = 0; i < loop.transitions.size(); ++i) {
    const Transition &iteration = loop.transitions[i];
    const bool holdsAgain =
        std::all_of(iteration.conditions.begin(), iteration.conditions.end(), [&](TermId condition) {
          return loop.isOfState(interpretation, store, condition) &&
                 entails(interpretation.facts(), iteration.conditions,
                         smt::substitute(store, condition, iteration.next));
        });
    if (holdsAgain)
      return i;
  }
  return std::nullopt;
}

} // namespace

Termination provesEnd(const SymbolicInterpretation &interpretation, smt::TermStore &store, const LoopInstance &loop,
                      std::span<const AwaitedRead> awaited) {
  auto found = smt::within(kMostSteps, [&] { return RankingSearch(interpretation, store, loop, awaited).run(); });
  if (found)
    return std::move(*found);
  Termination given;
  given.reason =
      smt::areStepsUsedUp() ? kProgramStepsUsedUp : "gave up: the search for a ranking function takes too many steps";
  return given;
}

std::optional<std::size_t> recurrentIteration(const SymbolicInterpretation &interpretation, smt::TermStore &store,
                                              const LoopInstance &loop) {
  const auto found = smt::within(kMostSteps, [&] { return recurrentIterationOf(interpretation, store, loop); });
  return found.value_or(std::nullopt);
}

} // namespace feedhold::prove
