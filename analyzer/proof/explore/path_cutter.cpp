#include "proof/explore/path_cutter.h"

namespace feedhold::prove {

using smt::TermId;

namespace {
constexpr std::string_view kOpen =
    "cutter compensation where the turn at a corner, the way of a block or its length is "
    "not the same for all arguments";
constexpr std::string_view kAside =
    "cutter compensation of a block that is not along an axis for certain, or of an arc "
    "that begins or ends beside the axes through its centre";
constexpr std::string_view kCrossing = "cutter compensation at a corner beside an arc that is not tangent";
constexpr std::string_view kType = "cutter compensation that begins or ends at an outer corner: its type is not known "
                                   "(parameter 5003#0, the switch `sup`)";
} // namespace

bool PathCutter::undecided(std::string_view why) {
  if (undecided_.empty())
    undecided_ = why;
  return false;
}

bool PathCutter::holds(Truth truth) {
  if (truth.term == store_.yes() || truth.term == store_.no())
    return truth.term == store_.yes();
  if (explored_.proves(truth.term))
    return true;
  return explored_.proves(store_.logicalNot(truth.term)) ? false : undecided(kOpen);
}

bool PathCutter::isOn(Switch setting) { return setting == Switch::Unknown ? undecided(kType) : setting == Switch::On; }

bool PathCutter::isZero(Length length) {
  const TermId isNone = none(length, 0).term;
  return isNone == store_.yes() || (isNone != store_.no() && explored_.proves(isNone));
}

int PathCutter::signOf(Length length) {
  const auto known = [&](Truth truth) {
    return truth.term == store_.yes() || (truth.term != store_.no() && explored_.proves(truth.term));
  };
  if (known(positive(length, 0)))
    return 1;
  return known(negative(length, 0)) ? -1 : 0;
}

/// Of a vector along an axis.
PathCutter::Length PathCutter::magnitude(Vector v) {
  const bool isSecond = isZero(v.first);
  const Length length = isSecond ? v.second : v.first;
  if (!isSecond && !isZero(v.second)) {
    undecided(kAside);
    return length;
  }
  if (isZero(length))
    return {};
  const int sign = signOf(length);
  if (sign == 0)
    undecided(kAside);
  return withSign(sign < 0 ? -1 : 1, length);
}

PathCutter::Vector PathCutter::unit(Vector v) {
  const bool isSecond = isZero(v.first);
  const int sign = isSecond || isZero(v.second) ? signOf(isSecond ? v.second : v.first) : 0;
  if (sign == 0)
    undecided(kAside);
  const Length one = number(sign < 0 ? -1 : 1);
  const Length none = number(0);
  return isSecond ? Vector{none, one} : Vector{one, none};
}

PathCutter::Length PathCutter::least(Length a, Length b) {
  if (!isZero(a - b))
    undecided(kAside);
  return a;
}

CornerTurn PathCutter::turnByAngle(const Element &, const Element &, int) {
  undecided(kCrossing);
  return CornerTurn::None;
}

std::optional<PathCutter::Vector> PathCutter::innerCrossing(const Element &, const Element &,
                                                            const CutterSide<TermLength> &) {
  undecided(kCrossing);
  return std::nullopt;
}

/// With both ends on the spokes of the programmed arc its sweep is that of this arc.
Condition PathCutter::arcReversed(const Element &arc, Vector from, Vector to, Length) {
  if (!isZero(cross(arc.start - arc.centre, from)) || !isZero(cross(arc.end - arc.centre, to)))
    undecided(kCrossing);
  return {store_.no()};
}

std::optional<CutterOffset<TermLength>> PathCutter::offsetOf(Context &, const Value &number) {
  const auto offset = explored_.offsetOf(number);
  if (!offset)
    return std::nullopt;
  return CutterOffset<TermLength>{{store_, offset->radius}, offset->isAssumed, offset->tip};
}

const Move<SymbolicValue> &PathCutter::moveOf(std::size_t index) const { return track_.open.at(index).move; }

void PathCutter::follow(std::size_t index, const std::vector<Move<Value>> &centre,
                        const std::array<TermLength, 3> &tip) {
  auto node = track_.open.extract(index);
  MoveInstance &programmed = node.mapped();
  programmed.point.withoutCompensation.term = track_.rests;
  MoveInstance ofCentre = programmed;
  ofCentre.path = MovePath::Centre;
  ofCentre.radius.reset();
  programmed.path = MovePath::Programmed;
  explored_.record(std::move(programmed));
  for (const Move<Value> &move : centre) {
    ofCentre.move = displaced(move, tip, [this](Value &value, TermLength by) { shift(value, by); });
    explored_.record(ofCentre);
  }
}

void PathCutter::leave(std::size_t index, std::string_view why) {
  auto node = track_.open.extract(index);
  if (node.empty())
    return;
  node.mapped().point.withoutCompensation.term = store_.no();
  node.mapped().whyBeside = why;
  explored_.record(std::move(node.mapped()));
}

bool PathCutter::areInOneSpace(std::size_t a, std::size_t b) const {
  const ToolPoint<SymbolicInterpretation> &first = track_.open.at(a).point;
  const ToolPoint<SymbolicInterpretation> &second = track_.open.at(b).point;
  return first.zero == second.zero && first.sameUnits == second.sameUnits;
}

bool PathCutter::refuses(Truth truth, AlarmKind kind, Place began) {
  if (truth.term == store_.no())
    return false;
  const TermId goesOn = store_.logicalNot(truth.term);
  explored_.claim({.began = began, .goal = goesOn, .alarm = kind});
  if (truth.term == store_.yes() || explored_.proves(truth.term))
    return true;
  track_.rests = store_.logicalAnd(track_.rests, goesOn);
  return false;
}

} // namespace feedhold::prove
