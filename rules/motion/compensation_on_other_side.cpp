// compensation-on-other-side: `G41` round a contour anticlockwise puts the cutter inside, and it comes from outside.
#include "rules/motion/plane_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <set>
#include <vector>

namespace feedhold::rules::compensation_on_other_side {
namespace {

/// Of the largest extent: the end of a contour that is as near to its start closes it.
constexpr double kClosed = 0.02;
constexpr std::size_t kLeastPoints = 3;

/// Twice the area; above zero for a contour that runs anticlockwise.
double areaOf(const std::vector<PlaneVector> &corners) {
  double area = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const PlaneVector &from = corners[i];
    const PlaneVector &to = corners[(i + 1) % corners.size()];
    area += from[0] * to[1] - to[0] * from[1];
  }
  return area;
}

double extentOf(const std::vector<PlaneVector> &points) {
  double extent = 0;
  for (const std::size_t axis : {0U, 1U}) {
    const auto [least, most] = std::ranges::minmax(points, {}, [&](const PlaneVector &point) { return point[axis]; });
    extent = std::max(extent, most[axis] - least[axis]);
  }
  return extent;
}

double distanceToSide(const PlaneVector &point, const PlaneVector &from, const PlaneVector &to) {
  const PlaneVector side = between(from, to);
  const PlaneVector way = between(from, point);
  const double square = side[0] * side[0] + side[1] * side[1];
  const double part = square > 0 ? std::clamp((way[0] * side[0] + way[1] * side[1]) / square, 0., 1.) : 0.;
  return lengthOf({way[0] - part * side[0], way[1] - part * side[1]});
}

enum class Place : std::uint8_t { Inside, Outside, Near };

/// By the sides that a ray crosses.
Place placeOf(const PlaneVector &point, const std::vector<PlaneVector> &corners, double near) {
  bool isInside = false;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const PlaneVector &from = corners[i];
    const PlaneVector &to = corners[(i + 1) % corners.size()];
    if (distanceToSide(point, from, to) <= near)
      return Place::Near;
    if ((from[1] > point[1]) != (to[1] > point[1]) &&
        point[0] < from[0] + (point[1] - from[1]) / (to[1] - from[1]) * (to[0] - from[0]))
      isInside = !isInside;
  }
  return isInside ? Place::Inside : Place::Outside;
}

/// What is programmed with one G41 or G42: the point before it, and behind it those of the moves in the plane.
struct Section {
  NodeId code;
  bool isLeft;
  std::vector<PlaneVector> points;
};

/// The closed part of it, and the points that lead there and away.
struct ClosedContour {
  std::vector<PlaneVector> corners;
  std::vector<PlaneVector> leads;
};

std::optional<ClosedContour> closedIn(const Section &section) {
  const auto &points = section.points;
  if (points.size() < kLeastPoints + 2)
    return std::nullopt;
  const double near = kClosed * extentOf(points);
  for (std::size_t length = points.size() - 1; length >= kLeastPoints; --length)
    for (std::size_t first = 1; first + length < points.size(); ++first)
      if (lengthOf(between(points[first], points[first + length])) <= near) {
        const auto at = [&](std::size_t index) { return points.begin() + static_cast<std::ptrdiff_t>(index); };
        ClosedContour contour{{at(first), at(first + length)}, {points.begin(), at(first)}};
        contour.leads.insert(contour.leads.end(), at(first + length + 1), points.end());
        return contour;
      }
  return std::nullopt;
}

class CompensationOnOtherSide final : public FlowRule {
public:
  CompensationOnOtherSide(ProgramId program, const FileContext &context)
      : view_(program, context), isAsked_(context.dialect.machine == MachineKind::Milling) {}

  void before(NodeId, const AbstractState &state) override {
    start_ = isAsked_ && isInUsualPlane(view_, state) ? pointOf(view_, state) : std::nullopt;
  }
  void after(NodeId node, const AbstractState &state) override {
    if (!isAsked_)
      return;
    const bool isLeft = view_.surely(state, ModalKind::Compensation, {CodeAction::CompensationLeft});
    const bool isRight = view_.surely(state, ModalKind::Compensation, {CodeAction::CompensationRight});
    if (view_.findAction(node, {CodeAction::CompensationLeft, CodeAction::CompensationRight}) && (isLeft || isRight) &&
        !section_)
      section_ = Section{node, isLeft, {}};
    if (!section_)
      return;
    const bool isOver = !isLeft && !isRight;
    if (mayLeaveContour(node) || !follow(node, state)) {
      cleared_.insert(section_->code);
      section_ = std::nullopt;
    } else if (isOver) {
      judge(*section_);
      section_ = std::nullopt;
    }
  }

  void report(const FlowFacts &, const FileContext &context, const Reporter &reporter) override {
    for (const auto &[node, isLeft] : found_)
      if (!cleared_.contains(node))
        tell(node, isLeft, context, reporter);
  }

private:
  /// A movement of another axis, a call or a jump: the cutter may have come to the contour in the air.
  bool mayLeaveContour(NodeId node) const {
    const bool movesOther =
        view_.mayHave(node, 'Z') || view_.mayHave(node, 'A') || view_.mayHave(node, 'B') || view_.mayHave(node, 'C');
    return !std::holds_alternative<ExecuteWords>(view_.node(node).instruction) ||
           (movesOther && !view_.axisWords(node).empty());
  }
  /// False: the way is not known.
  bool follow(NodeId node, const AbstractState &state) {
    const bool moves =
        view_.mayHave(node, 'X') || view_.mayHave(node, 'Y') || view_.mayHave(node, 'I') || view_.mayHave(node, 'J');
    if (!moves)
      return true;
    const auto end = isInUsualPlane(view_, state) ? pointOf(view_, state) : std::nullopt;
    if (!start_ || !end || view_.modalMotionWords(node).empty())
      return false;
    if (section_->points.empty())
      section_->points.push_back(*start_);
    if (view_.surely(state, ModalKind::Motion, {CodeAction::Linear, CodeAction::Rapid})) {
      section_->points.push_back(*end);
      return true;
    }
    const auto middle = middleOfArc(node, state, *end);
    if (middle) {
      section_->points.push_back(*middle);
      section_->points.push_back(*end);
    }
    return middle.has_value();
  }
  std::optional<PlaneVector> middleOfArc(NodeId node, const AbstractState &state, const PlaneVector &end) const {
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
  std::optional<PlaneVector> middleByRadius(NodeId node, double side, const PlaneVector &end) const {
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

  /// The cutter stands on one side of the contour, and comes from the other one.
  void judge(const Section &section) {
    const auto contour = closedIn(section);
    const double area = contour ? areaOf(contour->corners) : 0;
    if (area == 0)
      return void(cleared_.insert(section.code));
    const bool isInside = (area > 0) == section.isLeft;
    const double near = kClosed * extentOf(contour->corners);
    const auto isOnOther = [&](const PlaneVector &point) {
      return placeOf(point, contour->corners, near) == (isInside ? Place::Outside : Place::Inside);
    };
    if (!contour->leads.empty() && std::ranges::all_of(contour->leads, isOnOther))
      found_.emplace(section.code, section.isLeft);
    else
      cleared_.insert(section.code);
    isInside_[section.code] = isInside;
  }

  void tell(NodeId node, bool isLeft, const FileContext &context, const Reporter &reporter) const {
    const Word *code = view_.findAction(node, {CodeAction::CompensationLeft, CodeAction::CompensationRight});
    const bool isInside = isInside_.at(node);
    reporter.report(
        {.message = fmt::format("{} puts the cutter {} the contour, but it comes from {}", context.quoted(code->span()),
                                isInside ? "inside" : "outside", isInside ? "outside" : "inside"),
         .span = code->span(),
         .notes = {fmt::format("the contour runs {}: the cutter crosses it on its way there and cuts into "
                               "the part",
                               isLeft == isInside ? "anticlockwise" : "clockwise"),
                   fmt::format("write `{}`, or turn the contour round", isLeft ? "G42" : "G41")}});
  }

  MotionView view_;
  bool isAsked_;
  std::optional<PlaneVector> start_; // of the node that is being executed
  std::optional<Section> section_;
  std::map<NodeId, bool> found_; // by the node of the code: G41
  std::map<NodeId, bool> isInside_;
  std::set<NodeId> cleared_; // by another run through the section
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<CompensationOnOtherSide>(program, context);
}

} // namespace

extern const Rule compensationOnOtherSide;
const Rule compensationOnOtherSide{
    .info =
        {"compensation-on-other-side", Category::Motion, Severity::Warning,
         "Reports `G41` or `G42` round a closed contour that puts the cutter on one side of it, while it comes from "
         "the other side."},
    .hooks = {.watch = watch}};

} // namespace feedhold::rules::compensation_on_other_side
