// See the header.
#include "rules/motion/compensated_way.h"

#include <algorithm>
#include <numbers>

namespace feedhold::rules {
namespace {

constexpr std::initializer_list<CodeAction> kStarts = {CodeAction::CompensationLeft, CodeAction::CompensationRight};
/// Of the largest extent: what is as near is the same corner, calculated twice.
constexpr double kSame = 0.001;
/// Longer ways are not judged: each end is compared with all that is before it.
constexpr std::size_t kMostStretches = 1000;

double distanceTo(const Stretch &stretch, const PlaneVector &point) {
  return stretch.middle ? std::min(distanceToSide(point, stretch.from, *stretch.middle),
                                   distanceToSide(point, *stretch.middle, stretch.to))
                        : distanceToSide(point, stretch.from, stretch.to);
}

} // namespace

double turnBetween(const PlaneVector &first, const PlaneVector &second) {
  return std::atan2(first[0] * second[1] - first[1] * second[0], first[0] * second[0] + first[1] * second[1]);
}

double distanceToSide(const PlaneVector &point, const PlaneVector &from, const PlaneVector &to) {
  const PlaneVector side = between(from, to);
  const PlaneVector way = between(from, point);
  const double square = side[0] * side[0] + side[1] * side[1];
  const double part = square > 0 ? std::clamp((way[0] * side[0] + way[1] * side[1]) / square, 0., 1.) : 0.;
  return lengthOf({way[0] - part * side[0], way[1] - part * side[1]});
}

double extentOf(const std::vector<PlaneVector> &points) {
  double extent = 0;
  for (const std::size_t axis : {0U, 1U}) {
    const auto [least, most] = std::ranges::minmax(points, {}, [&](const PlaneVector &point) { return point[axis]; });
    extent = std::max(extent, most[axis] - least[axis]);
  }
  return extent;
}

std::span<const Stretch> CompensatedWay::contour() const {
  const std::size_t leads = endsInMove ? 2 : 1;
  return stretches.size() > leads ? std::span(stretches).subspan(1, stretches.size() - leads)
                                  : std::span<const Stretch>();
}

std::vector<PlaneVector> CompensatedWay::points() const {
  std::vector<PlaneVector> points;
  if (!stretches.empty())
    points.push_back(stretches.front().from);
  for (const Stretch &stretch : stretches) {
    if (stretch.middle)
      points.push_back(*stretch.middle);
    points.push_back(stretch.to);
  }
  return points;
}

double CompensatedWay::near() const { return stretches.empty() ? 0 : kSame * extentOf(points()); }

bool CompensatedWay::comesBack(std::size_t index, double near) const {
  const PlaneVector &end = stretches[index].to;
  return lengthOf(between(stretches[index].from, end)) <= near ||
         std::ranges::any_of(std::span(stretches).first(index - 1),
                             [&](const Stretch &each) { return distanceTo(each, end) <= near; });
}

std::span<const Stretch> CompensatedWay::loopTo(const PlaneVector &point) const {
  const auto edges = contour();
  const double same = near();
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (lengthOf(between(edges[i].to, point)) <= same)
      return edges.first(i + 1);
    if (comesBack(i + 1, same))
      break;
  }
  return {};
}

bool CompensatedWay::isOpen() const {
  const double same = near();
  for (std::size_t i = 1; i <= contour().size(); ++i)
    if (comesBack(i, same))
      return false;
  return true;
}

void CompensatedWayRule::before(NodeId, const AbstractState &state) {
  start_ = isAsked_ && isInUsualPlane(view_, state) ? pointOf(view_, state) : std::nullopt;
}

void CompensatedWayRule::after(NodeId node, const AbstractState &state) {
  if (!isAsked_)
    return;
  const bool isLeft = view_.surely(state, ModalKind::Compensation, {CodeAction::CompensationLeft});
  const bool isRight = view_.surely(state, ModalKind::Compensation, {CodeAction::CompensationRight});
  if (!way_ && view_.findAction(node, kStarts) && (isLeft || isRight))
    way_ = CompensatedWay{node, isLeft, {}};
  if (!way_)
    return;
  const std::size_t before = way_->stretches.size();
  if (mayLeaveContour(node) || !follow(node, state)) {
    cleared_.insert(way_->code);
    way_ = std::nullopt;
  } else if (!isLeft && !isRight) {
    way_->endsInMove = way_->stretches.size() > before;
    judge();
  }
}

void CompensatedWayRule::report(const FlowFacts &, const FileContext &context, const Reporter &reporter) {
  for (const auto &[node, way] : wrong_)
    if (!cleared_.contains(node))
      tell(way, context, reporter);
}

Span CompensatedWayRule::codeOf(const CompensatedWay &way) const { return view_.findAction(way.code, kStarts)->span(); }

/// A movement of another axis, a call or a jump: the cutter may have come to the contour in the air.
bool CompensatedWayRule::mayLeaveContour(NodeId node) const {
  const bool movesOther =
      view_.mayHave(node, 'Z') || view_.mayHave(node, 'A') || view_.mayHave(node, 'B') || view_.mayHave(node, 'C');
  return !std::holds_alternative<ExecuteWords>(view_.node(node).instruction) ||
         (movesOther && !view_.axisWords(node).empty());
}

/// False: the way is not known.
bool CompensatedWayRule::follow(NodeId node, const AbstractState &state) {
  const bool moves =
      view_.mayHave(node, 'X') || view_.mayHave(node, 'Y') || view_.mayHave(node, 'I') || view_.mayHave(node, 'J');
  if (!moves)
    return true;
  const auto end = isInUsualPlane(view_, state) ? pointOf(view_, state) : std::nullopt;
  if (!start_ || !end || view_.modalMotionWords(node).empty())
    return false;
  const auto stretch = stretchOf(node, state, *end);
  if (!stretch || way_->stretches.size() == kMostStretches)
    return false;
  way_->stretches.push_back(*stretch);
  return true;
}

std::optional<Stretch> CompensatedWayRule::stretchOf(NodeId node, const AbstractState &state,
                                                     const PlaneVector &end) const {
  if (view_.surely(state, ModalKind::Motion, {CodeAction::Linear, CodeAction::Rapid}))
    return Stretch{node, *start_, end, {}, view_.mayBe(state, ModalKind::Motion, {CodeAction::Rapid})};
  const auto middle = middleOfArc(node, state, end);
  return middle ? std::optional(Stretch{node, *start_, end, middle, false}) : std::nullopt;
}

std::optional<PlaneVector> CompensatedWayRule::middleOfArc(NodeId node, const AbstractState &state,
                                                           const PlaneVector &end) const {
  const bool clockwise = view_.surely(state, ModalKind::Motion, {CodeAction::ArcClockwise});
  const bool isArc = clockwise || view_.surely(state, ModalKind::Motion, {CodeAction::ArcCounterclockwise});
  const double side = clockwise ? -1 : 1;
  if (!isArc || !countsFromStart(view_, state) || view_.mayHave(node, 'P') || view_.mayHave(node, 'K'))
    return std::nullopt;
  if (view_.mayHave(node, 'R'))
    return middleByRadius(node, side, end);
  const auto i = distanceIn(view_, node, 'I');
  const auto j = distanceIn(view_, node, 'J');
  if (!i || !j)
    return std::nullopt;
  const PlaneVector centre{(*start_)[0] + *i, (*start_)[1] + *j};
  const PlaneVector from = between(centre, *start_);
  const PlaneVector to = between(centre, end);
  double sweep = side * (std::atan2(to[1], to[0]) - std::atan2(from[1], from[0]));
  sweep = sweep <= 0 ? sweep + 2 * std::numbers::pi : sweep;
  const double angle = std::atan2(from[1], from[0]) + side * sweep / 2;
  const double radius = lengthOf(from);
  return PlaneVector{centre[0] + radius * std::cos(angle), centre[1] + radius * std::sin(angle)};
}

/// R below zero takes the longer way.
std::optional<PlaneVector> CompensatedWayRule::middleByRadius(NodeId node, double side, const PlaneVector &end) const {
  const auto radius = distanceIn(view_, node, 'R');
  const PlaneVector chord = between(*start_, end);
  const double half = lengthOf(chord) / 2;
  if (!radius || half == 0 || std::abs(*radius) < half)
    return std::nullopt;
  const double rest = std::sqrt(*radius * *radius - half * half);
  const double height = std::abs(*radius) - (*radius > 0 ? rest : -rest);
  return PlaneVector{((*start_)[0] + end[0]) / 2 + side * chord[1] / (2 * half) * height,
                     ((*start_)[1] + end[1]) / 2 - side * chord[0] / (2 * half) * height};
}

void CompensatedWayRule::judge() {
  const NodeId code = way_->code;
  if (isWrong(*way_))
    wrong_.emplace(code, std::move(*way_));
  else
    cleared_.insert(code);
  way_ = std::nullopt;
}

} // namespace feedhold::rules
