#include "proof/relations/loop_states.h"

#include "proof/decide/cancel.h"
#include "proof/smt/steps.h"

#include <cmath>
#include <optional>
#include <set>

namespace feedhold::prove {

using smt::Number;

namespace {

constexpr std::size_t kMostSamples = 60;
constexpr std::size_t kMostVisits = 240; // of a loop
constexpr std::size_t kMostOfRun = 16;   // the same, in one run
constexpr std::uint64_t kFuelOfRun = 1'500;
constexpr std::uint64_t kStepsOfRunInstruction = 30;

/// What the double stands for when results have few digits: the rounding of a sum would break each equality.
std::optional<Number> plainNumber(double value) {
  constexpr double kDigits = 1e6;
  constexpr double kLargest = 9e15;
  if (std::fabs(value) > kLargest)
    return std::nullopt;
  if (value == std::floor(value))
    return Number(static_cast<std::int64_t>(value));
  if (std::fabs(value) > kLargest / kDigits)
    return std::nullopt;
  return Number(static_cast<std::int64_t>(std::llround(value * kDigits))) / Number(static_cast<int>(kDigits));
}

/// Absent: one of them is vacant or too large.
std::optional<std::vector<Number>> numbersOf(const std::vector<std::uint32_t> &variables,
                                             const MachineState<ConcreteInterpretation> &state) {
  std::vector<Number> numbers;
  for (const std::uint32_t variable : variables) {
    const ConcreteValue *value =
        variable < state.locals.size() ? &state.locals[variable] : state.variables.find(variable);
    const auto number = value && !value->vacant ? plainNumber(value->number) : std::nullopt;
    if (!number)
      return std::nullopt;
    numbers.push_back(*number);
  }
  return numbers;
}

/// Takes down the states of one run after the other.
class Watch {
public:
  Watch(const ProofContext &context, StatesOfLoops &states) : context_(context), states_(states) {}

  void run(const GivenVariables &given) {
    throwIfCancelled();
    ofRun_.clear();
    RunOptions options = context_.witnesses.runOptions(given);
    options.fuel = kFuelOfRun;
    options.trace = [this](const RunMoment &moment) { look(moment); };
    const RunResult result = feedhold::run(context_.subject.programs, context_.subject.program, options);
    smt::spend(kStepsOfRunInstruction * result.steps);
  }

private:
  void look(const RunMoment &moment) {
    const auto loop = states_.find(moment.place);
    if (loop == states_.end() || loop->second.visits.size() >= kMostVisits || ++ofRun_[moment.place] > kMostOfRun)
      return;
    auto numbers = numbersOf(loop->second.variables, moment.state);
    if (numbers && known_[moment.place].insert(*numbers).second)
      loop->second.visits.push_back(*std::move(numbers));
  }

  const ProofContext &context_;
  StatesOfLoops &states_;
  std::map<Place, std::size_t> ofRun_; // visits
  std::map<Place, std::set<std::vector<Number>>> known_;
};

} // namespace

void addStatesOfRuns(const ProofContext &context, StatesOfLoops &states) {
  Watch watch(context, states);
  for (const GivenVariables &given : context.witnesses.smallInputs())
    if (smt::stepsLeft() > 0)
      watch.run(given);
  const auto &samples = context.witnesses.samples();
  for (std::size_t i = 0; i < samples.size() && i < kMostSamples && smt::stepsLeft() > 0; ++i)
    watch.run(samples[i].given);
}

} // namespace feedhold::prove
