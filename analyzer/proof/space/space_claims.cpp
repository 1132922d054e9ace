#include "proof/space/space_claims.h"

#include "proof/space/plain_space.h"
#include "proof/space/region_margins.h"
#include "proof/space/region_shapes.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>

namespace feedhold::prove {

using geometry::FreeSpace;
using geometry::TermPoint;
using geometry::TermShape;
using smt::TermId;

bool hasSpaceClause(const Contract &contract) {
  return !contract.keepIn.empty() || !contract.keepOut.empty() || contract.clearance || contract.travel ||
         contract.machine;
}

geometry::SpaceClaim claimOf(const SpaceRule &rule) {
  if (rule.kind == ObligationKind::KeepIn)
    return geometry::SpaceClaim::KeepIn;
  if (rule.kind == ObligationKind::KeepOut)
    return geometry::SpaceClaim::KeepOut;
  if (rule.kind == ObligationKind::Clearance)
    return geometry::SpaceClaim::Clearance;
  return rule.isOfMachine ? geometry::SpaceClaim::Machine : geometry::SpaceClaim::Travel;
}

bool isCutting(MoveKind kind) { return kind == MoveKind::Feed || kind == MoveKind::CutInBox || isArc(kind); }

SpaceClaims::SpaceClaims(smt::TermStore &store, ContractTerms &terms, const Contract &contract,
                         const SymbolicState &entry, const Dialect &dialect, smt::Number tolerance)
    : store_(store), terms_(terms), contract_(contract), entry_(entry), dialect_(dialect),
      tolerance_(std::move(tolerance)), fixed_(fixedAxes(contract)),
      corner_(smt::Number::fromTyped(cornerOf(contract).toDouble())), space_(store, tip()) {
  if (!contract.lengths.empty())
    lengthInSpindle_ = terms.lengthInSpindle(contract, entry);
  addRegions(contract.keepIn, ObligationKind::KeepIn);
  addRegions(contract.keepOut, ObligationKind::KeepOut);
  const auto number = [&](ExpressionId expression) { return terms_.number(expression, entry_, entry_); };
  if (contract.clearance)
    rules_.push_back({.kind = ObligationKind::Clearance,
                      .clause = contract.clearance->clause,
                      .height = store_.add(number(contract.clearance->height.value),
                                           store_.number(distanceOf(geometry::SpaceClaim::Clearance)))});
  const auto limits = [&](geometry::SpaceClaim claim, ClauseId clause, const Box &sides) {
    const geometry::Box<TermId> box = RegionShapes<TermId, TermId>{number, {}, diameters()}.sides(sides);
    rules_.push_back({.kind = ObligationKind::Travel,
                      .clause = clause,
                      .spaces = {geometry::inside(store_, std::get<geometry::Box<TermId>>(
                                                              shrunk(store_, box, store_.number(distanceOf(claim)))))},
                      .isSound = geometry::isNotEmpty(store_, TermShape(box))});
  };
  if (contract.travel)
    limits(geometry::SpaceClaim::Travel, contract.travel->clause, contract.travel->box);
  if (contract.machine) {
    limits(geometry::SpaceClaim::Machine, contract.machine->clause, contract.machine->box);
    rules_.back().name = "MACHINE";
    rules_.back().isOfMachine = true;
  }
}

std::optional<LatheTip> SpaceClaims::tip() const {
  if (dialect_.machine != MachineKind::Turning)
    return std::nullopt;
  if (!contract_.tool)
    return LatheTip{tipDirection(0), store_.number(smt::Number(0))};
  return LatheTip{tipDirection(contract_.tool->direction), terms_.number(contract_.tool->radius, entry_, entry_)};
}

std::optional<Diameters<TermId>> SpaceClaims::diameters() const {
  if (!space_.isLathe())
    return std::nullopt;
  const TermId two = store_.number(smt::Number(2));
  return Diameters<TermId>{[this, two](TermId number) { return store_.divide(number, two); },
                           [this, two](TermId number) { return store_.multiply(number, two); },
                           [this](TermId number) { return store_.negate(number); },
                           [this](TermId number) {
                             const TermId zero = store_.number(smt::Number(0));
                             return store_.ite(store_.lessOrEqual(zero, number), number, store_.negate(number));
                           },
                           store_.number(smt::Number(0))};
}

std::string_view SpaceClaims::axesOfRegions() const { return space_.isLathe() ? "X and Z" : "X, Y and Z"; }

void SpaceClaims::addRegions(const std::vector<Region> &regions, ObligationKind kind) {
  const RegionShapes<TermId, TermId> shapes{
      [this](ExpressionId expression) { return terms_.number(expression, entry_, entry_); },
      [this](ExpressionId condition, const TermPoint &point) { return terms_.conditionAt(condition, entry_, point); },
      diameters()};
  const std::vector<std::string> names = namesOf(regions);
  for (std::size_t i = 0; i < names.size(); ++i) {
    SpaceRule rule{.kind = kind, .clause = regions.front().clause, .region = i, .name = names[i]};
    std::vector<TermShape> parts;
    for (const Region &region : regions)
      if (region.name == names[i]) {
        if (parts.empty())
          rule.clause = region.clause;
        if (kind == ObligationKind::KeepIn)
          parts.push_back(shapes.keptIn(region));
        else
          std::ranges::move(shapes.keptOut(region), std::back_inserter(parts));
      }
    if (!contract_.tool) {
      rule.missing =
          space_.isLathe()
              ? "the contract does not describe the tool; state it with `@TOOL`, for example `@TOOL TIP RADIUS 0.8 "
                "DIRECTION 3`"
              : "the contract does not describe the tool; state it with `@TOOL`, for example `@TOOL FLAT RADIUS #7`";
      rules_.push_back(std::move(rule));
      continue;
    }
    const geometry::Tool<TermId> tool = shapes.tool(*contract_.tool, store_.number(smt::Number(0)));
    rule.isSound = geometry::isTool(store_, tool);
    for (const TermShape &part : parts)
      rule.isSound = store_.logicalAnd(rule.isSound, geometry::isNotEmpty(store_, part));
    const auto spacesAt = [this, tool, parts, kind](const smt::Number &distance) {
      return kind == ObligationKind::KeepIn ? insideAt(store_, tool, parts, distance)
                                            : outsideAt(store_, tool, parts, distance);
    };
    rule.spaces = spacesAt(distanceOf(claimOf(rule)));
    if (kind == ObligationKind::KeepOut || knowDistances(parts))
      rule.spacesFor = [this, spacesAt](const smt::Number &margin) {
        std::vector<FreeSpace> spaces = spacesAt(corner_ + margin);
        for (FreeSpace &space : spaces)
          space.beyond.clear(); // margins are found without
        return spaces;
      };
    rules_.push_back(std::move(rule));
  }
}

/// Of the programmed path from what a clause says: the tool may be nearer by the one and pass it by the other.
smt::Number SpaceClaims::distanceOf(geometry::SpaceClaim claim) const {
  const bool isBesidePath = geometry::isOfToolBesidePath(claim);
  return (isBesidePath ? corner_ : smt::Number(0)) - tolerance_;
}

SpaceRule SpaceClaims::withMargin(const SpaceRule &rule, double margin) const {
  SpaceRule wider = rule;
  wider.spaces = rule.spacesFor(smt::Number::fromTyped(margin));
  return wider;
}

/// `@TRAVEL` speaks of the points that the program writes.
bool SpaceClaims::isOfProgrammed(const SpaceRule &rule) {
  return rule.kind == ObligationKind::Travel && !rule.isOfMachine;
}

/// One that regions do not describe.
bool SpaceClaims::mayMoveBeside(const MoveInstance &instance, Axis axis) const {
  const auto isSame = [](const SymbolicValue &a, const SymbolicValue &b) { return a == b; };
  return isBesideRegions(dialect_, axis) && mayMove(instance.move, axis, isSame);
}

/// What to state of a rotary axis; absent: of one that is not known.
std::string SpaceClaims::adviceOnAngles(std::optional<Axis> axis) const {
  if (space_.isLathe() || (axis && isLinear(*axis)))
    return {};
  return axis ? fmt::format("; if the regions are the same at every angle of {0}, state `@FIXED {0}`", letterOf(*axis))
              : "; if the regions are the same at every angle of a rotary axis, state `@FIXED` with its letter";
}

bool SpaceClaims::concerns(const SpaceRule &rule, const MoveInstance &instance) const {
  const MoveKind kind = instance.move.kind;
  const bool asksOfProgrammed = isOfProgrammed(rule) || rule.kind == ObligationKind::Limit;
  if (instance.path == (asksOfProgrammed ? MovePath::Centre : MovePath::Programmed))
    return false;
  if (kind == MoveKind::Unmodelled)
    return true;
  if (rule.kind == ObligationKind::KeepIn || rule.kind == ObligationKind::Limit)
    return isCutting(kind);
  return rule.kind != ObligationKind::Clearance || kind == MoveKind::Rapid;
}

std::optional<std::string> SpaceClaims::whyNotTold(const MoveInstance &instance) const {
  if (instance.move.kind == MoveKind::Unmodelled)
    return "the motion of this block is unknown: it could not be read, its code is not modelled, or the motion code or "
           "the plane at the start is unknown, which `@MODAL` states";
  for (const Axis axis : kAllAxes)
    if (!fixed_[indexOf(axis)] && mayMoveBeside(instance, axis))
      return fmt::format("axis {} moves; regions cover {} only{}", letterOf(axis), axesOfRegions(),
                         adviceOnAngles(axis));
  if (space_.isLathe() && isArc(instance.move.kind) && instance.move.plane.first != Axis::Z)
    return "the arc is not in the plane of X and Z (G18), which regions of a lathe describe";
  return std::nullopt;
}

std::vector<std::pair<TermId, std::string>> SpaceClaims::premises(const SpaceRule &rule,
                                                                  const MoveInstance &instance) const {
  std::vector<std::pair<TermId, std::string>> premises;
  const auto addUnits = [&] {
    premises.emplace_back(instance.point.sameUnits.term,
                          "the units (G20, G21) may differ from those of the start; state these, for example with "
                          "`@MODAL G21`");
  };
  if (!isOfProgrammed(rule))
    premises.emplace_back(instance.point.withoutCompensation.term,
                          instance.path != MovePath::Both ? "the control may stop in this cutter compensation, as its "
                                                            "own claim says; the path of the tool's centre is "
                                                            "known where it does not"
                          : instance.whyBeside.empty()
                              ? "cutter compensation (G41, G42) may be active or end here, and the path of the tool's "
                                "centre is not known; "
                                "if it is off at the start, state `@MODAL G40`"
                              : fmt::format("the path of the tool's centre is not followed: {}", instance.whyBeside));
  if (rule.isOfMachine) {
    addUnits();
    return premises;
  }
  if (lengthInSpindle_ && !isOfProgrammed(rule))
    premises.emplace_back(
        store_.logicalNot(instance.point.lengthSubtracted.term),
        "G44 subtracts the tool length here, and `@LENGTH` tells lengths as G43 adds them; write G43 with the "
        "length negated, or leave out `@LENGTH`: regions need no lengths");
  else
    premises.emplace_back(
        instance.point.lengthKnown.term,
        space_.isLathe()
            ? "no tool offset is in force (T0100), or it is not known which, so that the place of the tip is unknown"
            : "tool length compensation has been cancelled (G49), so that the height of the tip is unknown; if it "
              "was off at the start, state `@MODAL G49`; or the lengths of the tools, with `@LENGTH H* ..`");
  if (rule.kind != ObligationKind::Travel)
    premises.emplace_back(instance.point.sameSide.term,
                          fmt::format("an axis other than {} has moved since the start and may have rotated the part{}",
                                      axesOfRegions(), adviceOnAngles({})));
  addUnits();
  return premises;
}

/// In the coordinates of the rule: those of the machine, or of the tip.
MoveInstance SpaceClaims::placed(const SpaceRule &rule, MoveInstance instance) const {
  if (rule.isOfMachine) {
    instance.point.zero = instance.point.machineZero;
  } else if (lengthInSpindle_ && !isOfProgrammed(rule)) {
    TermId &height = instance.point.zero[indexOf(Axis::Z)].number;
    height = store_.ite(instance.point.withLength.term, height, store_.subtract(height, *lengthInSpindle_));
  }
  return instance;
}

std::vector<SpaceQuestion> SpaceClaims::questions(const SpaceRule &rule, const MoveInstance &asMoved) const {
  const MoveInstance instance = placed(rule, asMoved);
  if (rule.kind == ObligationKind::Clearance)
    return {clearanceOf(rule, instance)};
  PathQuestions asked(store_, (isOfProgrammed(rule) ? space_.ofProgrammed() : space_).move(instance));
  std::vector<SpaceQuestion> questions;
  for (const FreeSpace &space : rule.spaces)
    std::ranges::move(asked.of(space), std::back_inserter(questions));
  return questions;
}

/// Not below the height; or straight up, or straight down to where the tool has been, both without tolerance: many
/// small steps aside or down would add up.
SpaceQuestion SpaceClaims::clearanceOf(const SpaceRule &rule, const MoveInstance &instance) const {
  const TermPoint start = space_.point(instance.move.start, instance.point.zero);
  const TermPoint end = space_.point(instance.move.end, instance.point.zero);
  const TermId above =
      store_.logicalAnd(store_.lessOrEqual(*rule.height, start[2]), store_.lessOrEqual(*rule.height, end[2]));
  const TermId cut = store_.add(instance.column,
                                lengthInSpindle_ ? terms_.mostAbove(contract_, entry_) : store_.number(smt::Number(0)));
  const TermId cleared = store_.logicalOr(store_.lessOrEqual(start[2], end[2]), store_.lessOrEqual(cut, end[2]));
  if (std::ranges::any_of(kAllAxes, [&](Axis axis) { return mayMoveBeside(instance, axis); }))
    return {{{{}, above}}};
  const std::array vertical{store_.equal(start[0], end[0]), store_.equal(start[1], end[1]), cleared};
  return {{{{}, store_.logicalOr(above, store_.logicalAnd(vertical))}}};
}

TermId SpaceClaims::keepsLimit(const WordLimit &limit, const MoveInstance &instance) const {
  const SymbolicValue &word = limit.address == 'F' ? instance.move.feed : instance.spindleSpeed;
  TermId kept = store_.logicalNot(word.vacant);
  if (limit.range.low)
    kept = store_.logicalAnd(kept, store_.lessOrEqual(terms_.number(*limit.range.low, entry_, entry_), word.number));
  if (limit.range.high)
    kept = store_.logicalAnd(kept, store_.lessOrEqual(word.number, terms_.number(*limit.range.high, entry_, entry_)));
  return kept;
}

std::vector<TermId> SpaceClaims::startIsOutside() const {
  const auto isGiven = [&](Axis axis) {
    return contract_.start &&
           std::ranges::find(contract_.start->axes, letterOf(axis), &AxisValue::axis) != contract_.start->axes.end();
  };
  if (!contract_.machine || (isGiven(Axis::X) && isGiven(Axis::Y) && isGiven(Axis::Z)))
    return {};
  const std::optional<TermId> longest = terms_.longestBelow(contract_, entry_);
  if (!longest)
    return {};
  const TermPoint start{entry_.at(Axis::X).number, entry_.at(Axis::Y).number,
                        store_.subtract(entry_.at(Axis::Z).number, *longest)};
  std::vector<TermId> outside;
  for (const SpaceRule &rule : rules_)
    if (rule.kind == ObligationKind::KeepOut)
      for (const FreeSpace &space : rule.spaces)
        outside.push_back(space.all(start));
  return outside;
}

std::vector<TermId> SpaceClaims::hints(const SymbolicState &state) const {
  std::array<SymbolicValue, 3> atStart;
  atStart.fill({store_.no(), store_.number(smt::Number(0))});
  const TermPoint point = space_.point(state.position, atStart);
  std::vector<TermId> hints;
  for (const SpaceRule &rule : rules_)
    for (const FreeSpace &space : rule.spaces)
      for (const geometry::Formula &bound : space.bounds) {
        const TermId holds = bound(point);
        const smt::Term &term = store_[holds];
        if (term.kind == smt::TermKind::And)
          hints.insert(hints.end(), term.arguments.begin(), term.arguments.end());
        else
          hints.push_back(holds);
      }
  return hints;
}

} // namespace feedhold::prove
