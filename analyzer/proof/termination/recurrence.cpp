#include "proof/termination/recurrence.h"

#include "meaning/cfg/wto.h"
#include "proof/decide/entails.h"
#include "proof/smt/steps.h"

#include <algorithm>
#include <set>

namespace feedhold::prove {

using smt::Model;
using smt::Number;
using smt::Sort;
using smt::TermId;
using smt::TermKind;

namespace {

constexpr std::size_t kMostIterations = 40;      // that are followed
constexpr std::size_t kMostInnerIterations = 60; // of a loop within or before
constexpr std::size_t kLateStates = 8;
constexpr std::size_t kMostNumbers = 6;
constexpr std::size_t kMostPaired = 4;
constexpr std::uint64_t kMostRecurrenceWork = 400'000;
constexpr std::size_t kMostNumberWords = 8; // of a number in a state that is followed
constexpr Budget kEffortOfRecurrence{.search = 30'000, .z3 = 0, .cvc5 = 0};

bool isPrefix(const std::vector<TermId> &prefix, const std::vector<TermId> &whole) {
  return prefix.size() <= whole.size() && std::equal(prefix.begin(), prefix.end(), whole.begin());
}

/// The interface input, which the world may hold as it is, of which the variable is a read.
std::optional<std::uint32_t> signalRead(const Dialect &dialect, const smt::Term &variable) {
  constexpr std::string_view kRead = "read of #";
  if (variable.kind != TermKind::Variable || !variable.name.starts_with(kRead))
    return std::nullopt;
  const auto number = static_cast<std::uint32_t>(std::atoi(variable.name.c_str() + kRead.size()));
  const VariableRange *range = findVariable(dialect, number);
  const bool isSignal = range && (range->role == VariableRole::Signal || range->role == VariableRole::SignalWord);
  return isSignal ? std::optional(number) : std::nullopt;
}

class RecurrenceSearch {
public:
  RecurrenceSearch(const SymbolicInterpretation &interpretation, smt::TermStore &store, const Exploration &exploration,
                   const LoopInstance &loop, const Model &inputs, const std::map<std::uint32_t, double> &signals)
      : store_(store), dialect_(interpretation.dialect()), exploration_(exploration), loop_(loop),
        facts_(interpretation.facts()), index_(store), inputs_(inputs), signals_(signals) {
    index_.add(facts_);
    for (const auto &[variable, value] : interpretation.entryValues())
      for (const TermId part : {value.number, value.vacant})
        fix(part);
    for (const LoopInstance &each : exploration.loops)
      for (const TermId fact : each.facts)
        addKnown(fact, each);
  }

  std::optional<Recurrence> run() {
    if (loop_.unmodelledCall || loop_.transitions.empty() || !collectPaths() || !follow())
      return std::nullopt;
    for (const Detail detail : {Detail::Signs, Detail::Places, Detail::Remainders}) {
      std::vector<TermId> set = candidates(detail);
      work_ = 0;
      if (!close(set) || !staysInside(set))
        continue;
      result_.facts = std::move(set);
      result_.stem = states_.size() - late_.size();
      return std::move(result_);
    }
    return std::nullopt;
  }

private:
  // ---- paths of the iterations, and of those of loops within ----

  /// False: paths have been merged, and what is a branch of which cannot be told.
  bool collectPaths() {
    const auto take = [&](const LoopInstance &loop) {
      for (const Transition &iteration : loop.transitions) {
        if (!isPrefix(loop_.arrival, iteration.conditions))
          return false;
        paths_.push_back(&iteration.conditions);
      }
      return true;
    };
    if (!take(loop_))
      return false;
    std::set<const LoopInstance *> taken{&loop_};
    for (bool grew = true; grew;) {
      grew = false;
      for (const LoopInstance &inner : exploration_.loops) {
        const auto leadsThere = [&](const std::vector<TermId> *path) {
          return inner.arrival.size() > loop_.arrival.size() && isPrefix(inner.arrival, *path);
        };
        if (taken.contains(&inner) || std::none_of(paths_.begin(), paths_.end(), leadsThere))
          continue;
        if (inner.unmodelledCall || !take(inner))
          return false;
        taken.insert(&inner);
        grew = true;
      }
    }
    for (const std::vector<TermId> *path : paths_)
      for (std::size_t i = 0; i < path->size(); ++i)
        fixSignals((*path)[i], i >= loop_.arrival.size());
    for (const LoopInstance *each : taken)
      for (const Transition &iteration : each->transitions)
        for (const auto &[variable, value] : iteration.next)
          fixSignals(value, true);
    return true;
  }

  /// The reads of signals in the term, which iterations make or the way to the loop.
  void fixSignals(TermId term, bool isOfIteration) {
    for (const TermId variable : smt::variablesOf(store_, term))
      if (const auto signal = signalRead(dialect_, store_[variable])) {
        const auto held = signals_.find(*signal);
        const double reading = held == signals_.end() ? 0 : held->second;
        if (isOfIteration)
          result_.signals.insert_or_assign(*signal, reading);
        fixed_.emplace(variable, store_.number(Number::fromDouble(reading)));
        inputs_.emplace(store_[variable].name, Number::fromDouble(reading));
      }
  }

  void fix(TermId part) {
    if (store_[part].kind != TermKind::Variable)
      return;
    const auto value = inputs_.find(store_[part].name);
    if (value == inputs_.end())
      return;
    if (store_.sort(part) == Sort::Bool)
      fixed_.emplace(part, std::get<bool>(value->second) ? store_.yes() : store_.no());
    else
      fixed_.emplace(part, store_.number(std::get<Number>(value->second)));
  }
  /// It speaks of the variables of its loop, so that no branch before that loop asks for the same.
  void addKnown(TermId fact, const LoopInstance &loop) {
    const auto variables = smt::variablesOf(store_, fact);
    if (std::any_of(variables.begin(), variables.end(), [&](TermId each) { return loop.first.contains(each); }))
      known_.insert(fact);
    if (store_[fact].kind == TermKind::And)
      for (const TermId part : std::vector<TermId>(store_[fact].arguments))
        addKnown(part, loop);
  }
  TermId withInputs(TermId term) { return smt::substitute(store_, term, fixed_); }

  // ---- the first iterations, in exact numbers ----

  bool follow() {
    Model model = inputs_;
    if (!complete(model, loop_.arrival) || !enter(model, loop_, model))
      return false;
    states_.push_back(model);
    for (iterations_ = 1; iterations_ < kMostIterations; ++iterations_) {
      const auto next = after(states_.back(), loop_);
      if (!next)
        break;
      states_.push_back(*next);
      if (isHuge(*next)) // `#1=#1*#1`: its numbers double in length with each iteration
        break;
    }
    const bool hasInner = paths_.size() > loop_.transitions.size();
    if (iterations_ < kMostIterations && !hasInner && !isHuge(states_.back()))
      return false; // it ends
    const std::size_t count = std::min(kLateStates, states_.size());
    late_.assign(states_.end() - static_cast<std::ptrdiff_t>(count), states_.end());
    return true;
  }

  static bool isHuge(const Model &state) {
    return std::any_of(state.begin(), state.end(), [](const auto &held) {
      const auto *number = std::get_if<Number>(&held.second);
      return number && number->words() > kMostNumberWords;
    });
  }

  /// Gives values to the variables of the loops that the path has met, such that all conditions hold.
  bool complete(Model &model, const std::vector<TermId> &conditions) {
    for (const LoopInstance &before : exploration_.loops) {
      if (&before == &loop_ || model.contains(store_[before.iterations].name) || !isPrefix(before.arrival, conditions))
        continue;
      Model state = model;
      if (!enter(model, before, state))
        return false;
      for (std::size_t iteration = 0; iteration < kMostInnerIterations; ++iteration) {
        Model there = state;
        if (complete(there, conditions)) {
          model = std::move(there);
          return true;
        }
        const auto next = after(state, before);
        if (!next)
          return false;
        state = *next;
      }
      return false;
    }
    return std::all_of(conditions.begin(), conditions.end(), [&](TermId condition) { return is(condition, model); });
  }
  bool is(TermId condition, const Model &model) const {
    const auto value = smt::evaluate(store_, condition, model);
    return value && std::get<bool>(*value);
  }
  /// The state at the arrival.
  bool enter(const Model &model, const LoopInstance &loop, Model &state) const {
    return assign(model, loop.first, state);
  }
  bool assign(const Model &model, const smt::Substitution &values, Model &state) const {
    Model there = state;
    for (const auto &[variable, term] : values) {
      const auto value = smt::evaluate(store_, term, model);
      if (!value)
        return false;
      there.insert_or_assign(store_[variable].name, *value);
    }
    state = std::move(there);
    return true;
  }
  std::optional<Model> after(const Model &state, const LoopInstance &loop) {
    for (const Transition &iteration : loop.transitions) {
      Model there = state;
      if (!complete(there, iteration.conditions))
        continue;
      Model next = state;
      if (assign(there, iteration.next, next))
        return next;
    }
    return std::nullopt;
  }

  // ---- the set ----

  /// What is tried: each takes more work than the one before.
  enum class Detail : std::uint8_t { Signs, Places, Remainders };
  std::vector<TermId> candidates(Detail detail) {
    std::set<TermId> all;
    for (const Transition &iteration : loop_.transitions)
      for (const TermId condition : iteration.conditions)
        all.insert(withInputs(condition));
    for (const auto &[variable, next] : loop_.transitions.front().next)
      if (store_.sort(variable) == Sort::Bool)
        all.insert({variable, store_.logicalNot(variable)});
    const std::vector<TermId> numbers = numbersOf();
    for (const TermId number : numbers) {
      addBounds(number, detail, all);
      if (detail == Detail::Remainders)
        addRemainders(number, all);
    }
    for (std::size_t i = 0; i < numbers.size() && i < kMostPaired; ++i)
      for (std::size_t j = i + 1; j < numbers.size() && j < kMostPaired; ++j) {
        addBounds(store_.subtract(numbers[i], numbers[j]), detail, all);
        addBounds(store_.add(numbers[i], numbers[j]), detail, all);
      }
    std::erase_if(all, [&](TermId candidate) {
      const auto variables = smt::variablesOf(store_, candidate);
      const smt::Substitution &next = loop_.transitions.front().next;
      return !std::all_of(variables.begin(), variables.end(), [&](TermId each) { return next.contains(each); }) ||
             !std::all_of(late_.begin(), late_.end(), [&](const Model &state) { return is(candidate, state); });
    });
    return {all.begin(), all.end()};
  }
  /// The free parts first, then how many iterations have been made, and how far they have gone.
  std::vector<TermId> numbersOf() const {
    std::vector<TermId> numbers = loop_.variables;
    for (const auto &[variable, next] : loop_.transitions.front().next)
      if (std::find(numbers.begin(), numbers.end(), variable) == numbers.end())
        numbers.push_back(variable);
    std::erase_if(numbers, [&](TermId each) { return store_.sort(each) == Sort::Bool; });
    if (numbers.size() > kMostNumbers)
      numbers.erase(numbers.begin() + kMostNumbers, numbers.end());
    return numbers;
  }
  /// By signs, and by where it is now.
  void addBounds(TermId number, Detail detail, std::set<TermId> &all) {
    for (const int bound : {0, 1}) {
      all.insert(store_.lessOrEqual(store_.number(Number(bound)), number));
      all.insert(store_.lessOrEqual(number, store_.number(Number(-bound))));
    }
    const auto value = smt::evaluate(store_, number, late_.front());
    if (detail == Detail::Signs || !value)
      return;
    const TermId now = store_.number(std::get<Number>(*value));
    all.insert({store_.lessOrEqual(now, number), store_.lessOrEqual(number, now), store_.equal(number, now)});
  }
  void addRemainders(TermId number, std::set<TermId> &all) {
    const auto value = smt::evaluate(store_, number, late_.front());
    if (!value || !std::get<Number>(*value).isInteger())
      return;
    const Number now = std::get<Number>(*value);
    for (const int modulus : {2, 3}) {
      const TermId whole = store_.floor(store_.scale(Number(1) / Number(modulus), number));
      const Number rest = now - Number(modulus) * smt::floor(now / Number(modulus));
      all.insert(store_.equal(store_.subtract(number, store_.scale(Number(modulus), whole)), store_.number(rest)));
    }
  }

  /// Houdini: drops what an iteration does not keep, until every iteration keeps all.
  bool close(std::vector<TermId> &set) {
    for (bool dropped = true; dropped;) {
      dropped = false;
      result_.evidence.clear();
      for (const Transition &iteration : loop_.transitions) {
        std::vector<TermId> conditions;
        for (const TermId condition : iteration.conditions)
          conditions.push_back(withInputs(condition));
        if (std::ranges::find(conditions, store_.no()) != conditions.end()) // not with these inputs
          continue;
        for (std::size_t i = 0; i < set.size();) {
          if (work_ > kMostRecurrenceWork)
            return false;
          std::vector<TermId> all = conditions;
          all.insert(all.end(), set.begin(), set.end());
          if (proves(all, withInputs(smt::substitute(store_, set[i], iteration.next)))) {
            ++i;
            continue;
          }
          set.erase(set.begin() + static_cast<std::ptrdiff_t>(i));
          dropped = true;
          if (broken_)
            std::erase_if(set, [&](TermId other) {
              const auto value =
                  smt::evaluate(store_, withInputs(smt::substitute(store_, other, iteration.next)), *broken_);
              return value && !std::get<bool>(*value);
            });
        }
      }
    }
    return true;
  }

  /// At each branch one of the paths goes on.
  bool staysInside(const std::vector<TermId> &set) {
    struct Node {
      std::vector<const std::vector<TermId> *> paths;
      std::size_t depth;
    };
    std::vector<Node> open{{paths_, loop_.arrival.size()}};
    std::vector<TermId> context = set;
    for (const TermId condition : loop_.arrival)
      context.push_back(withInputs(condition));
    while (!open.empty()) {
      const Node node = std::move(open.back());
      open.pop_back();
      std::map<TermId, std::vector<const std::vector<TermId> *>> next;
      for (const std::vector<TermId> *path : node.paths)
        if (path->size() > node.depth)
          next[(*path)[node.depth]].push_back(path);
      std::vector<TermId> cases;
      for (const auto &[condition, paths] : next)
        cases.push_back(withInputs(condition));
      const bool isKnown = next.empty() || (next.size() == 1 && known_.contains(next.begin()->first)); // back at a head
      if (!isKnown) {
        std::vector<TermId> all = context;
        for (std::size_t i = loop_.arrival.size(); i < node.depth; ++i)
          all.push_back(withInputs((*node.paths.front())[i]));
        if (work_ > kMostRecurrenceWork || !proves(all, store_.logicalOr(cases)))
          return false;
      }
      for (auto &[condition, paths] : next)
        if (withInputs(condition) != store_.no())
          open.push_back({std::move(paths), node.depth + 1});
    }
    return true;
  }

  bool proves(const std::vector<TermId> &conditions, TermId goal) {
    broken_.reset();
    if (goal == store_.yes())
      return true;
    Outcome outcome = discharge(store_, relevantQuery(store_, index_, facts_, conditions, goal), kEffortOfRecurrence);
    work_ += outcome.effort + 200;
    const bool proved = outcome.proved();
    if (proved)
      result_.evidence.push_back(std::move(outcome));
    else if (const Model *model = outcome.counterexample())
      broken_ = *model;
    return proved;
  }

  smt::TermStore &store_;
  const Dialect &dialect_;
  const Exploration &exploration_;
  const LoopInstance &loop_;
  const std::vector<TermId> &facts_;
  FactIndex index_;
  Model inputs_;
  const std::map<std::uint32_t, double> &signals_;
  smt::Substitution fixed_;
  std::set<TermId> known_; // facts of loops, which are no branches
  std::vector<const std::vector<TermId> *> paths_;
  std::vector<Model> states_; // before each iteration that has been followed
  std::vector<Model> late_;
  std::size_t iterations_ = 0;
  std::optional<Model> broken_; // by the last question, if its answer had values
  std::uint64_t work_ = 0;
  Recurrence result_;
};

} // namespace

std::optional<Recurrence> recurrenceFrom(const SymbolicInterpretation &interpretation, smt::TermStore &store,
                                         const Exploration &exploration, const LoopInstance &loop, const Model &inputs,
                                         const std::map<std::uint32_t, double> &signals) {
  return smt::within(3 * kStepsOfWork * kMostRecurrenceWork,
                     [&] { return RecurrenceSearch(interpretation, store, exploration, loop, inputs, signals).run(); })
      .value_or(std::nullopt);
}

bool endsInside(const ProgramSet &programs, Callee entry, Place head, const RunResult &run) {
  Callee program = entry;
  for (std::size_t depth = 0; depth <= run.calls.size(); ++depth) {
    const Place at = depth < run.calls.size() ? run.calls[depth].place : run.place;
    if (at.file == head.file && program.file == head.file) {
      const ProgramFile &file = programs.file(program.file);
      const Wto wto(file.cfg, *file.model, program.entry);
      const std::uint32_t position = wto.positionOf(at.node);
      if (wto.isHead(head.node) && wto.positionOf(head.node) <= position && position < wto.endOf(head.node))
        return true;
    }
    if (depth < run.calls.size())
      program = run.calls[depth].callee;
  }
  return false;
}

} // namespace feedhold::prove
