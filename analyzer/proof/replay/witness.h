// Witnesses: inputs with which a run of the concrete machine violates a claim.
#pragma once

#include "proof/geometry/gouge.h"
#include "proof/obligation/obligation.h"
#include "proof/replay/exact_run.h"
#include "proof/replay/likely_calls.h"
#include "proof/replay/start_inputs.h"
#include "proof/symbolic/contract_terms.h"
#include "proof/symbolic/symbolic_interpretation.h"

#include <functional>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <type_traits>
#include <vector>

namespace feedhold::prove {

/// Of claims that one clause makes of each block: all blocks of which a run breaks the claim, found in one look.
struct BlockClaims {
  std::pair<ObligationKind, ClauseId> clause;
  std::function<std::vector<Place>(const RunResult &, const GivenVariables &)> brokenIn;
};

/// Whether a run breaks a claim.
struct Violation {
  using Happened = std::function<std::optional<std::string>(const RunResult &, const GivenVariables &)>;

  template <typename Says>
  Violation(Says says, std::function<bool(const GivenVariables &)> exactly = {}) : breaksExactly(std::move(exactly)) {
    if constexpr (std::is_invocable_v<Says, const RunResult &>)
      happened = [says = std::move(says)](const RunResult &run, const GivenVariables &) { return says(run); };
    else
      happened = std::move(says);
  }

  /// Says what happened in the run on these inputs if it may break the claim.
  Happened happened;
  /// Where the run alone does not tell: whether it does, in exact numbers.
  std::function<bool(const GivenVariables &)> breaksExactly;
  /// The claim is one of these, and of which block: then nothing happened in the other runs.
  struct OfBlock {
    BlockClaims claims;
    Place own;
  };
  std::optional<OfBlock> ofBlock = {};
};

/// The radii that a model has for offsets: by number of D.
using OffsetsOfModel = std::function<std::vector<std::pair<double, double>>(const smt::Model &)>;

class WitnessSearch {
public:
  /// `demands`: what the inputs have to satisfy.
  WitnessSearch(SymbolicInterpretation &interpretation, const ProgramSet &programs, Callee entry,
                std::vector<smt::TermId> demands, std::vector<double> constants);

  /// The codes in which runs start, if not those of power-on, and the place: terms over the inputs; an axis without
  /// one starts at 0.  `open`: what else a witness may say of the start.
  /// What a model says of offsets of D.
  void readOffsets(OffsetsOfModel offsets) { offsets_ = std::move(offsets); }
  void startFrom(RunOptions start, std::map<Axis, smt::TermId> place, StartInputs open) {
    start_ = std::move(start);
    place_ = std::move(place);
    open_ = std::move(open);
    spaces_.clear();
    breaking_.clear();
  }
  /// Exact runs, if they are not those of the program without a contract.
  void followExactly(ExactRuns::Explore explore) { exactRuns_ = std::make_shared<ExactRuns>(std::move(explore)); }
  /// Missing programs of which contracts say what they do: a run that passes over one of them shows what another
  /// program does, which changes nothing.
  void notThrough(std::set<std::string> programs) { promised_ = std::move(programs); }
  bool passesPromised(const RunResult &run) const;
  RunOptions runOptions(const GivenVariables &given) const;
  /// The regions of the contract as numbers, in a run on these inputs: from make(runOptions(given)) for the first claim
  /// that asks.
  const geometry::PlainSpace &spaceOf(const GivenVariables &given,
                                      const std::function<geometry::PlainSpace(const RunOptions &)> &make) const;
  RunResult runOf(const GivenVariables &given, WordRounding words = RunOptions().words) const;
  /// Runs on likely calls, then on plain numbers, before anything is known: each run and its inputs are kept.
  void sample();
  /// The same inputs as some of these runs, from starts in other modes.
  void sampleOtherModes();
  /// Where plain numbers seldom satisfy what they have to: the same, around inputs that do.  A model that names some
  /// inputs is completed by these.
  void sampleAround(const smt::Model &allowed);
  /// At the ends of what the inputs may be, and midway: where claims break first.
  void sampleEnds(const std::vector<InputEnds> &ends);
  /// Some of the runs so far, with offsets of D at the upper ends of their ranges: without a number they are at the
  /// lower ones.
  void sampleOffsetEnds(const std::vector<OffsetEnd> &ends);
  /// On numbers with a few digits behind the point, which the control rounds; between the ends where these are known.
  void sampleDecimals(const std::vector<InputEnds> &ends);
  /// Variants of the runs so far, each kept if it ends at another place or in another way: programs that check what
  /// they are given let few other runs through.
  void sampleVariants();
  /// Some of these runs with skip moves, whose signals come on the way.
  void sampleSkips();
  /// Some of these runs, with other answers where they read signals: each is kept if it ends in a new way.
  void sampleSignals();
  /// Inputs that are allowed, of small whole numbers: runs on them show how loops go on.
  std::vector<GivenVariables> smallInputs() const;
  /// Among the sampled runs, the one nearest to a call that a shop makes.
  std::optional<Witness> amongSamples(const Violation &violation) const;
  /// The sampled runs that may break the claim, in their order: all but those in which nothing happened.
  std::vector<std::size_t> mayBreak(const Violation &violation) const;
  /// Among those of sampleDecimals(), of which more are followed exactly than amongSamples() does.
  std::optional<Witness> amongDecimals(const Violation &violation) const;
  /// The inputs that a model of the solver names, then made as plain as they can be, and as near to a likely call.
  std::optional<Witness> fromModel(const smt::Model &model, const Violation &violation,
                                   std::uint64_t fuel = kFuel) const;
  /// Of a model that is no witness: what the machine does on its inputs instead.
  std::string whyNotShown(const smt::Model &model) const;

  struct Sample {
    GivenVariables given;
    RunResult result;
  };
  const std::vector<Sample> &samples() const { return samples_; }
  /// Runs on counterexamples, of narrowed searches too.
  const std::vector<Sample> &replays() const { return *replays_; }
  /// The run, if it breaks the claim on inputs that are allowed, and not by the rounding of the machine alone.
  std::optional<Witness> shown(const Sample &run, const Violation &violation) const;
  /// The run, if it breaks the claim on inputs that are allowed, and a run in exact numbers ends otherwise.
  std::optional<Witness> shownByRounding(const Sample &run, const Violation &violation) const;
  /// The inputs in exact numbers.
  smt::Model modelOf(const GivenVariables &given) const;
  /// They satisfy what the inputs have to.
  bool allowed(const GivenVariables &given) const;
  /// Whether the run ends so in exact numbers, too.
  Agreement agreesExactly(const GivenVariables &given, const RunResult &run) const {
    return exactRuns_->agrees(given, run);
  }
  /// With one more condition on the inputs, and those of the samples that satisfy it.  `inputs`: modelOf each sample;
  /// empty: without samples.
  WitnessSearch narrowed(smt::TermId demand, const std::vector<smt::Model> &inputs) const;

  static constexpr std::uint64_t kFuel = 20'000;

private:
  static constexpr std::uint64_t kSampleFuel = 4'000;
  static constexpr std::uint64_t kStepsOfInstruction = 30;
  static constexpr std::size_t kLongestScript = 64; // of one input that a witness names

  std::vector<std::uint32_t> inputs() const;
  std::vector<std::uint32_t> variables() const;
  std::vector<double> plainNumbers() const;
  void addStartReads(GivenVariables &given, const smt::Model &model) const;
  GivenVariables inputsOf(const smt::Model &model) const;
  static GivenVariables variantOf(GivenVariables given, const std::vector<std::uint32_t> &names,
                                  const std::vector<double> &pool, std::mt19937 &random);
  std::set<std::uint32_t> inputsRead() const;
  /// The cells of the cutter offsets that the program names by D.
  std::vector<std::uint32_t> offsetsNamed() const;
  void sampleOffsets();
  std::optional<std::uint32_t> offsetCell(double number) const;
  ConcreteValue inRegister(double radius) const;
  void addOffsets(GivenVariables &given, const smt::Model &model) const;
  /// What the machine, or a program that is not in the files, gives it is bound by nothing.
  bool readsAnything(std::uint32_t variable) const;
  std::set<std::uint32_t> signalsRead() const;
  struct AnsweredRun {
    Sample sample;
    std::size_t reads; // of signals
  };
  AnsweredRun runWithAnswers(const GivenVariables &given, const std::set<std::uint32_t> &signals,
                             std::span<const double> answers, double afterwards) const;
  InputReadings readingsOf(const smt::Model &model, const GivenVariables &given) const;
  /// A run that passes over what may change anything shows nothing: it is one of many.
  std::optional<std::string> broken(const Sample &run, const Violation &violation) const;
  smt::Number numberOf(std::uint32_t variable, double held) const;
  bool canBeTyped(std::uint32_t variable, const smt::Number &number, smt::TermId input) const;
  bool isAllowed(const GivenVariables &given) const;
  void addReadings(GivenVariables &given, std::mt19937 &random, std::size_t most) const;
  void keepSample(GivenVariables given);
  void keepRun(GivenVariables given);
  using EndOfRun = std::tuple<Place, RunEnd, decltype(RunResult::alarm)>;
  static EndOfRun endOf(const RunResult &run) { return {run.place, run.end, run.alarm}; }
  /// Absent: there is none, or none that is a number.
  std::optional<double> endIn(const GivenVariables &given, const std::optional<smt::TermId> &end) const;
  bool isExact(const GivenVariables &given, const RunResult &run) const;
  bool isExact(const GivenVariables &given, const RunResult &run, const Violation &violation) const;
  std::optional<Witness> tried(const GivenVariables &given, const Violation &violation, std::uint64_t fuel) const;
  GivenVariables readBy(const GivenVariables &call) const;
  std::vector<GivenVariables> nearer(const GivenVariables &given, std::uint32_t variable) const;
  Witness plainest(Witness witness, const Violation &violation, std::uint64_t fuel) const;
  Witness withPlainStart(Witness witness, const Violation &violation, std::uint64_t fuel) const;
  Witness withPlainReadings(Witness witness, const Violation &violation, std::uint64_t fuel) const;

  SymbolicInterpretation &interpretation_;
  const ProgramSet &programs_;
  Callee entry_;
  std::vector<smt::TermId> demands_;
  std::vector<double> constants_; // that the program and its contract write
  RunOptions start_;
  OffsetsOfModel offsets_ = nullptr;
  std::map<Axis, smt::TermId> place_;
  StartInputs open_;
  std::vector<Sample> samples_;
  std::mt19937 readings_{1};             // of samples
  std::size_t firstPlain_ = 0;           // of samples_: behind the likely calls
  std::size_t firstDecimal_ = 0;         // the same
  std::shared_ptr<ExactRuns> exactRuns_; // shared by narrowed searches
  std::shared_ptr<const LikelyCalls> likely_;
  std::shared_ptr<std::vector<Sample>> replays_ = std::make_shared<std::vector<Sample>>(); // the same
  mutable std::map<std::pair<std::uint32_t, smt::Number>, bool> canBeTyped_;
  mutable std::map<InputsKey, geometry::PlainSpace> spaces_;
  /// Of the clauses that were asked for: by block, the samples that break the claim.
  using BreakingSamples = std::map<Place, std::vector<std::size_t>>;
  mutable std::map<std::pair<ObligationKind, ClauseId>, BreakingSamples> breaking_;
  smt::Model others_; // inputs that satisfy what they have to
  std::set<std::string> promised_;
};

} // namespace feedhold::prove
