#include "proof/replay/example_run.h"

#include "proof/decide/discharge.h"
#include "proof/replay/witness.h"
#include "proof/space/plain_space.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace feedhold {

bool hasEnded(RunEnd end) {
  return end == RunEnd::M02 || end == RunEnd::M30 || end == RunEnd::Returned || end == RunEnd::EndOfFile;
}

namespace prove {

namespace {

constexpr std::uint64_t kFuel = 50'000;

ExampleRun started(const ProgramSet &programs, Callee program, const FileContracts &contracts,
                   const GivenVariables &given) {
  RunOptions options{.variables = given, .fuel = kFuel};
  options = startedAsSaid(programs, program, contracts, std::move(options));
  options = followedAsSaid(programs, program, &contracts, std::move(options));
  RunResult result = run(programs, program, options);
  return {std::move(options), std::move(result)};
}

/// What the contract does not speak of may be anything, and would only distract.
GivenVariables named(const Contract &contract, const GivenVariables &given) {
  GivenVariables result;
  for (const auto *values : {&contract.params, &contract.globals})
    for (const EntryValue &value : *values)
      if (const ConcreteValue *held = given.find(value.variable))
        result.set(value.variable, *held);
  return result;
}

/// How far the ends of some movements lie apart.
template <typename Belongs> double extentOf(const RunResult &run, Belongs belongs) {
  double most = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::optional<std::pair<double, double>> range;
    for (const RecordedMove &recorded : run.moves)
      if (belongs(recorded.move.kind))
        for (const auto *point : {&recorded.move.start, &recorded.move.end}) {
          const double at = (*point)[axis].number;
          range = range ? std::pair(std::min(range->first, at), std::max(range->second, at)) : std::pair(at, at);
        }
    most = range ? std::max(most, range->second - range->first) : most;
  }
  return most;
}

/// Higher for runs that come to their end, then for those that show more movements, up to what an eye can follow, and
/// whose cuts are not lost in a long way to them.
std::pair<bool, double> rankOf(const RunResult &run) {
  constexpr std::size_t kTold = 150; // movements
  const double all = extentOf(run, [](MoveKind kind) { return kind != MoveKind::Dwell; });
  const double cuts = extentOf(run, [](MoveKind kind) { return kind != MoveKind::Dwell && kind != MoveKind::Rapid; });
  const double told = static_cast<double>(run.moves.size() <= kTold ? run.moves.size() : kTold / 2);
  return {hasEnded(run.end), all > 0 ? told * (0.1 + cuts / all) : 0};
}

/// Each input in turn at a plainer place between those that were tried, where that shows more.
ExampleRun improved(ExampleRun best, const WitnessSearch &inputs,
                    const std::function<ExampleRun(GivenVariables)> &start) {
  const GivenVariables first = best.options.variables;
  for (const auto &[variable, value] : first.entries()) {
    double low = value.number, high = value.number;
    for (const WitnessSearch::Sample &sample : inputs.samples())
      if (const ConcreteValue *held = sample.given.find(variable); held && !held->vacant) {
        low = std::min(low, held->number);
        high = std::max(high, held->number);
      }
    for (const double other : {0.0, std::round((low + high) / 2), std::round((3 * low + high) / 4)}) {
      GivenVariables given = best.options.variables;
      given.set(variable, ConcreteValue::of(other + 0.0));
      if (!inputs.allowed(given))
        continue;
      if (ExampleRun each = start(std::move(given)); rankOf(each.result) > rankOf(best.result))
        best = std::move(each);
    }
  }
  return best;
}

} // namespace

std::optional<ExampleRun> exampleRun(const ProgramSet &programs, Callee program, const FileContracts &contracts) {
  const Contract *contract = contracts.of(program.program);
  if (contract == nullptr)
    return started(programs, program, contracts, {});
  smt::TermStore store;
  SymbolicInterpretation interpretation(store, *programs.file(program.file).dialect);
  SymbolicState entry = symbolicEntry(interpretation);
  ContractTerms terms(interpretation, programs, program.file, contracts);
  terms.prepare(*contract, entry);
  const std::vector<smt::TermId> demands = terms.demands(*contract, entry);
  WitnessSearch inputs(interpretation, programs, program, demands, {});
  const Outcome anyCall = discharge(store, {demands, store.no()});
  if (const smt::Model *model = anyCall.counterexample())
    inputs.sampleAround(*model);
  inputs.sampleEnds(terms.inputEnds(*contract, entry));
  const auto start = [&](const GivenVariables &given) { return started(programs, program, contracts, given); };
  std::optional<ExampleRun> best;
  for (const WitnessSearch::Sample &sample : inputs.samples())
    if (ExampleRun each = start(named(*contract, sample.given)); !best || rankOf(each.result) > rankOf(best->result))
      best = std::move(each);
  return best ? std::optional(improved(std::move(*best), inputs, start)) : std::nullopt;
}

} // namespace prove

} // namespace feedhold
