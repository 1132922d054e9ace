// The walk over the paths of a program: one instruction after another, loops closed at their heads.
#include "proof/explore/explorer.h"

#include "proof/decide/cancel.h"
#include "proof/decide/entails.h"
#include "proof/explore/loops.h"
#include "proof/smt/steps.h"
#include "proof/symbolic/path_memory.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace feedhold::prove {

using smt::Number;
using smt::TermId;

namespace {
constexpr std::string_view kTooLarge = "gave up: following the paths of the program takes too many steps";
/// Of a question where results are rounded: many are not decided, and more does not decide them.
constexpr Budget kLittle{.search = 10'000, .z3 = 0, .cvc5 = 0};
/// Without a contract, of a question whether a branch may be taken, and of other questions.  Linear reasoning takes
/// less; products that no contract bounds take all they get, and prove nothing.
constexpr Budget kOfBranch{.search = 1'000, .z3 = 0, .cvc5 = 0};
constexpr Budget kOfInvariant{.search = 4'000, .z3 = 0, .cvc5 = 0};
constexpr std::uint32_t kLongestPath = 20'000; // instructions
constexpr std::uint64_t kStepsOfForgetting = 400'000'000;
constexpr std::uint64_t kWorkOfForgetting = 300'000; // of all its questions: behind them every branch is taken
constexpr std::string_view kValueTooLarge = "a value whose formula is too large, and which is taken as any number";
} // namespace

std::optional<std::string> Exploration::unmodelledAt(Place place) const {
  for (const Unmodelled &each : unmodelled)
    if (each.place == place)
      return fmt::format("the motion of this block is unknown, as it is not modelled: {}", each.reason);
  return std::nullopt;
}

const UnmodelledCall *Exploration::callWithoutReturn() const {
  const auto found = std::ranges::find_if(unmodelledCalls, [](const auto &call) { return call.mayNotReturn(); });
  return found == unmodelledCalls.end() ? nullptr : &*found;
}

bool Exploration::reliesOnContracts() const {
  return std::ranges::any_of(unmodelledCalls, [](const auto &call) { return !call.promising.empty(); });
}

// ---- LoopInstance ----

bool LoopInstance::isConstant(const SymbolicInterpretation &interpretation, const smt::TermStore &store,
                              TermId term) const {
  const auto terms = smt::variablesOf(store, term);
  return std::all_of(terms.begin(), terms.end(), [&](TermId variable) { return isFixed(interpretation, variable); });
}

bool LoopInstance::isOfState(const SymbolicInterpretation &interpretation, const smt::TermStore &store,
                             TermId term) const {
  const auto terms = smt::variablesOf(store, term);
  return std::all_of(terms.begin(), terms.end(), [&](TermId variable) {
    return isFixed(interpretation, variable) || (!transitions.empty() && transitions.front().next.contains(variable));
  });
}

void LoopInstance::findDeciding(const smt::TermStore &store) {
  deciding.clear();
  std::vector<TermId> open = rankingHints;
  for (const Transition &transition : transitions)
    open.insert(open.end(), transition.conditions.begin(), transition.conditions.end());
  while (!open.empty()) {
    const TermId term = open.back();
    open.pop_back();
    for (const TermId variable : smt::variablesOf(store, term))
      if (deciding.insert(variable).second)
        for (const Transition &transition : transitions)
          if (const auto next = transition.next.find(variable); next != transition.next.end())
            open.push_back(next->second);
  }
}

// ---- Explorer ----

/// Of going one instruction further, and of the copy of a state.
std::uint64_t Explorer::stepsOf(const Path &path) {
  constexpr std::uint64_t kOfInstruction = 200;
  return kOfInstruction + 2 * path.conditions.size() + 4 * path.state.variables.entries().size();
}

Explorer::Explorer(SymbolicInterpretation &interpretation, const ProgramSet &programs, const ExploreOptions &options,
                   PathMerging merging, std::set<IndexPlace> unbounded)
    : interpretation_(interpretation), store_(interpretation.store()), programs_(programs), options_(options),
      merging_(merging), termsBefore_(store_.size()), entails_(store_), groundTruth_(store_) {
  interpretation_.usePath(this);
  interpretation_.useGlobalNames([&programs](std::uint32_t variable) { return programs.isGlobalName(variable); });
  result_.unbounded = std::move(unbounded);
  using UnlistedCodes = SymbolicInterpretation::UnlistedCodes;
  interpretation_.treatUnlisted(options.missing != MissingPrograms::Return ? UnlistedCodes::DoAnything
                                : options.missingChangeNothing             ? UnlistedCodes::ChangeNothing
                                                                           : UnlistedCodes::Return);
  if (merging != PathMerging::Forget)
    entails_.allow(options.mostWork);
  else if (options.leavesSteps) // elsewhere its steps are the limit
    entails_.allow(std::min(kWorkOfForgetting, options.mostWork));
  if (options.leavesSteps)
    entails_.spendAtMost(kOfInvariant);
  else if (interpretation.arithmetic() != Arithmetic::Exact)
    entails_.spendAtMost(kLittle);
}

Exploration Explorer::run(Callee entry, const SymbolicState &start) {
  result_.treatment = options_.loops;
  entry_ = start;
  interpretation_.startOver();
  Path path{.at = {entry.file, entry.entry},
            .state = start,
            .conditions = {},
            .frames = {{.callee = entry, .call = {entry.file, entry.entry}}},
            .loops = {},
            .moved = store_.no()};
  if (options_.moves != KeepMoves::No) {
    auto context = contextOf(path);
    const TermId isOff = toolPointOf(context, entry_).withoutCompensation.term;
    path.state.variables.set(kBesidePath, {store_.no(), store_.ite(isOff, interpretation_.number(0).number,
                                                                   interpretation_.number(1).number)});
    takeMoves(path);
    path_ = nullptr;
  }
  // One path for each place: what that takes grows with the program alone.
  const std::uint64_t share = merging_ == PathMerging::Forget ? kStepsOfForgetting : options_.mostWork * kStepsOfWork;
  const bool isWithin = smt::within(share, [&] {
                          bool possible = true;
                          for (const TermId assumption : options_.assumptions)
                            possible = possible && path.assume(store_, assumption);
                          if (possible)
                            follow(std::move(path), Purpose::Record, nullptr);
                          return true;
                        }).has_value();
  if (!isWithin) {
    const bool isOverall = smt::areStepsUsedUp();
    result_.isTooLarge = result_.isTooLarge || (!result_.incomplete && !isOverall);
    giveUp(isOverall ? kProgramStepsUsedUp : kTooLarge);
  }
  // What is not asked any more is not proved, and may look as if there were no invariant.
  if (result_.incomplete && entails_.isExhausted())
    result_.isTooLarge = true;
  for (std::size_t call = 0; call < result_.unmodelledCalls.size(); ++call)
    for (const std::size_t loop : result_.unmodelledCalls[call].loops)
      if (auto &known = result_.loops[loop].unmodelledCall; !known || result_.unmodelledCalls[call].mayNotReturn())
        known = call;
  std::erase_if(result_.loops, [](const LoopInstance &loop) { return !loop.isRecorded; });
  for (LoopInstance &loop : result_.loops)
    loop.findDeciding(store_);
  result_.facts = interpretation_.facts();
  result_.forgets = merging_ == PathMerging::Forget;
  result_.work = entails_.work();
  interpretation_.usePath(nullptr);
  return std::move(result_);
}

void Explorer::giveUp(std::string_view reason) {
  if (!result_.incomplete)
    result_.incomplete = reason;
}

void Explorer::giveUpOn(const Worklist &open, const Path &path) {
  const auto nameOf = [&](const Callee &callee) {
    const std::string name = toString(programs_.file(callee.file).model->programs[callee.program].name);
    return name.empty() ? std::string("the program") : name;
  };
  result_.isTooLarge = result_.isTooLarge || !result_.incomplete;
  const auto busiest = open.busiestProgram();
  if (open.size() < 2 || !busiest)
    return giveUp(fmt::format("gave up after {} steps, in {}", result_.steps, nameOf(path.frames.back().callee)));
  giveUp(fmt::format("gave up after {} steps with {} paths open, most of them in {}", result_.steps, open.size(),
                     nameOf(*busiest)));
}

bool Explorer::says(TermId condition) const { return path_ && path_->says(store_, condition); }

bool Explorer::proves(TermId condition) {
  if (const auto known = byEnclosure(condition))
    return *known;
  return path_ && entails_(interpretation_.facts(), path_->conditions, condition);
}

std::optional<bool> Explorer::byEnclosure(TermId condition) {
  return options_.mayEnclose ? groundTruth_.of(condition) : std::nullopt;
}

bool Explorer::isPossible(const Path &path, TermId condition) {
  if (const auto known = byEnclosure(condition))
    return *known;
  const TermId opposite = store_.logicalNot(condition);
  if (condition == store_.no() || path.says(store_, opposite))
    return false;
  if (!options_.leavesSteps)
    return !entails_(interpretation_.facts(), path.conditions, opposite);
  const Budget before = entails_.spendAtMost(kOfBranch);
  const bool isExcluded = entails_(interpretation_.facts(), path.conditions, opposite);
  entails_.spendAtMost(before);
  return !isExcluded;
}

StepContext<SymbolicInterpretation> Explorer::contextOf(Path &path) {
  const ProgramFile &file = fileOf(path);
  interpretation_.useDialect(*file.dialect);
  path_ = &path;
  return {interpretation_, path.state, programs_, file, modesOf(path.at.file), nodeOf(path).block};
}

const ModalTable &Explorer::modesOf(FileId file) {
  auto &modes = modes_[file.index()];
  if (!modes)
    modes = std::make_unique<ModalTable>(*programs_.file(file).dialect);
  return *modes;
}

const Wto &Explorer::wtoOf(const Callee &callee) {
  auto &wto = wtos_[{callee.file.index(), callee.entry.index()}];
  if (!wto) {
    const ProgramFile &file = programs_.file(callee.file);
    wto = std::make_unique<Wto>(file.cfg, *file.model, callee.entry);
  }
  return *wto;
}

Path Explorer::to(Path path, NodeId node) const {
  path.at.node = node;
  return path;
}

// ---- the paths ----

void Explorer::follow(Path start, Purpose purpose, Trial *trial) {
  Worklist work;
  work.add({}, std::move(start));
  while (!work.empty() && !result_.incomplete)
    for (Path &path : merged(work.takeFirst(), trial)) {
      throwIfCancelled();
      smt::spend(stepsOf(path));
      if (isTooMuch(work.size()) || ++path.steps > kLongestPath)
        return giveUpOn(work, path);
      purpose_ = purpose; // opening a loop tries it
      if (!arrive(path, purpose, trial, work))
        continue;
      purpose_ = purpose;
      for (Path &next : execute(std::move(path)))
        wait(work, std::move(next));
      path_ = nullptr;
    }
}

void Explorer::wait(Worklist &work, Path path) {
  Worklist::Position position = positionOf(path);
  work.add(std::move(position), std::move(path));
}

bool Explorer::isTooMuch(std::size_t waiting) {
  const bool isAllAsked = merging_ != PathMerging::Forget && entails_.work() >= options_.mostWork;
  return ++result_.steps > options_.mostSteps || waiting > options_.mostPaths || isAllAsked ||
         store_.size() - termsBefore_ > options_.mostTerms;
}

Worklist::Position Explorer::positionOf(const Path &path) {
  Worklist::Position position;
  for (std::size_t depth = 1; depth < path.frames.size(); ++depth)
    position.push_back(wtoOf(path.frames[depth - 1].callee).positionOf(path.frames[depth].call.node));
  position.push_back(wtoOf(path.frames.back().callee).positionOf(path.at.node));
  return position;
}

/// Those that can go on together; without those that have left the loop that is tried.
std::vector<Path> Explorer::merged(std::vector<Path> paths, Trial *trial) {
  if (merging_ == PathMerging::No)
    return paths;
  std::vector<Path> left;
  for (Path &path : paths) {
    if (!path.atOpenedHead && !closeLeftLoops(path, trial))
      continue;
    const auto same = std::find_if(left.begin(), left.end(), [&](const Path &other) {
      return canMerge(other, path) && (merging_ == PathMerging::Forget || other.cutter == path.cutter);
    });
    if (same != left.end() && same->cutter != path.cutter) {
      loseCutter(*same, "cutter compensation on paths that meet");
      loseCutter(path, "cutter compensation on paths that meet");
    }
    if (same == left.end())
      left.push_back(std::move(path));
    else if (merging_ == PathMerging::Forget)
      mergeAndForget(interpretation_, *same, std::move(path));
    else
      mergeInto(interpretation_, *same, std::move(path));
  }
  return left;
}

// ---- what a step may have stopped at ----

void Explorer::checkExactResults(const Path &path) {
  for (const auto &[result, bits] : interpretation_.takeExactResults()) {
    if (purpose_ != Purpose::Record || options_.wholeNumbersAreExact || result_.inexact.contains(path.at))
      continue;
    const TermId most = store_.number(Number::fromDouble(std::ldexp(1.0, bits)));
    const auto holds = [&](TermId condition) { return entails_(interpretation_.facts(), path.conditions, condition); };
    if (!holds(store_.lessOrEqual(result, most)) || !holds(store_.lessOrEqual(store_.negate(most), result)))
      result_.inexact.insert(path.at);
  }
}

/// That the radii of an arc agree says much about its end, by roots and products: where it follows from the path
/// anyhow, every later question is shorter without it.
bool Explorer::isSeenToHold(const Path &path, const PossibleStop &stop, TermId goesOn) {
  return purpose_ == Purpose::Record && stop.alarm == AlarmKind::ArcRadius && store_.shape(goesOn).hasRounding &&
         entails_(interpretation_.facts(), path.conditions, goesOn);
}

bool Explorer::takeStops(Path &path) {
  checkExactResults(path);
  if (const auto reason = interpretation_.abandoned())
    giveUp(*reason);
  if (interpretation_.takeTooLarge())
    interpretation_.unmodelled(kValueTooLarge, fileOf(path).tree->blocks[nodeOf(path).block].span());
  for (std::string &code : interpretation_.takeReturning())
    recordUnmodelledCall(path, {ownPlace(path), path.conditions, {}, code + " is not a code of this control", code});
  for (const auto &[reason, span] : interpretation_.takeNotes())
    if (purpose_ == Purpose::Record)
      result_.unmodelled.push_back({reason, path.at, span});
  for (const PossibleStop &stop : interpretation_.possibleStops()) {
    if (purpose_ == Purpose::Record) {
      const auto same = [&](const StopSite &known) {
        return known.place == path.at && known.span == stop.place && known.alarm == stop.alarm;
      };
      auto found = std::find_if(result_.stopSites.begin(), result_.stopSites.end(), same);
      if (found == result_.stopSites.end())
        found = result_.stopSites.insert(result_.stopSites.end(), StopSite{path.at, stop.place, stop.alarm, {}});
      smt::spend(path.conditions.size());
      found->instances.push_back({path.conditions, stop.when.term, stop.number, path.moved});
    }
    const TermId goesOn = store_.logicalNot(stop.when.term);
    if (isSeenToHold(path, stop, goesOn))
      continue;
    endCutter(path, stop.when.term);
    if (!path.assume(store_, goesOn))
      return false;
  }
  if (interpretation_.moved())
    path.moved = store_.yes();
  if (options_.moves != KeepMoves::No)
    takeMoves(path);
  interpretation_.takeExactResults(); // of the geometry of the movements: the program has no part in them
  interpretation_.start();
  return true;
}

void Explorer::stopsWhen(Path &path, Condition when, AlarmKind alarm) {
  interpretation_.alarm(when, {alarm, fileOf(path).tree->blocks[nodeOf(path).block].span()});
}

void Explorer::exit(Path &path, ExitKind kind) {
  ++result_.paths;
  endCutter(path, store_.yes());
  if (path.cutter && kind == ExitKind::Returns)
    loseCutter(path, "cutter compensation that is in force where the program returns");
  if (purpose_ == Purpose::Record)
    result_.exits.push_back({kind, path.at, path.conditions, path.state, path.moved});
}

// ---- instructions ----

std::vector<Path> Explorer::execute(Path path) {
  const ProgramArithmetic rounded(interpretation_, path.at);
  interpretation_.start();
  const Place at = path.at;
  std::vector<Path> next = executeInstruction(std::move(path));
  if (!interpretation_.takeExactResults().empty() && purpose_ == Purpose::Record && !options_.wholeNumbersAreExact)
    result_.inexact.insert(at); // of no single path: no path was asked whether they are small enough
  return next;
}

std::vector<Path> Explorer::executeInstruction(Path path) {
  const Instruction &instruction = nodeOf(path).instruction;
  auto context = contextOf(path);
  if (endsCorner(context, instruction)) {
    loseCorner(context);
    if (!takeStops(path))
      return {};
  }
  if (isCallOrReturn(instruction))
    passCallInCutter(path);
  return match(
      instruction, [&](const BlockSkip &skip) { return follow(std::move(path), skip); },
      [&](const Test &test) { return follow(std::move(path), test); },
      [&](const JumpTo &jump) { return follow(std::move(path), jump); },
      [&](const CountDown &count) { return follow(std::move(path), count); },
      [&](const CallProgram &call) { return follow(std::move(path), call); },
      [&](const ReturnFromProgram &from) { return follow(std::move(path), from); },
      [&](const EndProgram &end) { return follow(std::move(path), end); },
      [&](const auto &) { return straight(std::move(path)); });
}

std::vector<Path> Explorer::straight(Path path) {
  const Node &node = nodeOf(path);
  auto context = contextOf(path);
  auto writes = beginWrites(path);
  step(context, node.instruction, words_);
  if (writes)
    writes->unkept = interpretation_.unkeptWrites();
  const bool isBlock = std::holds_alternative<ExecuteWords>(node.instruction);
  const Condition moves =
      isBlock && !interpretation_.stopped() ? movesAxis(context, words_) : interpretation_.truth(false);
  if (isBlock && !words_.unlisted.empty() && programs_.node({path.at.file, node.next}).block == node.block)
    giveUp("a G code that the control does not have may take the other codes of its block as arguments");
  if (!takeStops(path))
    return {};
  if (writes)
    takeWrites(path, *writes);
  if (moves.term != store_.no())
    return modalCall(std::move(path), moves);
  return {to(std::move(path), node.next)};
}

std::vector<Path> Explorer::branch(Path path, Condition condition, NodeId taken) {
  std::vector<Path> paths;
  const NodeId next = nodeOf(path).next;
  if (!takeStops(path))
    return paths;
  if (next == taken)
    return {to(std::move(path), next)};
  const TermId opposite = store_.logicalNot(condition.term);
  if (isPossible(path, opposite)) {
    smt::spend(stepsOf(path));
    Path straightOn = to(path, next);
    if (straightOn.assume(store_, opposite))
      paths.push_back(std::move(straightOn));
  }
  if (isPossible(path, condition.term)) {
    Path other = to(std::move(path), taken);
    if (other.assume(store_, condition.term))
      paths.push_back(std::move(other));
  }
  return paths;
}

std::vector<Path> Explorer::follow(Path path, const BlockSkip &skip) {
  return branch(std::move(path), interpretation_.unknownTruth(), skip.skipped);
}
std::vector<Path> Explorer::follow(Path path, const Test &test) {
  auto context = contextOf(path);
  const Condition condition = conditionOf(context, test);
  return branch(std::move(path), condition, test.taken);
}
std::vector<Path> Explorer::follow(Path path, const CountDown &count) {
  auto context = contextOf(path);
  const Condition goesOn = countDown(context, count);
  return branch(std::move(path), goesOn, count.taken);
}
std::vector<Path> Explorer::follow(Path path, const JumpTo &jump) {
  auto context = contextOf(path);
  const SymbolicValue number = jumpTarget(context, jump);
  const BlockId from = nodeOf(path).block;
  return search(std::move(path), number, from);
}

/// A path for each sequence number of the program that the number may be.
std::vector<Path> Explorer::search(Path path, const SymbolicValue &number, BlockId from) {
  const ProgramFile &file = fileOf(path);
  const auto constant = [&](double value) { return interpretation_.number(value).number; };
  const TermId inRange = store_.logicalAnd(
      store_.lessOrEqual(constant(file.dialect->grammar.sequenceZero ? 0 : 1), number.number),
      store_.lessOrEqual(number.number, constant(static_cast<double>(file.dialect->limits.lastSequenceNumber))));
  std::map<std::uint32_t, NodeId> places;
  std::vector<TermId> found;
  for (const LabelNode &label : labelsOf(file.cfg, *file.model, from))
    if (const auto place = findLabel(file.cfg, *file.model, path.frames.back().callee.program, label.number, from))
      if (places.emplace(label.number, *place).second)
        found.push_back(store_.equal(number.number, constant(label.number)));
  stopsWhen(path, {store_.logicalNot(inRange)}, AlarmKind::SequenceOutOfRange);
  stopsWhen(path, {store_.logicalNot(store_.logicalOr(found))}, AlarmKind::SequenceNotFound);
  std::vector<Path> paths;
  if (!takeStops(path))
    return paths;
  for (const auto &[label, place] : places) {
    const TermId isLabel = store_.equal(number.number, constant(label));
    if (!isPossible(path, isLabel))
      continue;
    Path there = to(path, place);
    if (there.assume(store_, isLabel))
      paths.push_back(std::move(there));
  }
  return paths;
}

std::vector<Path> Explorer::follow(Path path, const EndProgram &end) {
  const ProgramFile &file = fileOf(path);
  if (end.end == ProgramEnd::EndOfFile && alarmNumber(*file.dialect, AlarmKind::EndOfRecord)) {
    stopsWhen(path, interpretation_.truth(true), AlarmKind::EndOfRecord);
    takeStops(path);
    return {};
  }
  if (end.end != ProgramEnd::EndOfFile) {
    auto context = contextOf(path);
    restoreModesAtEnd(context);
  }
  exit(path, ExitKind::Ends);
  return {};
}

namespace {

Exploration exploreOnce(SymbolicInterpretation &interpretation, const ProgramSet &programs, Callee entry,
                        const SymbolicState &start, const ExploreOptions &options) {
  if (options.loops == LoopTreatment::EachIteration)
    return exploreWithRanges(interpretation, programs, entry, start, options, PathMerging::No);
  ExploreOptions first = options;
  first.mostSteps /= 4;
  first.mostPaths /= 4;
  first.mostWork /= 2;
  first.mostTerms /= 2;
  // Shares that add up to less than all: the claims are asked, and runs are made, with what remains.
  const std::uint64_t left = smt::stepsLeft();
  const auto explored = [&](const ExploreOptions &limits, PathMerging merging, std::uint64_t steps) {
    std::optional<smt::Steps> share;
    if (options.leavesSteps)
      share.emplace(steps, smt::Steps::AtEnd::GoOn);
    Exploration found = exploreWithRanges(interpretation, programs, entry, start, limits, merging);
    found.merging = merging;
    return found;
  };
  if (options.merging == PathMerging::No)
    if (Exploration found = explored(first, PathMerging::No, left / 8); !found.isTooLarge)
      return found;
  if (options.merging != PathMerging::Forget)
    if (Exploration merged = explored(options, PathMerging::Yes, left / 10); !merged.isTooLarge)
      return merged;
  return explored(options, PathMerging::Forget, left / 3);
}

/// Both.
LoopHints joined(LoopHints first, LoopHints second) {
  if (!first || !second)
    return first ? first : second;
  return [first = std::move(first), second = std::move(second)](Place head, const SymbolicState &state) {
    std::vector<TermId> all = first(head, state);
    std::ranges::move(second(head, state), std::back_inserter(all));
    return all;
  };
}

std::set<Place> headsOf(const Exploration &found) {
  std::set<Place> heads;
  for (const LoopInstance &loop : found.loops)
    heads.insert(loop.head);
  return heads;
}

} // namespace

/// Results are taken as exact where they may be, until it turns out that one may be too large, also with bounds from
/// elsewhere.
Exploration explore(SymbolicInterpretation &interpretation, const ProgramSet &programs, Callee entry,
                    const SymbolicState &start, ExploreOptions options) {
  constexpr int kMostRounds = 4;
  for (int round = 0;; ++round) {
    Exploration found = exploreOnce(interpretation, programs, entry, start, options);
    if (found.inexact.empty() || found.incomplete)
      return found;
    options.merging = found.merging; // terms only grow: with less merging there would be too many paths again
    if (const auto boundsAt = std::exchange(options.boundsAt, {}); boundsAt && !found.loops.empty()) {
      options.invariants = joined(std::move(options.invariants), boundsAt(headsOf(found)));
      continue;
    }
    for (const Place place : found.inexact)
      interpretation.roundAlways(place);
    if (round == kMostRounds) {
      found.incomplete = "gave up: whole numbers may grow so large that the control rounds them";
      return found;
    }
  }
}

} // namespace feedhold::prove
