// arc-in-wrong-direction: a `G02` round a corner where `G03` is meant: three quarters of a circle instead of one.
#include "rules/motion/plane_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace feedhold::rules::arc_in_wrong_direction {
namespace {

using Vector = PlaneVector;

/// 1: the same direction, -1: straight back.
double cosine(const Vector &a, const Vector &b) { return (a[0] * b[0] + a[1] * b[1]) / (lengthOf(a) * lengthOf(b)); }
constexpr double kBack = -0.998; // within some 3.5 degrees
constexpr double kShort = 1e-4;

constexpr std::size_t kBeginning = 4; // moves
constexpr double kHalf = 181;         // degrees; nearly half a circle may be one

/// A move in the plane between points that are numbers.
struct Move {
  NodeId node;
  Vector start;
  Vector end;
  Vector first; // direction in which it begins
  Vector last;  // direction in which it ends
};
struct Arc {
  Move move;
  double sweep; // in degrees
};

/// The second begins where the first ends, and goes back the way that it came.
bool turnsBack(const Move &first, const Move &second) {
  return lengthOf(between(first.end, second.start)) < kShort && cosine(first.last, second.first) < kBack;
}

class ArcInWrongDirection final : public FlowRule {
public:
  ArcInWrongDirection(ProgramId program, const FileContext &context)
      : view_(program, context), isTurning_(context.dialect.machine == MachineKind::Turning), isAsked_(hasArcs()) {}

  void before(NodeId node, const AbstractState &state) override {
    start_ = isAsked_ && movesInPlane(node) && isInUsualPlane(view_, state) ? pointOf(view_, state) : std::nullopt;
  }
  void after(NodeId node, const AbstractState &state) override {
    if (!isAsked_ || !std::holds_alternative<ExecuteWords>(view_.node(node).instruction))
      return forget();
    if (!movesInPlane(node)) {
      if (movesElsewhere(node)) {
        judgeClosing();
        forget();
      }
      return;
    }
    const auto end = isInUsualPlane(view_, state) ? pointOf(view_, state) : std::nullopt;
    const auto arc = start_ && end ? arcFrom(node, state, *end) : std::nullopt;
    const auto move = arc ? std::optional(arc->move) : start_ && end ? lineTo(node, state, *end) : std::nullopt;
    judge(move);
    pending_ = arc && arc->sweep > kHalf && last_ && turnsBack(*last_, arc->move) ? arc : std::nullopt;
    last_ = move;
    if (!move)
      beginning_.clear();
    else if (beginning_.size() < kBeginning)
      beginning_.push_back(*move);
  }

  void report(const FlowFacts &, const FileContext &context, const Reporter &reporter) override {
    for (const auto &[node, sweep] : found_)
      if (!cleared_.contains(node))
        tell(node, sweep, context, reporter);
  }

private:
  bool mayHaveAny(NodeId node, std::string_view letters) const {
    return std::ranges::any_of(letters, [&](char letter) { return view_.mayHave(node, letter); });
  }
  bool hasArcs() const {
    const auto isArc = [&](NodeId node) { return mayHaveAny(node, isTurning_ ? "KI" : "IJ"); };
    for (NodeId node(0); node.index() < view_.cfg().nodes.size(); node = node.next())
      if (isArc(node))
        return true;
    return false;
  }
  void forget() {
    last_ = std::nullopt;
    pending_ = std::nullopt;
    beginning_.clear();
  }
  /// A tool path has a million blocks: few questions need a look at the words.
  bool movesInPlane(NodeId node) const {
    if (!mayHaveAny(node, isTurning_ ? "XZUW" : "XY"))
      return false;
    return !view_.mayHave(node, 'G') ||
           view_.mayDo(node, {CodeAction::Linear, CodeAction::ArcClockwise, CodeAction::ArcCounterclockwise}) ||
           !view_.modalMotionWords(node).empty();
  }
  bool movesElsewhere(NodeId node) const { return mayHaveAny(node, isTurning_ ? "XYZUVWCHIJKG" : "XYZIJG"); }
  /// `move` follows the arc that waits for it.
  void judge(const std::optional<Move> &move) {
    if (!pending_)
      return;
    const NodeId node = pending_->move.node;
    if (move && turnsBack(pending_->move, *move))
      found_.emplace(node, pending_->sweep);
    else
      cleared_.insert(node);
    pending_ = std::nullopt;
  }
  /// The arc that waits is the last of a contour, and joins the move with which the contour began.
  void judgeClosing() {
    if (pending_ && std::ranges::any_of(beginning_, [&](const Move &move) { return turnsBack(pending_->move, move); }))
      found_.emplace(pending_->move.node, pending_->sweep);
  }
  std::optional<Move> lineTo(NodeId node, const AbstractState &state, const Vector &end) const {
    const Vector way = between(*start_, end);
    if (!view_.surely(state, ModalKind::Motion, {CodeAction::Linear}) || lengthOf(way) < kShort)
      return std::nullopt;
    return Move{node, *start_, end, way, way};
  }
  std::optional<Arc> arcFrom(NodeId node, const AbstractState &state, const Vector &end) const {
    const bool clockwise = view_.surely(state, ModalKind::Motion, {CodeAction::ArcClockwise});
    const bool isArc = clockwise || view_.surely(state, ModalKind::Motion, {CodeAction::ArcCounterclockwise});
    if (!isArc || !countsFromStart(view_, state) || mayHaveAny(node, "RP") || view_.namesOtherPlane(node))
      return std::nullopt;
    const auto first = distanceIn(view_, node, view_.usualPlane().firstCentre);
    const auto second = distanceIn(view_, node, view_.usualPlane().secondCentre);
    if (!first || !second)
      return std::nullopt;
    const Vector centre{(*start_)[0] + *first, (*start_)[1] + *second};
    const Vector from = between(centre, *start_);
    const Vector to = between(centre, end);
    const double radius = lengthOf(from);
    if (radius < kShort || std::abs(lengthOf(to) - radius) > radius / 100 || lengthOf(between(*start_, end)) < kShort)
      return std::nullopt;
    const double side = clockwise ? -1 : 1;
    double sweep = side * (std::atan2(to[1], to[0]) - std::atan2(from[1], from[0])) * 180 / std::numbers::pi;
    sweep = sweep < 0 ? sweep + 360 : sweep;
    return Arc{{node, *start_, end, {-side * from[1], side * from[0]}, {-side * to[1], side * to[0]}}, sweep};
  }
  void tell(NodeId node, double sweep, const FileContext &context, const Reporter &reporter) const {
    const Word *code = view_.findAction(node, {CodeAction::ArcClockwise, CodeAction::ArcCounterclockwise});
    const Code *its = code ? codeOf(*code, context.dialect) : nullptr;
    const bool isClockwise = its && its->action == CodeAction::ArcClockwise;
    Diagnostic diagnostic{
        .message =
            fmt::format("this arc runs {:.0f} degrees the long way round, and turns back sharply at both ends", sweep),
        .span = view_.blockSpan(node),
        .notes = {
            fmt::format("in the other direction the same words make an arc of {:.0f} degrees that joins the moves "
                        "before and behind it smoothly",
                        360 - sweep)}};
    if (its) {
      const std::string other = isClockwise ? "G03" : "G02";
      diagnostic.notes.push_back(fmt::format("write `{}` if the corner is meant", other));
      diagnostic.fixes = {{.title = fmt::format("write `{}`", other), .edits = {{code->span(), other}}}};
    }
    reporter.report(std::move(diagnostic));
  }

  MotionView view_;
  bool isTurning_;
  bool isAsked_;
  std::optional<Vector> start_;
  std::optional<Move> last_;
  std::optional<Arc> pending_;
  std::vector<Move> beginning_; // of the contour: the approach and the first moves
  std::map<NodeId, double> found_;
  std::set<NodeId> cleared_; // by another run through the block
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<ArcInWrongDirection>(program, context);
}

} // namespace

extern const Rule arcInWrongDirection;
const Rule arcInWrongDirection{
    .info = {"arc-in-wrong-direction", Category::Motion, Severity::Warning,
             "Reports an arc of more than half a circle that would join its neighbours smoothly in the other "
             "direction."},
    .hooks = {.watch = watch}};

} // namespace feedhold::rules::arc_in_wrong_direction
