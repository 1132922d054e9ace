// corner-too-large: `X2. ,C3.` from X0, or a next side that is too short.
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

namespace feedhold::rules::corner_too_large {
namespace {

constexpr double kSlack = 0.002; // mm or inch: rounding of the ends

struct Point {
  double first = 0, second = 0;
};
Point operator-(Point a, Point b) { return {a.first - b.first, a.second - b.second}; }
double lengthOf(Point vector) { return std::hypot(vector.first, vector.second); }

struct Side {
  std::optional<Point> start, end;
  bool isStraight = false;
};

class CornerTooLarge final : public FlowRule {
public:
  CornerTooLarge(ProgramId program, const FileContext &context)
      : view_(program, context), asked_(!context.dialect.grammar.oWords),
        isTurning_(context.dialect.machine == MachineKind::Turning) {}

  void before(NodeId node, const AbstractState &state) override {
    if (isAsked(node))
      start_ = pointOf(state);
  }
  void after(NodeId node, const AbstractState &state) override {
    if (!isAsked(node))
      return;
    const Side side{start_, pointOf(state), isStraight(node, state)};
    const auto [at, isNew] = sides_.emplace(node, side);
    if (!isNew && !isSame(at->second, side))
      at->second.isStraight = false;
  }

  void report(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) override {
    for (const auto &[node, side] : sides_) {
      const Word *corner = cornerIn(node);
      const auto next =
          corner && corner->isNumber() && corner->has(Word::kPoint) ? sides_.find(node.next()) : sides_.end();
      if (next == sides_.end() || !side.isStraight || !next->second.isStraight || cornerIn(next->first))
        continue;
      const Point along = *side.end - *side.start;
      const Point away = *next->second.end - *next->second.start;
      const auto needed = neededLength(*corner, along, away);
      if (!needed)
        continue;
      const bool isFirst = lengthOf(along) + kSlack < *needed;
      if (!isFirst && lengthOf(away) + kSlack >= *needed)
        continue;
      reporter.report(
          {.message =
               fmt::format("{} needs {:.4g} of its {} side, which is only {:.4g} long", context.quoted(corner->span()),
                           *needed, isFirst ? "first" : "second", lengthOf(isFirst ? along : away)),
           .span = corner->span(),
           .labels = {{view_.blockSpan(isFirst ? node : next->first), "this side"}},
           .flow = pathFromEntry(facts, node),
           .notes = {context.dialect.hasFanucParameters
                         ? std::string(isFirst ? "the control stops with PS0055 (move shorter than the corner)"
                                               : "the control stops with PS0051 (move behind the corner too short)")
                         : std::string("the control stops with an alarm"),
                     "correct the corner, or the ends of the two moves"}});
    }
  }

private:
  const Word *cornerIn(NodeId node) const {
    if (!view_.mayHave(node, 'C') && !view_.mayHave(node, 'R'))
      return nullptr;
    for (const Word *word : view_.wordsOf(node))
      if (word->has(Word::kComma) && (word->address() == 'C' || word->address() == 'R'))
        return word;
    return nullptr;
  }
  bool isAsked(NodeId node) const {
    return asked_ &&
           (cornerIn(node) || (node > view_.cfg().entryOf(view_.program()) && cornerIn(NodeId(node.index() - 1))));
  }
  std::optional<Point> pointOf(const AbstractState &state) const {
    if (isHavocked(state) || mayBeTrue(state.transformed))
      return std::nullopt;
    const AbstractValue &x = state.at(Axis::X);
    const AbstractValue &other = state.at(isTurning_ ? Axis::Z : Axis::Y);
    const auto first = x.isNumber() ? x.number().constantValue() : std::nullopt;
    const auto second = other.isNumber() ? other.number().constantValue() : std::nullopt;
    return first && second ? std::optional(Point{isTurning_ ? *first / 2 : *first, *second}) : std::nullopt;
  }
  /// In the plane of the corner, along a line.
  bool isStraight(NodeId node, const AbstractState &state) const {
    for (const char letter : {'I', 'J', 'K', 'A'})
      if (view_.mayHave(node, letter))
        return false;
    return start_ && pointOf(state) && !view_.modalMotionWords(node).empty() &&
           view_.surely(state, ModalKind::Motion, {CodeAction::Linear}) &&
           (!view_.modes().groupOf(ModalKind::Plane) || isTurning_ ||
            view_.surely(state, ModalKind::Plane, {CodeAction::PlaneXY}));
  }
  static bool isSame(const Side &a, const Side &b) {
    return a.start && b.start && a.end && b.end && lengthOf(*a.start - *b.start) == 0 && lengthOf(*a.end - *b.end) == 0;
  }
  /// How much of each side the corner takes away; absent where the sides go on straight or turn back.
  static std::optional<double> neededLength(const Word &corner, Point along, Point away) {
    const double product = lengthOf(along) * lengthOf(away);
    if (product == 0)
      return std::nullopt;
    const double cosine = (along.first * away.first + along.second * away.second) / product;
    constexpr double kNearlyStraight = 0.999;
    if (std::abs(cosine) > kNearlyStraight)
      return std::nullopt;
    const double size = corner.number().toDouble();
    return corner.address() == 'C' ? size : size * std::tan(std::acos(cosine) / 2);
  }

  MotionView view_;
  bool asked_;
  bool isTurning_;
  std::optional<Point> start_;
  std::map<NodeId, Side> sides_;
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<CornerTooLarge>(program, context);
}

} // namespace

extern const Rule cornerTooLarge;
const Rule cornerTooLarge{.info = {"corner-too-large", Category::Motion, Severity::Error,
                                   "Reports `,C` or `,R` that needs more than one of its two sides is long."},
                          .hooks = {.watch = watch}};

} // namespace feedhold::rules::corner_too_large
