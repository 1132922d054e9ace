#include "proof/context/head_bounds.h"

#include "inference/absint/analysis.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

namespace feedhold::prove {

namespace {

constexpr std::uint64_t kStepsOfBounds = 300'000;    // instructions of the analysis
constexpr double kLargestExact = 9007199254740992.0; // 2^53: beyond it a bound does not make results exact

using Bounds = std::map<std::uint32_t, Interval>; // by variable; vacant counts as 0

class BoundsCollector : public AnalysisVisitor {
public:
  explicit BoundsCollector(const std::set<Place> &heads) : heads_(heads) {}

  void visit(Place place, const AbstractState &state, std::span<const Place>) override {
    if (!heads_.contains(place))
      return;
    Bounds bounds;
    for (std::uint32_t local = 1; local < state.locals.size(); ++local)
      add(local, state.locals[local], bounds);
    for (const auto &[variable, value] : state.variables.entries())
      add(variable, value, bounds);
    const auto [known, isNew] = found_.emplace(place, bounds);
    if (!isNew)
      known->second = widened(known->second, bounds);
  }

  std::map<Place, Bounds> take() { return std::move(found_); }

private:
  static void add(std::uint32_t variable, const AbstractValue &value, Bounds &into) {
    Interval number = value.mayBeNumber() ? value.number().interval() : Interval{0, 0};
    if (value.mayBeVacant())
      number = {std::min(number.lo, 0.0), std::max(number.hi, 0.0)};
    if (-kLargestExact <= number.lo || number.hi <= kLargestExact)
      into.emplace(variable, number);
  }
  /// Of the variables of which something is known at both visits.
  static Bounds widened(const Bounds &known, const Bounds &now) {
    Bounds both;
    for (const auto &[variable, bounds] : known)
      if (const auto other = now.find(variable); other != now.end())
        both.emplace(variable, Interval{std::min(bounds.lo, other->second.lo), std::max(bounds.hi, other->second.hi)});
    return both;
  }

  const std::set<Place> &heads_;
  std::map<Place, Bounds> found_;
};

void addBounds(smt::TermStore &store, const SymbolicValue &value, const Interval &bounds,
               std::vector<smt::TermId> &into) {
  const auto number = [&](double bound) { return store.number(smt::Number::fromDouble(bound)); };
  if (-kLargestExact <= bounds.lo)
    into.push_back(store.lessOrEqual(number(bounds.lo), value.number));
  if (bounds.hi <= kLargestExact)
    into.push_back(store.lessOrEqual(value.number, number(bounds.hi)));
}

} // namespace

LoopHints boundsAt(const std::set<Place> &heads, smt::TermStore &store, const ProgramSet &programs, Callee program,
                   const FileContracts *contracts) {
  Analysis analysis(programs, {.budget = kStepsOfBounds});
  BoundsCollector collector(heads);
  analysis.walk(program, analysis.entryState(program, contracts), collector);
  if (analysis.gaveUp())
    return {};
  return [&store, all = collector.take()](Place head, const SymbolicState &state) {
    std::vector<smt::TermId> conditions;
    const auto found = all.find(head);
    if (found == all.end())
      return conditions;
    for (const auto &[variable, bounds] : found->second)
      if (variable < state.locals.size())
        addBounds(store, state.locals[variable], bounds, conditions);
      else if (const SymbolicValue *value = state.variables.find(variable))
        addBounds(store, *value, bounds, conditions);
    return conditions;
  };
}

} // namespace feedhold::prove
