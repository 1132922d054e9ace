#include "proof/explore/path_cutter.h"

#include "proof/smt/ground_truth.h"

namespace feedhold::prove {

using smt::Number;
using smt::TermId;

namespace {
constexpr std::string_view kOpen =
    "cutter compensation where the turn at a corner, the way of a block or its length is "
    "not the same for all arguments";
constexpr std::string_view kAside =
    "cutter compensation of a block, or of an end of an arc, whose direction is not the same "
    "for all arguments";
constexpr std::string_view kCrossing = "cutter compensation at a corner beside an arc that is not tangent";
constexpr std::string_view kSmallTurn = "cutter compensation at a corner whose turn is perhaps so small that the "
                                        "interpreter takes it for none";
constexpr std::string_view kType = "cutter compensation that begins or ends at an outer corner: its type is not known "
                                   "(parameter 5003#0, the switch `sup`)";
} // namespace

bool PathCutter::undecided(std::string_view why) {
  if (undecided_.empty())
    undecided_ = why;
  return false;
}

/// A condition on roots alone is enclosed.
bool PathCutter::proves(TermId truth) {
  if (truth == store_.yes() || truth == store_.no())
    return truth == store_.yes();
  const auto known = smt::GroundTruth(store_).of(truth);
  return known ? *known : explored_.proves(truth);
}

bool PathCutter::holds(Truth truth) {
  if (proves(truth.term))
    return true;
  return proves(store_.logicalNot(truth.term)) ? false : undecided(kOpen);
}

bool PathCutter::isOn(Switch setting) { return setting == Switch::Unknown ? undecided(kType) : setting == Switch::On; }

bool PathCutter::isZero(Length length) { return proves(none(length, 0).term); }

int PathCutter::strictSignOf(Length length) {
  if (proves(positive(length, 0).term))
    return 1;
  return proves(negative(length, 0).term) ? -1 : 0;
}

/// One that may be 0 or above it has corners like one of either sign.
std::optional<int> PathCutter::signOf(Length offset) {
  const int sign = isZero(offset) ? 1 : strictSignOf(offset);
  return sign == 0 ? std::nullopt : std::optional(sign);
}

/// By the form of the terms, or by what the path says of them: along an axis, or by half a right angle.
std::optional<geometry::Slope> PathCutter::slopeOf(Vector v) {
  std::optional<geometry::Slope> slope;
  if (isZero(v.first))
    slope = geometry::Slope{0, 1, term(v.second)};
  else if (isZero(v.second))
    slope = geometry::Slope{1, 0, term(v.first)};
  else
    slope = geometry::slopeOf(store_, term(v.first), term(v.second));
  for (const int second : {1, -1})
    if (!slope && isZero(second > 0 ? v.first - v.second : v.first + v.second))
      slope = geometry::Slope{1, second, term(v.first)};
  const int sign = slope ? strictSignOf({store_, slope->times}) : 0;
  if (sign == 0)
    return std::nullopt;
  return sign > 0 ? slope : geometry::Slope{-slope->first, -slope->second, store_.negate(slope->times)};
}

PathCutter::Length PathCutter::magnitude(Vector v) {
  if (isZero(v.first) && isZero(v.second))
    return {};
  const auto slope = slopeOf(v);
  if (!slope) {
    undecided(kAside);
    return v.first;
  }
  return Length(store_, slope->times) * lengthOf(*slope);
}

PathCutter::Vector PathCutter::unit(Vector v) {
  const auto slope = slopeOf(v);
  if (!slope) {
    undecided(kAside);
    return {number(1), number(0)};
  }
  const Number square = slope->first * slope->first + slope->second * slope->second;
  const auto part = [&](const Number &of) { return Length(store_, store_.scale(of / square, term(lengthOf(*slope)))); };
  return {part(slope->first), part(slope->second)};
}

/// Both lines are `v . n = radius |n|`, with whole numbers for the normals: by Cramer's rule the crossing has no root
/// in a divisor.
PathCutter::Vector PathCutter::crossing(Vector n, Vector m, Length radius) {
  const auto a = slopeOf(n), b = slopeOf(m);
  const Number determinant = a && b ? a->first * b->second - a->second * b->first : Number(0);
  if (determinant.isZero()) {
    undecided(kAside);
    return {};
  }
  const TermId ofA = term(radius * lengthOf(*a)), ofB = term(radius * lengthOf(*b));
  const auto crossed = [&](const Number &factorOfA, const Number &factorOfB) {
    return Length(store_,
                  store_.add(store_.scale(factorOfA / determinant, ofA), store_.scale(factorOfB / determinant, ofB)));
  };
  return {crossed(b->second, -a->second), crossed(-b->first, a->first)};
}

PathCutter::Length PathCutter::least(Length a, Length b) {
  if (!isZero(a - b))
    undecided(kAside);
  return a;
}

/// A turn is at least as large as its sine, in radians: one of 0.05 is none to the interpreter, and one that misses the
/// way back by less goes round the outside (RunCutter).
CornerTurn PathCutter::turnByAngle(const Element &before, const Element &behind, int side) {
  const Length sine = withSign(side, cross(before.endDirection, behind.startDirection));
  const Length least = number(0.05);
  if (proves(positive(sine - least, 0).term))
    return CornerTurn::Inner;
  if (proves(negative(sine + least, 0).term))
    return CornerTurn::Outer;
  if (!isZero(sine) || !proves(positive(dot(before.endDirection, behind.startDirection), 0).term))
    undecided(kSmallTurn);
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
  if (offset && !offset->why.empty())
    whyNoOffset_ = offset->why;
  if (!offset || !offset->why.empty())
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
