#include "proof/prove/example_run.h"

#include "proof/prove/discharge.h"
#include "proof/prove/plain_space.h"
#include "proof/prove/witness.h"

#include <algorithm>

namespace feedhold {

bool hasEnded(RunEnd end) {
  return end == RunEnd::M02 || end == RunEnd::M30 || end == RunEnd::Returned || end == RunEnd::EndOfFile;
}

namespace prove {

namespace {

constexpr std::uint64_t kFuel = 200'000;
constexpr std::size_t kTold = 150; // movements; a picture of more shows no more

ExampleRun started(const ProgramSet &programs, Callee program, const FileContracts &contracts,
                   const GivenVariables &given) {
  RunOptions options{.variables = given, .fuel = kFuel};
  options = startedAsSaid(programs, program, contracts, std::move(options));
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

/// Higher for runs that come to their end, then for those that show more movements, up to what an eye can follow.
std::pair<bool, std::size_t> rankOf(const RunResult &run) {
  return {hasEnded(run.end), run.moves.size() <= kTold ? run.moves.size() : kTold / 2};
}

} // namespace

std::optional<ExampleRun> exampleRun(const ProgramSet &programs, Callee program, const FileContracts &contracts) {
  const Contract *contract = contracts.of(program.program);
  if (contract == nullptr)
    return started(programs, program, contracts, {});
  smt::TermStore store;
  SymbolicReading reading(store, *programs.file(program.file).dialect);
  SymbolicState entry = symbolicEntry(reading);
  ContractTerms terms(reading, programs, program.file, contracts);
  terms.prepare(*contract, entry);
  const std::vector<smt::TermId> demands = terms.demands(*contract, entry);
  WitnessSearch inputs(reading, programs, program, demands, {});
  const Outcome anyCall = discharge(store, {demands, store.no()});
  if (const smt::Model *model = anyCall.counterexample())
    inputs.sampleAround(*model);
  inputs.sampleEnds(terms.inputEnds(*contract, entry));
  std::optional<ExampleRun> best;
  for (const WitnessSearch::Sample &sample : inputs.samples())
    if (ExampleRun each = started(programs, program, contracts, named(*contract, sample.given));
        !best || rankOf(each.result) > rankOf(best->result))
      best = std::move(each);
  return best;
}

} // namespace prove

} // namespace feedhold
