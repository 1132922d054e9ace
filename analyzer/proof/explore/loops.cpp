#include "proof/explore/loops.h"

#include "proof/decide/entails.h"
#include "proof/explore/explorer.h"
#include "proof/explore/loop_work.h"
#include "proof/symbolic/path_memory.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace feedhold::prove {

using smt::Number;
using smt::Sort;
using smt::TermId;
using smt::TermKind;

namespace {

/// By how much an iteration may be off, in powers of two: sums of some millimetres, .. of what is typed with 8 digits;
/// and half the least increment, for words.
constexpr std::array kErrors = {-44, -24, -10};

Number errorOf(std::size_t bound) { return Number::fromDouble(std::ldexp(1.0, kErrors[bound])); }

/// Where among the terms of the state the vacancies stand; the number of each follows it.
std::vector<std::size_t> vacanciesIn(const SymbolicState &state) {
  std::vector<std::size_t> vacancies;
  std::size_t at = 0;
  forEachPart(Overloaded{[&](PartId, const SymbolicValue &) {
                           vacancies.push_back(at);
                           at += 2;
                         },
                         [&](PartId, const auto &) { ++at; }},
              state);
  return vacancies;
}

std::vector<LoopInstance::Value> valuesOf(const SymbolicState &arrival, const SymbolicState &generic) {
  std::vector<LoopInstance::Value> values;
  for (std::uint32_t local = 1; local < arrival.locals.size(); ++local)
    values.push_back({local, arrival.locals[local].number, generic.locals[local].number});
  for (const auto &[variable, value] : arrival.variables.entries())
    if (const SymbolicValue *before = isPathMemory(variable) ? nullptr : generic.variables.find(variable))
      values.push_back({variable, value.number, before->number});
  return values;
}

} // namespace

std::vector<TermId> termsOf(const SymbolicState &state, TermId moved) {
  std::vector<TermId> terms;
  forEachTerm(state, [&](TermId term) { terms.push_back(term); });
  terms.push_back(moved);
  return terms;
}

// ---- LoopShape ----

smt::Substitution LoopShape::closedParts() const {
  smt::Substitution closed;
  for (const LoopPart &part : parts)
    if (part.kind == PartKind::Closed)
      closed.emplace(part.symbol, part.generic);
  return closed;
}

bool LoopSummarizer::isKeptBy(const LoopPart &part, TermId left, const smt::Substitution &closed,
                              const std::vector<TermId> &conditions) {
  smt::TermStore &store = explorer_.store_;
  switch (part.kind) {
  case PartKind::Kept: return isSame(part.arrival, left, conditions);
  case PartKind::Free: return isSymbolOf(part.symbol, left);
  case PartKind::Closed: {
    const TermId off = store.subtract(store.subtract(left, part.generic), part.step);
    if (!part.error)
      return off == store.number(Number(0));
    const TermId most = store.number(errorOf(part.error->bound));
    const auto holds = [&](TermId goal) {
      return explorer_.entails_(explorer_.interpretation_.facts(), conditions, goal);
    };
    return holds(store.lessOrEqual(off, most)) && holds(store.lessOrEqual(store.negate(most), off));
  }
  case PartKind::Derived: return left == smt::substitute(store, part.step, closed);
  }
  FEEDHOLD_UNREACHABLE("the switch names every kind of part");
}

/// A choice whose other cases do not come, such as a limit that the value keeps already, leaves it as it was.
bool LoopSummarizer::isSame(TermId before, TermId left, const std::vector<TermId> &conditions) {
  smt::TermStore &store = explorer_.store_;
  if (left == before)
    return true;
  const smt::Term choice = store[left];
  if (choice.kind != TermKind::Ite || (choice.arguments[1] != before && choice.arguments[2] != before))
    return false;
  const TermId leaves = choice.arguments[1] == before ? choice.arguments[0] : store.logicalNot(choice.arguments[0]);
  return explorer_.entails_(explorer_.interpretation_.facts(), conditions, leaves);
}

/// Whole numbers, and multiples of a power of two, stay such.
bool LoopSummarizer::isSymbolOf(TermId symbol, TermId left) {
  const smt::TermStore &store = explorer_.store_;
  if (store.sort(symbol) == Sort::Bool)
    return true;
  if (store.sort(symbol) == Sort::Int)
    return store.sort(left) == Sort::Int;
  Grids &grids = explorer_.interpretation_.grids();
  const auto grid = grids.of(symbol);
  return !grid || grids.of(left).value_or(*grid - 1) >= *grid;
}

/// Stands for a part that is this at the arrival, and that some iteration leaves as that.
TermId LoopSummarizer::part(TermId arrival, TermId left) {
  const smt::TermStore &store = explorer_.store_;
  const Sort sort = store.sort(arrival) == Sort::Int ? store.sort(left) : store.sort(arrival);
  const TermId symbol = explorer_.interpretation_.fresh("part", sort);
  Grids &grids = explorer_.interpretation_.grids();
  if (sort == Sort::Real)
    explorer_.store_.markAsDouble(symbol);
  if (sort == Sort::Real)
    if (const auto first = grids.of(arrival), next = grids.of(left); first && next)
      grids.set(symbol, std::min(*first, *next));
  return symbol;
}

/// After an iteration that leaves this: what the sum is off, and what it was off before.
void LoopSummarizer::addErrorsBehind(const LoopPart &part, TermId left, smt::Substitution &next) {
  smt::TermStore &store = explorer_.store_;
  const TermId added = store.subtract(store.subtract(left, part.generic), part.step);
  next.emplace(part.error->now, store.add(part.error->now, added));
  next.emplace(part.error->before, part.error->now);
}

// ---- errors ----

LoopPart::Error LoopSummarizer::newError(std::size_t bound) {
  return {explorer_.interpretation_.fresh("rounding", Sort::Real),
          explorer_.interpretation_.fresh("rounding before", Sort::Real), bound};
}

/// Of the amounts that are tried, the first that words and functions in what an iteration leaves do not exceed alone.
std::size_t LoopSummarizer::leastError(const Work &work, std::size_t part) {
  const smt::TermStore &store = explorer_.store_;
  Number least;
  for (const auto &left : work.left)
    for (const TermId id : smt::reachable(store, std::span(&left[part], 1)))
      if (const smt::Term &term = store[id];
          term.kind == TermKind::Apply && term.function == smt::Function::Near && store.isNumber(term.arguments[1]))
        least = std::max(least, store[term.arguments[1]].number);
  std::size_t index = 0;
  while (index + 1 < kErrors.size() && errorOf(index) <= least)
    ++index;
  return index;
}

// ---- trying ----

/// The state before any iteration, from the parts.
void LoopSummarizer::build(Work &work) {
  smt::TermStore &store = explorer_.store_;
  const TermId zero = store.number(Number(0));
  const TermId isFirst = store.equal(work.iterations, zero);
  for (LoopPart &part : work.parts())
    if (part.kind == PartKind::Kept)
      part.generic = part.arrival;
    else if (part.kind == PartKind::Free)
      part.generic = part.symbol;
    else if (part.kind == PartKind::Closed)
      part.generic =
          store.add(store.add(part.arrival, travelled(work, part.step)), part.error ? part.error->now : zero);
  for (LoopPart &part : work.parts()) // from the closed ones
    if (part.kind == PartKind::Derived)
      part.generic = store.ite(isFirst, part.arrival, lastIteration(work, part.step));
  work.shape.state = work.arrival.state;
  auto part = work.parts().begin();
  forEachTerm(work.shape.state, [&](TermId &mine) { mine = (part++)->generic; });
  work.moved = part->generic;
}

/// iterations * step
TermId LoopSummarizer::travelled(Work &work, TermId step) {
  smt::TermStore &store = explorer_.store_;
  if (store.isNumber(step))
    return store.multiply(work.iterations, step);
  for (const Travel &travel : work.shape.travels)
    if (travel.step == step)
      return travel.distance;
  return work.shape.travels.emplace_back(Travel{step, explorer_.interpretation_.fresh("travel", Sort::Real)}).distance;
}

/// What a distance is, and on which side of 0, if that is known of its step.
void LoopSummarizer::addTravels(Work &work) {
  smt::TermStore &store = explorer_.store_;
  const TermId zero = store.number(Number(0));
  const auto known = [&](TermId condition) {
    return explorer_.entails_(explorer_.interpretation_.facts(), work.arrival.conditions, condition);
  };
  for (const Travel &travel : work.shape.travels) {
    work.facts.push_back(store.equal(travel.distance, store.multiply(work.iterations, travel.step)));
    if (known(store.lessOrEqual(zero, travel.step)))
      work.facts.push_back(store.lessOrEqual(zero, travel.distance));
    else if (known(store.lessOrEqual(travel.step, zero)))
      work.facts.push_back(store.lessOrEqual(travel.distance, zero));
  }
}

/// Sums that are rounded are off by a little more after each iteration.
void LoopSummarizer::addErrors(Work &work) {
  smt::TermStore &store = explorer_.store_;
  const TermId one = store.number(Number(1));
  const TermId isFirst = store.less(work.iterations, one);
  for (const LoopPart &part : work.parts()) {
    if (part.kind != PartKind::Closed || !part.error)
      continue;
    const auto within = [&](TermId error, TermId iterations) {
      const TermId most = store.scale(errorOf(part.error->bound), iterations);
      return store.logicalAnd(store.lessOrEqual(store.negate(most), error), store.lessOrEqual(error, most));
    };
    work.facts.push_back(within(part.error->now, work.iterations));
    work.facts.push_back(store.logicalOr(isFirst, within(part.error->before, store.subtract(work.iterations, one))));
  }
}

/// From the iterations before now to those before an iteration that comes so much later.
smt::Substitution LoopSummarizer::atIteration(const Work &work, int later) const {
  smt::TermStore &store = explorer_.store_;
  smt::Substitution other{{work.iterations, store.add(work.iterations, store.number(Number(later)))}};
  for (const Travel &travel : work.shape.travels)
    other.emplace(travel.distance, store.add(travel.distance, store.scale(Number(later), travel.step)));
  for (const LoopPart &part : work.parts())
    if (part.kind == PartKind::Closed && part.error && later < 0)
      other.emplace(part.error->now, part.error->before);
  return other;
}

/// Over the symbols of closed parts: what it was at the last iteration.
TermId LoopSummarizer::lastIteration(const Work &work, TermId term) const {
  smt::TermStore &store = explorer_.store_;
  const smt::Substitution earlier = atIteration(work, -1);
  smt::Substitution closed;
  for (const LoopPart &part : work.parts())
    if (part.kind == PartKind::Closed)
      closed.emplace(part.symbol, smt::substitute(store, part.generic, earlier));
  return smt::substitute(store, term, closed);
}

/// Follows the iterations from the state that the parts say.
bool LoopSummarizer::tryIterations(Work &work) {
  work.isTried = false;
  build(work);
  Path start = work.arrival;
  start.state = work.shape.state;
  start.moved = work.moved;
  for (const TermId fact : work.facts)
    if (!start.assume(explorer_.store_, fact)) {
      work.found.clear();
      work.exits.clear();
      return true;
    }
  work.before = start.conditions.size();
  start.loops.push_back({start.at.node, start.frames.size(), work.instance});
  start.atOpenedHead = true;
  Explorer::Trial trial{.instance = work.instance};
  explorer_.follow(std::move(start), Explorer::Purpose::Trial, &trial);
  work.found = std::move(trial.iterations);
  work.exits = std::move(trial.exits);
  return !explorer_.result_.incomplete;
}

/// Gives the arrival the parts that an iteration has made; and takes down what the iterations leave.
bool LoopSummarizer::relayout(Work &work, bool &grew) {
  grew = false;
  SymbolicState &arrival = work.arrival.state;
  const auto size = [&] { return termsOf(arrival, work.moved).size() + arrival.havocked.size(); };
  const std::size_t before = size();
  for (Path &iteration : work.found)
    if (!alignAll(explorer_.interpretation_, arrival, iteration.state)) {
      explorer_.giveUp("a modal call starts or ends inside a loop");
      return false;
    }
  grew = size() != before;
  work.left.clear();
  for (Path &iteration : work.found) {
    alignAll(explorer_.interpretation_, arrival, iteration.state); // what a later iteration has made
    work.left.push_back(termsOf(iteration.state, iteration.moved));
  }
  work.isTried = !grew;
  return true;
}

// ---- which parts change, and how ----

bool LoopSummarizer::findChanged(Work &work) {
  work.parts().clear();
  for (int round = 0; round < kMostLoopRounds; ++round) {
    if (work.parts().empty())
      for (const TermId part : termsOf(work.arrival.state, work.arrival.moved))
        work.parts().push_back({PartKind::Kept, part, part, part, part});
    bool grew = false;
    if (!tryIterations(work) || !relayout(work, grew))
      return false;
    if (grew) {
      work.parts().clear();
      continue;
    }
    bool changed = false;
    for (std::size_t iteration = 0; iteration < work.left.size(); ++iteration) {
      const std::vector<TermId> &left = work.left[iteration];
      for (std::size_t i = 0; i < left.size(); ++i) {
        LoopPart &part = work.parts()[i];
        if (isSame(part.generic, left[i], work.found[iteration].conditions))
          continue;
        if (part.kind == PartKind::Free && isSymbolOf(part.symbol, left[i]))
          continue;
        part.kind = PartKind::Free;
        part.symbol = this->part(part.arrival, left[i]);
        changed = true;
      }
    }
    if (!changed)
      return true;
  }
  explorer_.giveUp("what a loop changes is unknown: it could not be summarised");
  return false;
}

bool LoopSummarizer::isConstant(const Work &work, TermId term) const {
  return explorer_.result_.loops[work.instance].isConstant(explorer_.interpretation_, explorer_.store_, term);
}

void LoopSummarizer::classify(Work &work) {
  smt::TermStore &store = explorer_.store_;
  if (work.left.empty())
    return;
  const auto sameInAll = [&](auto &&termOf) -> std::optional<TermId> {
    const TermId first = termOf(work.left.front());
    for (const auto &left : work.left)
      if (termOf(left) != first)
        return std::nullopt;
    return first;
  };
  smt::Substitution closed;
  for (std::size_t i = 0; i < work.parts().size(); ++i) {
    LoopPart &part = work.parts()[i];
    if (part.kind != PartKind::Free || store.sort(part.symbol) == Sort::Bool)
      continue;
    // What iterations add, but for the rounding of it.
    const auto step =
        sameInAll([&](const auto &left) { return store.subtract(smt::withoutRounding(store, left[i]), part.symbol); });
    if (step && isConstant(work, *step)) {
      part.kind = PartKind::Closed;
      part.step = *step;
      closed.emplace(part.symbol, part.symbol);
      if (std::ranges::any_of(work.left,
                              [&](const auto &left) { return smt::withoutRounding(store, left[i]) != left[i]; }))
        part.error = newError(leastError(work, i));
    }
  }
  for (std::size_t i = 0; i < work.parts().size(); ++i) {
    LoopPart &part = work.parts()[i];
    if (part.kind != PartKind::Free)
      continue;
    const auto value = sameInAll([&](const auto &left) { return left[i]; });
    if (!value)
      continue;
    const auto variables = smt::variablesOf(store, *value);
    if (std::all_of(variables.begin(), variables.end(),
                    [&](TermId variable) { return closed.contains(variable) || isConstant(work, variable); })) {
      part.kind = PartKind::Derived;
      part.step = *value;
    }
  }
}

/// What an iteration leaves is what was thought; other parts become free.
bool LoopSummarizer::verify(Work &work) {
  const smt::Substitution closed = work.shape.closedParts();
  bool holds = true;
  for (std::size_t iteration = 0; iteration < work.left.size(); ++iteration)
    for (std::size_t i = 0; i < work.parts().size(); ++i) {
      LoopPart &part = work.parts()[i];
      const TermId left = work.left[iteration][i];
      if (isKeptBy(part, left, closed, work.found[iteration].conditions))
        continue;
      holds = false;
      if (part.kind == PartKind::Closed && part.error && ++part.error->bound < kErrors.size())
        continue;
      if (part.kind == PartKind::Kept || !isSymbolOf(part.symbol, left))
        part.symbol = this->part(part.arrival, left);
      part.kind = PartKind::Free;
    }
  return holds;
}

bool LoopSummarizer::findKinds(Work &work) {
  classify(work);
  bool grew = false;
  for (int round = 0; round < kMostLoopRounds && !grew && !explorer_.result_.incomplete; ++round)
    if (tryKinds(work, grew))
      return true;
  explorer_.giveUp("what a loop changes is unknown: it could not be summarised");
  return false;
}

/// Follows the iterations with the parts of these kinds.  False: some are others now, or it was given up.
bool LoopSummarizer::tryKinds(Work &work, bool &grew) {
  smt::TermStore &store = explorer_.store_;
  // Derived parts speak of closed ones: when one of those has become free, so do they.
  for (LoopPart &part : work.parts())
    if (part.kind == PartKind::Derived)
      for (const TermId variable : smt::variablesOf(store, part.step))
        if (!isConstant(work, variable) &&
            std::none_of(work.parts().begin(), work.parts().end(), [&](const LoopPart &other) {
              return other.kind == PartKind::Closed && other.symbol == variable;
            }))
          part.kind = PartKind::Free;
  work.facts = {store.lessOrEqual(store.number(Number(0)), work.iterations)};
  if (explorer_.options_.takesFewPasses)
    work.facts.push_back(store.lessOrEqual(work.iterations, store.number(Number(kMostPasses))));
  addErrors(work);
  build(work);
  addTravels(work);
  for (const std::size_t i : vacanciesIn(work.arrival.state)) // vacant counts as 0
    if (work.parts()[i].kind == PartKind::Free || work.parts()[i + 1].kind == PartKind::Free)
      work.facts.push_back(
          store.implies(work.parts()[i].generic, store.equal(work.parts()[i + 1].generic, store.number(Number(0)))));
  return tryIterations(work) && relayout(work, grew) && !grew && verify(work);
}

// ---- LoopSummarizer ----

std::optional<LoopSummarizer::Work> LoopSummarizer::summarised(const Path &path) {
  const std::size_t instance = explorer_.result_.loops.size();
  std::vector<Place> calls;
  for (std::size_t i = 1; i < path.frames.size(); ++i)
    calls.push_back(path.frames[i].call);
  const std::size_t mark = explorer_.store_.size();
  Work work{
      .arrival = path, .instance = instance, .iterations = explorer_.interpretation_.fresh("iterations", Sort::Int)};
  explorer_.result_.loops.push_back(
      {.head = path.at, .calls = calls, .iterations = work.iterations, .mark = mark, .arrival = path.conditions});
  explorer_.shapes_.emplace_back();
  if (!startAsKnown(work) && (!findChanged(work) || !findKinds(work)))
    return std::nullopt;
  remember(work);
  addInvariants(work);
  bool grew = false;
  if (!work.isTried && (!tryIterations(work) || !relayout(work, grew) || grew)) {
    explorer_.giveUp("what a loop changes is unknown: it could not be summarised");
    return std::nullopt;
  }
  addLastIteration(work);
  return work;
}

bool LoopSummarizer::open(Path &path) {
  auto work = summarised(path);
  if (!work)
    return false;
  build(*work);
  LoopInstance &loop = explorer_.result_.loops[work->instance];
  loop.isRecorded = true;
  loop.facts = work->facts;
  if (explorer_.options_.rankingHints)
    loop.rankingHints = explorer_.options_.rankingHints(path.at, work->shape.state);
  for (const LoopPart &part : work->parts())
    if (part.kind == PartKind::Free)
      loop.variables.push_back(part.symbol);
  loop.first = atArrival(*work);
  loop.values = valuesOf(work->arrival.state, work->shape.state);
  path.state = work->shape.state;
  path.moved = work->moved;
  path.loops.push_back({path.at.node, path.frames.size(), work->instance});
  explorer_.shapes_[work->instance] = std::move(work->shape);
  return std::ranges::all_of(work->facts, [&](TermId fact) { return path.assume(explorer_.store_, fact); });
}

std::vector<Path> LoopSummarizer::tryAll(const Path &path) {
  auto work = summarised(path);
  if (!work)
    return {};
  std::erase_if(work->exits, [&](Path &exit) { return !exit.assume(explorer_.store_, work->facts.back()); });
  return std::move(work->exits);
}

bool LoopSummarizer::record(std::size_t instance, const Path &path) {
  smt::TermStore &store = explorer_.store_;
  const LoopShape &shape = explorer_.shapes_[instance];
  LoopInstance &loop = explorer_.result_.loops[instance];
  SymbolicState before = shape.state;
  SymbolicState after = path.state;
  const std::size_t ranges = before.havocked.size();
  if (!alignAll(explorer_.interpretation_, before, after) || before.havocked.size() != ranges)
    return false;
  const std::vector<TermId> left = termsOf(after, path.moved);
  if (left.size() != shape.parts.size())
    return false;
  Transition transition{path.conditions, {{loop.iterations, store.add(loop.iterations, store.number(Number(1)))}}};
  for (const Travel &travel : shape.travels)
    transition.next.emplace(travel.distance, store.add(travel.distance, travel.step));
  const smt::Substitution closed = shape.closedParts();
  for (std::size_t i = 0; i < left.size(); ++i) {
    const LoopPart &part = shape.parts[i];
    if (!isKeptBy(part, left[i], closed, path.conditions))
      return false;
    if (part.kind == PartKind::Free)
      transition.next.emplace(part.symbol, left[i]);
    else if (part.kind == PartKind::Closed && part.error)
      addErrorsBehind(part, left[i], transition.next);
  }
  loop.transitions.push_back(std::move(transition));
  return true;
}

} // namespace feedhold::prove
