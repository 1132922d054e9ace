#include "proof/space/space_proofs.h"

#include "proof/contract_run.h"
#include "proof/space/plain_space.h"
#include "proof/space/space_clauses.h"
#include "proof/space/space_points.h"
#include "proof/space/turning_samples.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <set>

namespace feedhold::proof_tests {

using geometry::PlainSpace;
using geometry::SpaceClaim;
using prove::Obligation;
using prove::ObligationKind;
using prove::Verdict;
using soundness::EntryValues;
using soundness::LoadedSample;
using soundness::Random;
using soundness::Sample;

namespace {

constexpr double kRounding = 1e-6;       // of doubles; less is no gouge
constexpr double kMarginRounding = 2e-5; // of what is searched on a way

struct Clause {
  ObligationKind kind;
  SpaceClaim claim;
  std::size_t region;
  std::string name; // of the region
};

/// A run, and what its contract says of space then.
struct SpaceRun {
  GivenVariables given;
  RunResult result;
  PlainSpace space;
};

class MillingSample {
public:
  explicit MillingSample(const Sample &sample) : MillingSample(sample, soundness::controlOf(sample)) {}
  /// On a machine whose parameters are known.
  MillingSample(const Sample &sample, const Dialect &dialect)
      : loaded_(sample.lines, dialect),
        contracts_(readContracts(loaded_.source(), loaded_.tree(), loaded_.model(), loaded_.dialect())),
        promises_(loaded_, contracts_, contract()) {}

  bool isRead() const { return !loaded_.isEmpty() && contract() && contract()->isSound; }
  const LoadedSample &loaded() const { return loaded_; }
  const FileContracts &contracts() const { return contracts_; }
  const Contract *contract() const { return loaded_.isEmpty() ? nullptr : contracts_.of(loaded_.main().program); }

  /// Arguments that the contract allows.
  std::optional<SpaceRun> run(Random &random) const {
    constexpr int kTries = 200;
    RunOptions options;
    for (double &axis : options.start)
      axis = static_cast<double>(random.below(200)) / 4 - 25;
    if (random.oneIn(2)) // offsets of the machine, of which nothing depends
      for (const std::uint32_t cell : {5201, 5221, 5222, 5223, 5241, 5243, 2001})
        options.variables.set(cell, ConcreteValue::of(static_cast<double>(random.below(80)) / 8 - 5));
    const GivenVariables cells = options.variables;
    for (int i = 0; i < kTries; ++i) {
      EntryValues entry = entryOf(cells, options.start);
      promises_.draw(entry, random);
      promises_.draw(entry, random); // once more: a range may name an argument that comes later
      if (!promises_.allows(entry))
        continue;
      options.variables = entry.given;
      options.codes = anyCodes(random);
      return run(std::move(options));
    }
    return std::nullopt;
  }
  bool allows(const GivenVariables &given) const { return promises_.allows(entryOf(given, {})); }
  SpaceRun run(const GivenVariables &given) const {
    RunOptions options;
    options.variables = given;
    return run(std::move(options));
  }
  PlainSpace spaceOf(const GivenVariables &given) const {
    RunOptions options;
    options.variables = given;
    return prove::plainSpace(loaded_.set, loaded_.main(), contracts_,
                             prove::startedAsSaid(loaded_.set, loaded_.main(), contracts_, std::move(options)));
  }

private:
  EntryValues entryOf(const GivenVariables &given, const std::array<double, kAxisCount> &start) const {
    const ModalTable modes(loaded_.dialect());
    EntryValues entry{startState(ConcreteInterpretation(loaded_.dialect(), given), modes, start), given};
    promises_.prepare(entry);
    return entry;
  }
  /// Of the groups that the programs of space may leave open; what the contract names comes behind them.
  std::vector<std::pair<std::uint8_t, std::uint8_t>> anyCodes(Random &random) const {
    const ModalTable modes(loaded_.dialect());
    std::vector<std::pair<std::uint8_t, std::uint8_t>> codes;
    for (const std::initializer_list<int> group :
         {std::initializer_list<int>{0, 10, 20, 30}, {170, 180, 190}, {540, 550, 590}, {980, 990}, {900, 910}})
      if (const Code *code = findGCode(loaded_.dialect(), static_cast<std::uint16_t>(random.of(group))))
        if (const auto index = modes.indexOf(*code))
          codes.emplace_back(code->group, *index);
    return codes;
  }
  SpaceRun run(RunOptions options) const {
    options.fuel = 5'000;
    options.mostMoves = 400;
    options.words = WordRounding::None;
    SpaceRun run{options.variables, {}, {}};
    options = prove::startedAsSaid(loaded_.set, loaded_.main(), contracts_, std::move(options));
    options = prove::followedAsSaid(loaded_.set, loaded_.main(), &contracts_, std::move(options));
    run.result = feedhold::run(loaded_.set, loaded_.main(), options);
    run.space = prove::plainSpace(loaded_.set, loaded_.main(), contracts_, options);
    return run;
  }

  LoadedSample loaded_;
  FileContracts contracts_;
  ContractOnRun promises_;
};

std::vector<Clause> clausesOf(const PlainSpace &space) {
  std::vector<Clause> clauses;
  for (std::size_t i = 0; i < space.keepIn.size(); ++i)
    clauses.push_back({ObligationKind::KeepIn, SpaceClaim::KeepIn, i, space.keepIn[i].name});
  for (std::size_t i = 0; i < space.keepOut.size(); ++i)
    clauses.push_back({ObligationKind::KeepOut, SpaceClaim::KeepOut, i, space.keepOut[i].name});
  if (space.clearance)
    clauses.push_back({ObligationKind::Clearance, SpaceClaim::Clearance, 0, ""});
  if (space.travel)
    clauses.push_back({ObligationKind::Travel, SpaceClaim::Travel, 0, ""});
  return clauses;
}

/// Depths are known, and not only looked for at some points.
bool hasFormulas(const PlainSpace &space, const Clause &clause) {
  if (clause.claim != SpaceClaim::KeepIn && clause.claim != SpaceClaim::KeepOut)
    return true;
  const auto &region = (clause.claim == SpaceClaim::KeepIn ? space.keepIn : space.keepOut)[clause.region];
  return region.parts.size() == 1 &&
         std::none_of(region.parts.begin(), region.parts.end(), [](const geometry::PlainShape &part) {
           return std::holds_alternative<geometry::Condition<double, bool>>(part);
         });
}

bool isOf(const Obligation &obligation, const Clause &clause) {
  return obligation.kind == clause.kind &&
         (clause.name.empty() || obligation.id.find("." + clause.name + ".") != std::string::npos);
}

double deepest(const SpaceRun &run, const Clause &clause, const geometry::MoveFilter &filter = {}) {
  const auto gouge = geometry::deepestGouge(run.space, clause.claim, clause.region, run.result.moves, filter);
  return gouge ? gouge->depth : 0;
}

std::string argumentsOf(const GivenVariables &given) {
  std::string text;
  for (const auto &[variable, value] : given.entries())
    text += fmt::format(" #{}={}", variable, value.number);
  return text;
}

class Judge {
public:
  /// Proofs are of any machine, runs of one.
  Judge(const MillingSample &sample, const MillingSample &machine, std::uint64_t seed, const prove::Budget &budget)
      : sample_(sample), machine_(machine), random_(seed) {
    prove::ProveOptions options;
    options.budget = budget;
    options.guards = prove::InferGuards::No;
    options.only = {ObligationKind::KeepIn, ObligationKind::KeepOut, ObligationKind::Clearance, ObligationKind::Travel};
    proof_ = prove::prove(sample.loaded().set, sample.loaded().main(), &sample.contracts(), options);
  }

  SpaceTrial run(int runs) {
    count();
    trial_.wrong = wrongWitness();
    for (int i = 0; i < runs && !trial_.wrong; ++i) {
      const auto run = machine_.run(random_);
      if (!run)
        break;
      ++trial_.tally.runs;
      trial_.tally.moves += run->result.moves.size();
      trial_.wrong = broken(*run, i % 4 == 0);
    }
    trial_.tally.missed = missed_.size();
    for (const auto &[claim, arguments] : missed_)
      trial_.reasons.push_back(fmt::format("{}, and a run breaks it: {}; {} with{}", nameOf(claim->kind),
                                           claim->verdict.reason(), claim->id, arguments));
    return std::move(trial_);
  }

private:
  void count() {
    SpaceTally &tally = trial_.tally;
    tally.programs = 1;
    tally.incomplete = proof_.incomplete ? 1 : 0;
    for (const Obligation &obligation : proof_.obligations) {
      ++tally.claims;
      tally.proved += obligation.verdict == Verdict::Proved ? 1 : 0;
      tally.unreachable += obligation.verdict == Verdict::Unreachable ? 1 : 0;
      tally.refuted += obligation.verdict == Verdict::Refuted ? 1 : 0;
      tally.margins += obligation.verdict.margin() ? 1 : 0;
      if (obligation.verdict == Verdict::Unknown)
        trial_.reasons.push_back(fmt::format("{}: {}", nameOf(obligation.kind), obligation.verdict.reason()));
    }
  }
  std::string at(Place place) const { return sample_.loaded().blockOf(place); }

  /// What is refuted is seen in a run.
  std::optional<std::string> wrongWitness() {
    constexpr double kSeen = 0.3; // much less may lie between the points that are tried
    for (const Obligation &obligation : proof_.obligations) {
      if (obligation.verdict != Verdict::Refuted)
        continue;
      const GivenVariables &given = obligation.verdict.witness()->variables;
      if (!sample_.allows(given))
        return fmt::format("{}: the contract does not allow the witness{}", obligation.id, argumentsOf(given));
      const SpaceRun run = sample_.run(given);
      for (const Clause &clause : clausesOf(run.space)) {
        if (!isOf(obligation, clause))
          continue;
        const double depth = deepest(run, clause, ownMoves(obligation.place));
        if (depth < kRounding)
          return fmt::format("{}: the witness{} does no harm at {}", obligation.id, argumentsOf(given),
                             at(obligation.place));
        const auto &gouge = obligation.verdict.witness()->gouge;
        if (gouge && gouge->depth > kSeen && clause.claim != SpaceClaim::Clearance && !isSeen(run, clause, *gouge))
          return fmt::format("{}: the witness{} is said to be {} deep at {}, {}, {}, and nothing is seen there",
                             obligation.id, argumentsOf(given), gouge->depth, gouge->at[0], gouge->at[1], gouge->at[2]);
      }
    }
    return std::nullopt;
  }
  bool isSeen(const SpaceRun &run, const Clause &clause, const prove::GougeAt &gouge) {
    constexpr int kTries = 400; // beside its path only a small cap of the tool may be wrong
    for (int i = 0; i < kTries; ++i)
      if (const SpacePoint at = toolAt(run.space, clause.claim, gouge.at);
          wrongPoint(run.space, clause.claim, clause.region, anyBeside(run.space, clause.claim, at, random_), kRounding,
                     random_))
        return true;
    return false;
  }
  static geometry::MoveFilter ownMoves(Place own) {
    return [own](const RecordedMove &move) { return move.own == own; };
  }

  const Obligation *claimOf(const Clause &clause, Place own) const {
    for (const Obligation &obligation : proof_.obligations)
      if (isOf(obligation, clause) && obligation.place == own)
        return &obligation;
    return nullptr;
  }

  std::optional<std::string> broken(const SpaceRun &run, bool looksClosely) {
    std::set<Place> blocks;
    for (const RecordedMove &move : run.result.moves)
      blocks.insert(move.own);
    for (const Clause &clause : clausesOf(run.space))
      for (const Place own : blocks)
        if (const auto why = brokenAt(run, clause, own, looksClosely))
          return fmt::format("{}, with{}", *why, argumentsOf(run.given));
    return std::nullopt;
  }
  std::optional<std::string> brokenAt(const SpaceRun &run, const Clause &clause, Place own, bool looksClosely) {
    const Obligation *claim = claimOf(clause, own);
    if (claim && claim->verdict == Verdict::Refuted)
      return std::nullopt;
    const bool isProved = claim && prove::holds(claim->verdict);
    const double depth = deepest(run, clause, ownMoves(own));
    if (depth > kRounding) {
      if (isProved)
        return fmt::format("{} is {}, and the tool is {} too deep in {}", claim->id, nameOf(claim->verdict), depth,
                           at(own));
      if (!claim && !proof_.incomplete)
        return fmt::format("nothing is claimed of {} {} in {}, and the tool is {} too deep", nameOf(clause.kind),
                           clause.name, at(own), depth);
      if (claim)
        missed_.emplace(claim, argumentsOf(run.given));
    }
    if (isProved && claim->verdict.margin() && depth <= kRounding) {
      const auto margin =
          geometry::smallestMargin(run.space, clause.claim, clause.region, run.result.moves, ownMoves(own));
      if (margin && *margin < *claim->verdict.margin() - kMarginRounding)
        return fmt::format("{} has a margin of {}, and the tool comes as near as {} in {}", claim->id,
                           *claim->verdict.margin(), *margin, at(own));
    }
    if (!looksClosely)
      return std::nullopt;
    const auto seen = seenGouge(run.space, clause.claim, clause.region, run.result.moves, own, 2 * kRounding, random_);
    if (seen && (isProved || (depth <= kRounding && hasFormulas(run.space, clause))))
      return fmt::format("{} {} is {}, {} deep, and the tool at {}, {}, {} is wrong at {}, {}, {} in {}",
                         nameOf(clause.kind), clause.name, claim ? nameOf(claim->verdict) : "not claimed", depth,
                         seen->tip[0], seen->tip[1], seen->tip[2], seen->point[0], seen->point[1], seen->point[2],
                         at(own));
    return std::nullopt;
  }

  const MillingSample &sample_;
  const MillingSample &machine_;
  Random random_;
  prove::ProgramProof proof_;
  SpaceTrial trial_;
  std::map<const Obligation *, std::string> missed_; // and with which arguments
};

// ---- clauses round a way ----

/// The number at which a clause begins to hold in some runs, or nearly; absent where there is none.
std::optional<double> borderOf(const Sample &sample, const OpenClause &open, const std::vector<SpaceRun> &runs) {
  const auto isFree = [&](double number) {
    Sample tried = sample;
    tried.lines.insert(tried.lines.begin() + 1, open.with(number));
    const MillingSample loaded(tried);
    return loaded.isRead() && std::all_of(runs.begin(), runs.end(), [&](const SpaceRun &run) {
             const SpaceRun within{run.given, run.result, loaded.spaceOf(run.given)};
             const std::vector<Clause> clauses = clausesOf(within.space);
             return std::all_of(clauses.begin(), clauses.end(),
                                [&](const Clause &clause) { return deepest(within, clause) < kRounding; });
           });
  };
  double freeAt = open.larger == OpenClause::Larger::Freer ? 60 : -30;
  double tightAt = open.larger == OpenClause::Larger::Freer ? -30 : 60;
  if (!isFree(freeAt) || isFree(tightAt))
    return std::nullopt;
  for (int i = 0; i < 17; ++i) {
    const double middle = (freeAt + tightAt) / 2;
    (isFree(middle) ? freeAt : tightAt) = middle;
  }
  return freeAt;
}

/// Round numbers near the border, on the free side more often.
double nearBorder(double border, const OpenClause &open, Random &random) {
  const double free = open.larger == OpenClause::Larger::Freer ? 1 : -1;
  const double grid = random.of<double>({1, 4, 8, 64, 1024});
  const double on = free * std::ceil(free * border * grid - 1e-3) / grid;
  return std::max(open.least, on + free * random.of<double>({0, 0, 0, 0.125, 0.5, 2, -0.0078125, -0.125}));
}

} // namespace

SpaceTally &SpaceTally::operator+=(const SpaceTally &other) {
  programs += other.programs;
  incomplete += other.incomplete;
  unread += other.unread;
  claims += other.claims;
  proved += other.proved;
  refuted += other.refuted;
  unreachable += other.unreachable;
  margins += other.margins;
  runs += other.runs;
  moves += other.moves;
  missed += other.missed;
  return *this;
}

Sample withSpaceClauses(Sample program, Random &random) {
  constexpr int kRuns = 12;
  if (random.oneIn(4))
    program.lines.insert(program.lines.begin() + 1,
                         "(@CORNER " + random.of<std::string>({"0", ".05", ".25", "1."}) + ")");
  const MillingSample loaded(program);
  if (!loaded.isRead())
    return program;
  std::vector<SpaceRun> runs;
  for (int i = 0; i < kRuns; ++i)
    if (auto run = loaded.run(random); run && !run->result.moves.empty())
      runs.push_back(std::move(*run));
  if (runs.empty())
    return program;
  const auto any = [&](const auto &list) -> const auto & {
    return list[random.below(static_cast<std::uint32_t>(list.size()))];
  };
  Sample result = program;
  std::set<std::string> kinds;
  for (const char *name : {"RA", "RB", "RC"}) {
    const geometry::Point<double> way = anyTip(any(any(runs).result.moves), random);
    const bool isLathe = loaded.loaded().dialect().machine == MachineKind::Turning;
    const OpenClause open = isLathe ? openTurningClause(random, name, way) : openClause(random, name, way);
    const std::string kind = open.text.substr(0, 6);
    const bool isOnce = kind == "(@CLEA" || kind == "(@TRAV";
    if ((isOnce && !kinds.insert(kind).second) || random.oneIn(4))
      continue;
    if (const auto border = borderOf(program, open, runs); border && *border > open.least)
      result.lines.insert(result.lines.begin() + 1, open.with(nearBorder(*border, open, random)));
  }
  return result;
}

SpaceTrial trySpaceProofs(const Sample &sample, std::uint64_t seed, int runs, const prove::Budget &budget) {
  const MillingSample loaded(sample);
  if (!loaded.isRead()) {
    SpaceTrial unread;
    unread.tally.unread = 1;
    return unread;
  }
  Random settings(seed);
  const MillingSample machine(sample, soundness::machineOf(sample, settings));
  return Judge(loaded, machine, seed, budget).run(runs);
}

Sample leastWrong(Sample sample, std::uint64_t seed, int runs, const prove::Budget &budget) {
  bool smaller = true;
  while (smaller) {
    smaller = false;
    for (std::size_t at = 1; at < sample.lines.size();) {
      Sample fewer = sample;
      fewer.lines.erase(fewer.lines.begin() + static_cast<std::ptrdiff_t>(at));
      if (trySpaceProofs(fewer, seed, runs, budget).wrong) {
        sample = std::move(fewer);
        smaller = true;
      } else {
        ++at;
      }
    }
  }
  return sample;
}

} // namespace feedhold::proof_tests
