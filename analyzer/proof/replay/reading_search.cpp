// The part of WitnessSearch that chooses what the signals of the control give, answer by answer.
//
// Where a run asks for a signal, both answers are tried, each in a run of its own that goes on with 0 (P. Godefroid, N.
// Klarlund, K. Sen, "DART", PLDI 2005, with answers in place of branches).  Scripts with few 1s come first, so that the
// first run to a new end is a plain one.  A signal that always reads 1 shows a loop that waits for 0.
#include "proof/decide/cancel.h"
#include "proof/replay/witness.h"
#include "proof/smt/steps.h"

#include <algorithm>
#include <deque>
#include <map>
#include <set>

namespace feedhold::prove {

namespace {

constexpr std::size_t kMostStarts = 48; // samples from which the search starts
constexpr int kMostRuns = 400;
constexpr int kIdleRuns = 150; // that end as others before the search stops
constexpr std::size_t kMostAnswers = 12;

struct Script {
  std::size_t sample; // whose other inputs the run has
  std::vector<double> answers;
  double afterwards = 0;
};

} // namespace

std::set<std::uint32_t> WitnessSearch::signalsRead() const {
  std::set<std::uint32_t> signals;
  for (const std::uint32_t variable : inputsRead())
    if (const VariableRange *range = findVariable(*programs_.file(entry_.file).dialect, variable);
        range && range->role == VariableRole::Signal)
      signals.insert(variable);
  return signals;
}

/// The run that gets these answers from the signals, and then always the same; its inputs name what it read, as far as
/// a witness has room for it.
WitnessSearch::AnsweredRun WitnessSearch::runWithAnswers(const GivenVariables &given,
                                                         const std::set<std::uint32_t> &signals,
                                                         std::span<const double> answers, double afterwards) const {
  AnsweredRun run{{given, {}}, 0};
  std::map<std::uint32_t, std::vector<double>> scripts;
  RunOptions options = runOptions(given);
  options.fuel = kSampleFuel;
  options.inputs = [&](Place, std::uint32_t variable) {
    if (!signals.contains(variable))
      return 0.0;
    const double answer = run.reads < answers.size() ? answers[run.reads] : afterwards;
    if (std::vector<double> &script = scripts[variable]; script.size() < kLongestScript)
      script.push_back(answer);
    ++run.reads;
    return answer;
  };
  run.sample.result = feedhold::run(programs_, entry_, options);
  for (auto &[variable, script] : scripts)
    run.sample.given.readings.set(variable, std::move(script));
  return run;
}

void WitnessSearch::sampleSignals() {
  const std::set<std::uint32_t> signals = signalsRead();
  if (signals.empty())
    return;
  std::set<EndOfRun> ends;
  for (const Sample &sample : samples_)
    ends.insert(endOf(sample.result));
  std::deque<Script> open;
  for (std::size_t i = 0; i < samples_.size() && open.size() < kMostStarts; ++i)
    if (samples_[i].given.readings.entries().empty())
      open.insert(open.end(), {Script{i, {}, 0}, Script{i, {}, 1}});
  int idle = 0;
  for (int runs = 0; runs < kMostRuns && idle < kIdleRuns && !open.empty() && !smt::areStepsUsedUp(); ++runs, ++idle) {
    throwIfCancelled();
    const Script next = std::move(open.front());
    open.pop_front();
    AnsweredRun found = runWithAnswers(samples_[next.sample].given, signals, next.answers, next.afterwards);
    smt::spend(kStepsOfInstruction * found.sample.result.steps);
    const std::size_t end = next.afterwards == 0 ? std::min(found.reads, kMostAnswers) : 0;
    for (std::size_t read = next.answers.size(); read < end; ++read) {
      Script other = next;
      other.answers.resize(read, 0);
      other.answers.push_back(1);
      open.push_back(std::move(other));
    }
    if (!ends.contains(endOf(found.sample.result)) && allowed(found.sample.given)) {
      keepRun(std::move(found.sample.given)); // as a witness would be run
      ends.insert(endOf(samples_.back().result));
      idle = 0;
    }
  }
}

} // namespace feedhold::prove
