#include "proof/families/loop_ends.h"

#include "proof/decide/cancel.h"
#include "proof/families/awaited_reads.h"
#include "proof/termination/recurrence.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <tuple>

namespace feedhold::prove {

namespace {

/// Each input reads the same for ever, if it matters at all.
template <typename Suffices> GivenVariables withFewReadings(GivenVariables given, const Suffices &suffices) {
  const InputReadings readings = given.readings;
  for (const auto &[variable, script] : readings.entries()) {
    GivenVariables fewer = given;
    fewer.readings.erase(variable);
    if (suffices(fewer))
      given = std::move(fewer);
    else
      given.readings.set(variable, {script.front()});
  }
  return given;
}

/// The inputs without those that do not matter; halves are tried first.
template <typename Suffices> GivenVariables fewest(GivenVariables given, const Suffices &suffices) {
  for (std::size_t size = given.entries().size(); size > 0; size /= 2)
    for (std::size_t first = 0; first < given.entries().size();) {
      GivenVariables fewer;
      fewer.start = given.start;
      fewer.readings = given.readings;
      for (std::size_t i = 0; i < given.entries().size(); ++i)
        if (i < first || i >= first + size)
          fewer.set(given.entries()[i].first, given.entries()[i].second);
      if (suffices(fewer))
        given = std::move(fewer);
      else
        first += size;
    }
  return given;
}

/// The run did not come out of the loop; doubles that have grown too large come to rest in it.
bool staysIn(const ProofSubject &subject, const LoopInstance &loop, const RunResult &run) {
  return (run.end == RunEnd::Fuel || run.end == RunEnd::Repeats) &&
         endsInside(subject.programs, subject.program, loop.head, run);
}

/// What each input reads, if it stays so.
std::optional<std::map<std::uint32_t, double>> steadyReadings(const GivenVariables &given) {
  std::map<std::uint32_t, double> steady;
  for (const auto &[variable, script] : given.readings.entries()) {
    const double first = script.front();
    if (std::ranges::any_of(script, [first](double reading) { return reading != first; }))
      return std::nullopt;
    steady.emplace(variable, first);
  }
  return steady;
}

/// A word is made of signals, which no two readings may contradict for ever: only all of them 0 are taken together.
bool canStay(const ProofSubject &subject, const std::map<std::uint32_t, double> &signals) {
  const auto isWord = [&](const auto &signal) {
    const VariableRange *range = findVariable(*subject.file().dialect, signal.first);
    return range && range->role == VariableRole::SignalWord;
  };
  const auto words = std::ranges::count_if(signals, isWord);
  return words == 0 || words == std::ssize(signals) ||
         std::ranges::all_of(signals, [](const auto &signal) { return signal.second == 0; });
}

/// With these inputs the loop never ends, while signals stay as they are.
std::optional<Recurrence> goesOn(const ProofContext &context, const LoopInstance &loop, const GivenVariables &given) {
  const auto signals = steadyReadings(given);
  if (!signals)
    return std::nullopt;
  auto found = recurrenceFrom(context.start.interpretation(), context.start.store(), context.found, loop,
                              context.witnesses.modelOf(given), *signals);
  return found && canStay(context.subject, found->signals) ? found : std::nullopt;
}

/// `while #1000 reads 1, each iteration leads to another one: the loop ends only if it changes`
std::string neverEnds(const std::map<std::uint32_t, double> &signals) {
  if (signals.empty())
    return "each iteration leads to another one: the loop never ends";
  std::string names;
  for (const auto &[signal, reading] : signals)
    names += fmt::format("{}#{} reads {:.15g}", names.empty() ? "" : " and ", signal, reading);
  return fmt::format("while {}, each iteration leads to another one: the loop ends only if {} changes", names,
                     signals.size() == 1 ? "it" : "one of them");
}

/// How many inputs, and how large: with a large one the loop may only be long.
std::tuple<std::size_t, std::size_t, double> sizeOf(const GivenVariables &given) {
  double largest = 0;
  for (const auto &[variable, value] : given.entries())
    largest = std::max(largest, std::fabs(value.number));
  return {given.readings.entries().size(), given.entries().size(), largest};
}

/// Inputs of a sampled run that did not come out of the loop, with which it never ends; as few as possible.
std::optional<Witness> endless(const ProofContext &context, const LoopInstance &loop) {
  constexpr std::size_t kMostTried = 4; // the smallest and the largest in turn
  const WitnessSearch &witnesses = context.witnesses;
  std::vector<WitnessSearch::Sample> runs;
  for (const WitnessSearch::Sample &sample : witnesses.samples())
    if (steadyReadings(sample.given) && staysIn(context.subject, loop, sample.result))
      runs.push_back(sample);
  std::stable_sort(runs.begin(), runs.end(),
                   [](const auto &a, const auto &b) { return sizeOf(a.given) < sizeOf(b.given); });
  std::map<std::uint32_t, double> signals; // of the last inputs with which the loop was found to be endless
  const auto isEndless = [&](const GivenVariables &given) {
    throwIfCancelled();
    if (!witnesses.allowed(given) || !staysIn(context.subject, loop, witnesses.runOf(given)))
      return false;
    auto found = goesOn(context, loop, given);
    if (found)
      signals = std::move(found->signals);
    return found.has_value();
  };
  for (std::size_t i = 0; i < runs.size() && i < kMostTried; ++i) {
    const WitnessSearch::Sample &run = i % 2 == 0 ? runs[i / 2] : runs[runs.size() - 1 - i / 2];
    if (isEndless(run.given)) {
      GivenVariables given = fewest(withFewReadings(run.given, isEndless), isEndless);
      return Witness{std::move(given), run.result.end, neverEnds(signals)};
    }
  }
  return std::nullopt;
}

/// Inputs with which the loop is met in a state whose iteration always leads to one like it.
std::optional<Witness> endlessFromStart(const ProofContext &context, const LoopInstance &loop) {
  smt::TermStore &store = context.start.store();
  const auto iteration = recurrentIteration(context.start.interpretation(), store, loop);
  if (!iteration)
    return std::nullopt;
  std::vector<smt::TermId> conditions;
  for (const smt::TermId condition : loop.transitions[*iteration].conditions)
    conditions.push_back(smt::substitute(store, condition, loop.first));
  const Outcome outcome =
      discharge(store, context.start.onPath(conditions, store.no()), context.subject.options.budget);
  const smt::Model *model = outcome.counterexample();
  if (model == nullptr)
    return std::nullopt;
  auto witness = context.witnesses.fromModel(*model, [&](const RunResult &run) -> std::optional<std::string> {
    if (staysIn(context.subject, loop, run))
      return "each iteration leads to another one like it: the loop never ends";
    return std::nullopt;
  });
  if (witness && witness->end == RunEnd::Fuel && !goesOn(context, loop, witness->variables))
    return std::nullopt; // made plainer, it may only be long
  return witness;
}

Termination foundEnd(const ProofContext &context, const LoopInstance &loop) {
  // That an iteration is always followed by another one cannot be seen where conditions have been forgotten.
  // Nor that the program does as a contract says.
  const bool mayRecur = !context.found.forgets && !readsAwaited(context) && !context.found.reliesOnContracts();
  Termination end;
  if (mayRecur)
    end.endless = endless(context, loop);
  if (end.endless)
    return end;
  end = provesEnd(context.start.interpretation(), context.start.store(), loop, awaitedReads(context, loop));
  if (!end.proved && mayRecur)
    end.endless = endlessFromStart(context, loop);
  return end;
}

} // namespace

const Termination &endOf(const ProofContext &context, const LoopInstance &loop) {
  const auto known = context.ends.find(&loop);
  return known != context.ends.end() ? known->second
                                     : context.ends.emplace(&loop, foundEnd(context, loop)).first->second;
}

} // namespace feedhold::prove
