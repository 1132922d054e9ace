#include "proof/geometry/gouge_path.h"

#include <cmath>
#include <numbers>

namespace feedhold::geometry {

namespace {

constexpr double kFullCircle = 2 * std::numbers::pi;
/// An arc whose ends are nearer than any control tells apart is a full circle.
constexpr double kSamePoint = 1e-7;

} // namespace

GougePath::GougePath(const RecordedMove &recorded) {
  double square = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    start_[i] = recorded.move.start[i].number + recorded.zero[i];
    end_[i] = recorded.move.end[i].number + recorded.zero[i];
    square += (end_[i] - start_[i]) * (end_[i] - start_[i]);
  }
  length_ = std::sqrt(square);
  if (recorded.move.kind == MoveKind::ArcClockwise || recorded.move.kind == MoveKind::ArcCounterclockwise)
    bend(recorded);
}

void GougePath::bend(const RecordedMove &recorded) {
  const auto &move = recorded.move;
  Arc arc{};
  arc.first = indexOf(move.plane.first);
  arc.second = indexOf(move.plane.second);
  arc.centre = {move.firstCentre.number + recorded.zero[arc.first],
                move.secondCentre.number + recorded.zero[arc.second]};
  const auto spoke = [&](const Point<double> &point) {
    return std::array{point[arc.first] - arc.centre[0], point[arc.second] - arc.centre[1]};
  };
  const auto from = spoke(start_);
  const auto to = spoke(end_);
  arc.startAngle = std::atan2(from[1], from[0]);
  arc.startRadius = std::hypot(from[0], from[1]);
  arc.endRadius = std::hypot(to[0], to[1]);
  const bool isClockwise = move.kind == MoveKind::ArcClockwise;
  double turn = std::atan2(to[1], to[0]) - arc.startAngle;
  if (isClockwise)
    turn = -turn;
  if (turn < 0)
    turn += kFullCircle;
  if (std::hypot(to[0] - from[0], to[1] - from[1]) < kSamePoint)
    turn = kFullCircle;
  turn += kFullCircle * (move.turns - 1.0);
  arc.sweep = isClockwise ? -turn : turn;
  const std::size_t normal = indexOf(move.plane.normal);
  const double radius = std::max(arc.startRadius, arc.endRadius);
  length_ = turn * radius + std::abs(arc.endRadius - arc.startRadius) + std::abs(end_[normal] - start_[normal]);
  arc_ = arc;
}

std::size_t GougePath::rounds() const {
  return arc_
             ? std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(std::abs(arc_->sweep) / kFullCircle - 1e-9)))
             : 1;
}

Point<double> GougePath::at(double share) const {
  if (share <= 0)
    return start_;
  if (share >= 1)
    return end_;
  Point<double> point;
  for (std::size_t i = 0; i < 3; ++i)
    point[i] = start_[i] + share * (end_[i] - start_[i]);
  if (arc_) {
    // Ends that are not equally far from the centre, within the control's tolerance, are joined by a spiral.
    const double radius = arc_->startRadius + share * (arc_->endRadius - arc_->startRadius);
    const double angle = arc_->startAngle + share * arc_->sweep;
    point[arc_->first] = arc_->centre[0] + radius * std::cos(angle);
    point[arc_->second] = arc_->centre[1] + radius * std::sin(angle);
  }
  return point;
}

std::vector<double> GougePath::extremes() const {
  std::vector<double> shares = {0, 1};
  if (!arc_ || arc_->sweep == 0)
    return shares;
  constexpr double kQuarter = std::numbers::pi / 2;
  const double turn = std::abs(arc_->sweep) / kQuarter;
  const double begin = (arc_->sweep > 0 ? arc_->startAngle : -arc_->startAngle) / kQuarter;
  for (double next = std::floor(begin) + 1; next < begin + std::min(turn, 4.0); ++next)
    shares.push_back((next - begin) / turn);
  for (double last = std::ceil(begin + turn) - 1; turn > 4 && last > begin + turn - 4; --last)
    shares.push_back((last - begin) / turn);
  return shares;
}

} // namespace feedhold::geometry
