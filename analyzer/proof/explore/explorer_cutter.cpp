// Cutter compensation on the paths of a proof: the moves of the tool's centre in place of the programmed ones.
//
// A path that ends, or comes to the head of a loop, leaves it: a run of it may end there too, and the state before an
// arbitrary iteration does not know it.
#include "proof/explore/explorer.h"
#include "proof/explore/path_cutter.h"
#include "proof/symbolic/path_memory.h"

#include <algorithm>
#include <cmath>

namespace feedhold::prove {

using smt::TermId;

namespace {

/// The path writes offsets of D or of T, has written them, or started with them in its variables.
bool touchesOffsets(const Dialect &dialect, const SymbolicState &state,
                    const std::map<std::uint32_t, SymbolicValue> &read) {
  const OffsetMemory &offsets = dialect.behaviour.cutterOffsets;
  const std::array firsts{offsets.geometry[0], offsets.geometry[1], offsets.wear[0], offsets.wear[1]};
  const auto holdsOffset = [&](std::uint32_t low, std::uint32_t high) {
    if (dialect.machine == MachineKind::Turning)
      return mayBeTipOffset(low, high);
    return std::any_of(firsts.begin(), firsts.end(),
                       [&](std::uint32_t first) { return first != 0 && low < first + offsets.count && first <= high; });
  };
  const auto isOffset = [&](const auto &each) { return holdsOffset(each.first, each.first); };
  const auto &written = state.variables.entries();
  return std::any_of(written.begin(), written.end(), isOffset) || std::any_of(read.begin(), read.end(), isOffset) ||
         std::any_of(state.havocked.begin(), state.havocked.end(),
                     [&](const auto &range) { return holdsOffset(range.first, range.second); });
}

/// It has one variable for each column.
bool isNumbered(const OffsetMemory &memory) {
  return memory.count != 0 && memory.geometry[1] == 0 && memory.wear[1] == 0;
}

} // namespace

/// `also`: a further condition of its runs.
PathCutter Explorer::cutterOf(Path &path, CutterTrack &track, TermId also) {
  const auto conditions = [&path, also, yes = store_.yes()] {
    std::vector<TermId> all = path.conditions;
    if (also != yes)
      all.push_back(also);
    return all;
  };
  return {
      store_,
      track,
      {.proves = [this, conditions](TermId truth) { return entails_(interpretation_.facts(), conditions(), truth); },
       .offsetOf = [this, &path](const SymbolicValue &number) { return offsetOf(path, number); },
       .record =
           [this, conditions](MoveInstance move) {
             if (purpose_ != Purpose::Record)
               return;
             move.conditions = conditions();
             result_.moves.push_back(std::move(move));
           },
       .claim =
           [this, conditions](CutterClaim claim) {
             if (purpose_ != Purpose::Record)
               return;
             claim.conditions = conditions();
             result_.cutterClaims.push_back(std::move(claim));
           }}};
}

/// In the units of the start, where no offset has been written: those of a contract are those of the start.
std::optional<PathOffset> Explorer::offsetOf(Path &path, const SymbolicValue &number) {
  auto context = contextOf(path);
  const auto proves = [&](TermId truth) { return entails_(interpretation_.facts(), path.conditions, truth); };
  if (!proves(toolPointOf(context, entry_).sameUnits.term))
    return std::nullopt;
  if (touchesOffsets(*fileOf(path).dialect, path.state, interpretation_.entryValues()))
    return writtenOffset(path, number);
  auto offset = options_.cutterOffset(number, proves);
  if (offset)
    for (const TermId condition : offset->conditions)
      path.assume(store_, condition);
  return offset;
}

/// The sum of both variables of its number, where the path bounds them: the program has written them, or the contract
/// says what one holds.
std::optional<PathOffset> Explorer::writtenOffset(Path &path, const SymbolicValue &number) {
  constexpr int kLargest = 10'000; // an offset of which nothing is known has no bound
  const Dialect &dialect = *fileOf(path).dialect;
  const OffsetMemory &memory = dialect.behaviour.cutterOffsets;
  const bool isOneMemory = isNumbered(memory) && dialect.machine == MachineKind::Milling;
  const double row = store_.isNumber(number.number) ? store_[number.number].number.toDouble() : 0;
  if (!isOneMemory || !(row >= 1 && row <= memory.count) || row != std::floor(row))
    return std::nullopt;
  if (dialect.switches.odi == Switch::Unknown)
    return PathOffset{.radius = number.number,
                      .why =
                          "cutter compensation by an offset that the program writes, of which it is not known whether "
                          "it is a radius or a diameter (the switch `odi`)"};
  auto context = contextOf(path);
  TermId radius = store_.number(smt::Number(0));
  for (const std::uint32_t first : {memory.geometry[0], memory.wear[0]}) {
    const std::uint32_t cell = cellOf(dialect, first + static_cast<std::uint32_t>(row) - 1);
    const TermId part = interpretation_.asNumber(detail::storedValue(context, cell)).number;
    const TermId largest = store_.number(smt::Number(kLargest));
    const TermId isBounded = store_.logicalAnd(store_.less(store_.negate(largest), part), store_.less(part, largest));
    if (!entails_(interpretation_.facts(), path.conditions, isBounded))
      return PathOffset{.radius = radius,
                        .why = "cutter compensation by an offset of which the program does not write both geometry and "
                               "wear; `@GLOBAL` tells what the variable of the other holds"};
    radius = store_.add(radius, part);
  }
  const bool isDiameter = dialect.switches.odi == Switch::On;
  return PathOffset{.radius = isDiameter ? store_.scale(smt::Number(1) / smt::Number(2), radius) : radius};
}

void Explorer::passCallInCutter(Path &path) {
  if (!path.cutter)
    return;
  auto track = std::make_shared<CutterTrack>(*path.cutter);
  track->walk.passCall();
  path.cutter = std::move(track);
}

/// The block has been executed.  True: its moves are taken here, in place of the explorer.
bool Explorer::takeCutter(Path &path, const std::vector<MoveInstance> &moves, TermId besidePath) {
  const bool isBlock = std::holds_alternative<ExecuteWords>(nodeOf(path).instruction) &&
                       (!words_.codes.empty() || !words_.entries.empty());
  if (!options_.cutterOffset)
    return false;
  auto context = contextOf(path);
  const bool setsSide = std::any_of(words_.codes.begin(), words_.codes.end(),
                                    [](const CodeWord &word) { return detail::setsSide(*word.code); });
  const bool begins = findPocket(words_) || (setsSide && mayCompensate(context));
  if (isBlock && !path.cutter && mayRestoreSide(path))
    return false;
  if (!isBlock || (!path.cutter && !begins)) {
    if (!moves.empty() && path.cutter)
      loseCutter(path, "cutter compensation through a move that is not modelled");
    return false;
  }
  const TermId onPath = store_.equal(besidePath, store_.number(smt::Number(0)));
  const Dialect &dialect = *fileOf(path).dialect;
  auto track = path.cutter ? std::make_shared<CutterTrack>(*path.cutter)
                           : std::make_shared<CutterTrack>(CutterTrack{CutterPath<PathCutter>(dialect), {}, 0, onPath});
  PathCutter host = cutterOf(path, *track, store_.yes());
  const bool wasOff = !path.cutter;
  path.cutter = track;
  if (!moves.empty() && track->end && inCutterPlane(path, moves.front().move.start) != *track->end) {
    loseCutter(path, "cutter compensation through a change of the position without a move");
    return false;
  }
  const CutterBlock<TermLength> block = cutterBlockOf(host, context, words_);
  const std::size_t first = track->next;
  for (MoveInstance move : moves) {
    decideVacancies(path, move);
    giveCentre(path, move);
    track->open.emplace(track->next++, std::move(move));
  }
  if (!moves.empty())
    track->end = inCutterPlane(path, moves.back().move.end);
  track->walk.take(host, block, {path.at, path.frames.size() - 1}, first, track->next);
  return settleCutter(path, *track, first, wasOff);
}

/// `G#7`, where #7 holds what #4007 said: which offset and which side it restores is not followed.
bool Explorer::mayRestoreSide(Path &path) {
  auto context = contextOf(path);
  const CodeMask sides =
      context.modes.maskOf(ModalKind::Compensation, {CodeAction::CompensationLeft, CodeAction::CompensationRight});
  const bool restores = std::any_of(words_.computed.begin(), words_.computed.end(), [&](const auto &each) {
    return each.first == context.modes.groupOf(ModalKind::Compensation) &&
           isPossible(path, interpretation_.isOneOf(each.second, sides).term);
  });
  if (!restores)
    return false;
  if (purpose_ == Purpose::Record)
    result_.cutterClaims.push_back(
        {path.at, path.conditions, store_.no(), std::nullopt, "cutter compensation that a computed code restores"});
  path.state.variables.set(kBesidePath, interpretation_.number(1));
  return true;
}

/// `X#8` moves where #8 is not vacant: what the path says of it needs no case in the coordinates.
void Explorer::decideVacancies(const Path &path, MoveInstance &instance) {
  Move<SymbolicValue> &move = instance.move;
  smt::Substitution known;
  for (const TermId condition : path.conditions) {
    const smt::Term &term = store_[condition];
    if (term.kind == smt::TermKind::Variable)
      known.emplace(condition, store_.yes());
    else if (term.kind == smt::TermKind::Not && store_[term.arguments.front()].kind == smt::TermKind::Variable)
      known.emplace(term.arguments.front(), store_.no());
  }
  const auto decide = [&](TermId &term) {
    const auto &variables = smt::variablesOf(store_, term);
    if (std::any_of(variables.begin(), variables.end(), [&](TermId each) { return known.contains(each); }))
      term = smt::substitute(store_, term, known);
  };
  for (auto *point : {&move.start, &move.end})
    for (const Axis axis : {Axis::X, Axis::Y, Axis::Z})
      decide((*point)[indexOf(axis)].number);
  decide(move.firstCentre.number);
  decide(move.secondCentre.number);
  if (instance.radius)
    decide(instance.radius->size);
}

/// Of an arc by R whose centre is told by the form of its terms.  Of a lathe in the plane of Z and the radius.
void Explorer::giveCentre(const Path &path, MoveInstance &move) {
  const bool isOfLathe = isLathe(path);
  if (!move.radius || (isOfLathe && move.move.plane.normal != Axis::Y))
    return;
  const TermId two = store_.number(smt::Number(2));
  const auto at = [&](const auto &point) {
    if (isOfLathe)
      return geometry::TermPoint{point[2].number, store_.divide(point[0].number, two), store_.number(smt::Number(0))};
    return geometry::TermPoint{point[0].number, point[1].number, point[2].number};
  };
  const geometry::ToolPath arc(store_, {.kind = move.move.kind,
                                        .start = at(move.move.start),
                                        .end = at(move.move.end),
                                        .isInBox = false,
                                        .plane = isOfLathe ? kPlaneXY : move.move.plane,
                                        .turns = move.move.turns,
                                        .radius = move.radius});
  if (arc.move().radius)
    return;
  const TermId second = arc.move().secondCentre;
  move.move.firstCentre.number = arc.move().firstCentre;
  move.move.secondCentre.number = isOfLathe ? store_.multiply(two, second) : second;
}

/// X and Y; of a lathe, X and Z.
std::array<TermId, 2> Explorer::inCutterPlane(const Path &path, const std::array<SymbolicValue, kAxisCount> &point) {
  const Axis second = isLathe(path) ? Axis::Z : Axis::Y;
  return {point[indexOf(Axis::X)].number, point[indexOf(second)].number};
}
bool Explorer::isLathe(const Path &path) const { return fileOf(path).dialect->machine == MachineKind::Turning; }

/// What has become of the compensation in the block.  False: its moves, from `first` on, are left to the explorer.
bool Explorer::settleCutter(Path &path, CutterTrack &track, std::size_t first, bool wasOff) {
  PathCutter host = cutterOf(path, track, store_.yes());
  const auto claim = [&](TermId goal, std::string_view why) {
    if (purpose_ == Purpose::Record && track.walk.began())
      result_.cutterClaims.push_back({*track.walk.began(), path.conditions, goal, std::nullopt, std::string(why)});
  };
  const auto notes = track.walk.takeNotes();
  const std::string_view why = notes.empty() ? "the control stops in this cutter compensation" : notes.front().reason;
  if (track.walk.isLost() || track.walk.alarm() || !notes.empty()) {
    if (!track.walk.alarm())
      claim(store_.no(), why);
    else
      stopInCutter(path, track);
    const bool hasBegun = track.walk.began().has_value();
    if (hasBegun)
      leaveOpen(host, track, why);
    path.cutter.reset();
    return hasBegun;
  }
  if (wasOff && track.walk.began()) // the tool stands on its path at the start
    claim(track.rests, {});
  for (std::size_t i = first; i < track.next; ++i)
    if (track.open.contains(i) && !track.walk.awaits(i)) { // not yet begun, or no move along the path
      MoveInstance move = track.open.extract(i).mapped();
      move.point.withoutCompensation.term = track.rests;
      if (purpose_ == Purpose::Record)
        result_.moves.push_back(std::move(move));
    }
  if (track.walk.isOff())
    path.cutter.reset();
  return true;
}

void Explorer::stopInCutter(const Path &path, const CutterTrack &track) {
  const auto &alarm = track.walk.alarm();
  if (purpose_ == Purpose::Record)
    result_.cutterClaims.push_back({alarm->began, path.conditions, store_.no(), alarm->kind, {}});
}

void Explorer::leaveOpen(PathCutter &host, CutterTrack &track, std::string_view why) {
  while (!track.open.empty())
    host.leave(track.open.begin()->first, why);
}

/// From here on nothing is known of the centre until the compensation has ended.
void Explorer::loseCutter(Path &path, std::string_view reason) {
  if (!path.cutter)
    return;
  CutterTrack track = *path.cutter;
  path.cutter.reset();
  PathCutter host = cutterOf(path, track, store_.yes());
  leaveOpen(host, track, reason);
  if (purpose_ == Purpose::Record && track.walk.began())
    result_.cutterClaims.push_back(
        {*track.walk.began(), path.conditions, store_.no(), std::nullopt, std::string(reason)});
  path.state.variables.set(kBesidePath, interpretation_.number(1));
}

/// Runs of the path end here where `when` holds: the control knows no further block.
void Explorer::endCutter(Path &path, TermId when) {
  if (!path.cutter || !path.cutter->walk.hasPending() || purpose_ != Purpose::Record || !isPossible(path, when))
    return;
  CutterTrack track = *path.cutter;
  PathCutter host = cutterOf(path, track, when);
  track.walk.finish(host);
  leaveOpen(host, track, "cutter compensation that does not end");
}

} // namespace feedhold::prove
