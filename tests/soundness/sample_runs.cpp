#include "soundness/sample_runs.h"

#include "inference/absint/analysis.h"
#include "inference/absint/block_states.h"
#include "soundness/containment.h"
#include "soundness/sample_start.h"

#include <fmt/format.h>
#include <map>

namespace feedhold::soundness {

namespace {

constexpr auto kAllBlocks = [](FileId, BlockId) { return true; };

/// What a reader of `ranges` is told before each block.
class ToldOfBlocks {
public:
  explicit ToldOfBlocks(const LoadedSample &sample)
      : states_(collectBlockStates(sample.set, std::array{sample.main()}, kAllBlocks)) {}

  /// Nothing is told where the analysis gave up.
  bool speaks() const { return !states_.gaveUp && !states_.isCutShort; }
  std::vector<AbstractState> of(BlockId block) const {
    std::vector<AbstractState> told;
    for (const ContextStates &context : states_.contexts)
      if (const auto found = context.blocks.find(block); found != context.blocks.end())
        told.push_back(found->second.state());
    return told;
  }

private:
  BlockStates states_;
};

/// A sequence number whose block has no node that stands for it: nothing is told there, or the state of a jump alone.
std::optional<std::string> numberWithoutNode(const LoadedSample &sample) {
  const Cfg &cfg = sample.set.file(FileId(0)).cfg;
  for (const SequenceNumber &number : sample.model().sequenceNumbers)
    if (const NodeId node = cfg.nodeOf(number.block);
        cfg.nodes[node].block != number.block || std::holds_alternative<JumpIntoLoop>(cfg.nodes[node].instruction))
      return fmt::format("N{} has no node of its own", number.number);
  return std::nullopt;
}

/// All that the analysis tells.
class Foreseen : public AnalysisVisitor {
public:
  void visit(Place place, const AbstractState &state, std::span<const Place>) override {
    states[place].push_back(state);
  }
  void alarm(Truth truth, const AlarmReport &report) override {
    if (mayBeTrue(truth))
      alarms.push_back(report);
  }
  void userAlarm(const AbstractValue &, Span place) override { userAlarms.push_back(place); }

  bool hasAlarm(AlarmKind kind, Span place) const {
    return std::any_of(alarms.begin(), alarms.end(), [&](const AlarmReport &report) {
      return report.kind == kind && (report.place.empty() || report.place == place);
    });
  }

  std::map<Place, std::vector<AbstractState>> states;
  std::vector<AlarmReport> alarms;
  std::vector<Span> userAlarms;
};

class OneRun {
public:
  OneRun(const LoadedSample &machine, const LoadedSample &analysed, const Foreseen &foreseen, const ToldOfBlocks &told,
         Random &random)
      : machine_(machine), analysed_(analysed), foreseen_(foreseen), told_(told), modes_(machine.dialect()),
        entry_(randomEntryIn(numbersOfMachine(analysed.dialect(), random), machine, random)),
        skip_(random.oneIn(2) ? BlockSkipSwitch::On : BlockSkipSwitch::Off) {}

  std::optional<std::string> run(Tally &tally) {
    RunOptions options;
    options.variables = entry_.given;
    options.state = entry_.state;
    options.fuel = 250;
    options.blockSkip = skip_;
    options.numbers = entry_.numbers;
    options.trace = [this](const RunMoment &moment) { look(moment); };
    const RunResult result = feedhold::run(machine_.set, machine_.main(), options);
    ++tally.runs;
    tally.steps += steps_;
    overflown_ = overflown_ || (entry_.numbers == NumberModel::Mantissa32 && result.end == RunEnd::Alarm &&
                                result.alarm == AlarmKind::Overflow); // of results: docs/soundness-motion.md
    tally.overflown += overflown_ ? 1 : 0;
    if (!why_ && !overflown_ && !overflows(result.state))
      ending(result);
    return std::move(why_);
  }

private:
  void look(const RunMoment &moment) {
    if (why_ || overflown_)
      return;
    ++steps_;
    overflown_ = overflows(moment.state);
    if (overflown_ || (steps_ > 60 && steps_ % 4 != 0))
      return;
    const auto found = foreseen_.states.find(moment.place);
    if (found == foreseen_.states.end()) {
      why_ = "a place that is not reached: " + machine_.blockOf(moment.place);
      return;
    }
    requireSome(found->second, moment, "");
    const Cfg &cfg = machine_.set.file(moment.place.file).cfg;
    const BlockId block = cfg.nodes[moment.place.node].block;
    if (!why_ && told_.speaks() && cfg.nodeOf(block) == moment.place.node)
      requireSome(told_.of(block), moment, "told of the block: ");
  }
  void requireSome(const std::vector<AbstractState> &states, const RunMoment &moment, std::string_view source) {
    std::string reasons;
    for (const AbstractState &state : states) {
      const auto why = whyOutside(moment.state, state, entry_, modes_, analysed_.dialect());
      if (!why)
        return;
      reasons += "\n    " + *why;
    }
    why_ = fmt::format("{}before {}, step {}:{}", source, machine_.blockOf(moment.place), steps_, reasons);
  }
  void ending(const RunResult &result) {
    if (result.end == RunEnd::Alarm && !foreseen_.hasAlarm(result.alarm, result.alarmSpan))
      why_ = fmt::format("alarm {} at {}", static_cast<int>(result.alarm), machine_.blockOf(result.place));
    if (result.end == RunEnd::UserAlarm && std::find(foreseen_.userAlarms.begin(), foreseen_.userAlarms.end(),
                                                     result.alarmSpan) == foreseen_.userAlarms.end())
      why_ = "an alarm of the program at " + machine_.blockOf(result.place);
  }

  const LoadedSample &machine_;
  const LoadedSample &analysed_;
  const Foreseen &foreseen_;
  const ToldOfBlocks &told_;
  ModalTable modes_;
  EntryValues entry_;
  BlockSkipSwitch skip_;
  std::uint64_t steps_ = 0;
  bool overflown_ = false;
  std::optional<std::string> why_;
};

} // namespace

std::optional<std::string> unforeseen(const Sample &sample, std::uint64_t inputSeed, int runs, Tally &tally) {
  Random random(inputSeed);
  const LoadedSample analysed(sample.lines, controlOf(sample));
  const LoadedSample machine(sample.lines, machineOf(sample, random));
  if (analysed.isEmpty())
    return std::nullopt;
  if (auto why = numberWithoutNode(analysed))
    return why;
  Foreseen foreseen;
  AnalysisOptions options;
  options.budget = 200'000;
  Analysis analysis(analysed.set, options);
  analysis.walk(analysed.main(), foreseen);
  if (analysis.gaveUp()) {
    tally.abandoned += static_cast<std::uint64_t>(runs);
    return std::nullopt;
  }
  const ToldOfBlocks told(analysed);
  for (int i = 0; i < runs; ++i)
    if (auto why = OneRun(machine, analysed, foreseen, told, random).run(tally))
      return fmt::format("run {}: {}", i, *why);
  return std::nullopt;
}

Sample shrunk(Sample sample, std::uint64_t inputSeed, int runs) {
  bool smaller = true;
  while (smaller) {
    smaller = false;
    for (std::size_t count = sample.lines.size() / 2; count > 0; count /= 2)
      for (std::size_t at = 0; at + count <= sample.lines.size();) {
        Sample fewer = sample;
        const auto first = fewer.lines.begin() + static_cast<std::ptrdiff_t>(at);
        fewer.lines.erase(first, first + static_cast<std::ptrdiff_t>(count));
        Tally tally;
        if (!fewer.lines.empty() && unforeseen(fewer, inputSeed, runs, tally)) {
          sample = std::move(fewer);
          smaller = true;
        } else {
          ++at;
        }
      }
  }
  return sample;
}

} // namespace feedhold::soundness
