// arc-radius-too-small: `R4.` between points that are 10 apart, or R half of a distance that is a variable.
#include "rules/flow/straight_path.h"
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>

namespace feedhold::rules::arc_radius_too_small {
namespace {

class ArcRadiusTooSmall final : public FlowRule {
public:
  ArcRadiusTooSmall(ProgramId program, const FileContext &context) : view_(program, context) {}

  void before(NodeId node, const AbstractState &state) override {
    if (!view_.mayHave(node, 'R'))
      return;
    if (mayBeTrue(state.transformed) || isHavocked(state) || !state.modalCalls.empty())
      unclear_.insert(node);
    for (const Axis axis : kAllAxes)
      start_[indexOf(axis)] = placeOf(state, axis);
  }
  void after(NodeId node, const AbstractState &state) override {
    if (!view_.mayHave(node, 'R') || mayBeTrue(state.transformed) || isHavocked(state) || !state.modalCalls.empty() ||
        !view_.surely(state, ModalKind::Motion, {CodeAction::ArcClockwise, CodeAction::ArcCounterclockwise}) ||
        view_.modalMotionWords(node).empty() || view_.namesOtherPlane(node) || view_.choseOtherPlane(state))
      return;
    const Word *radius = wordOf(node, 'R');
    if (!radius)
      return;
    const bool isIncremental = view_.surely(state, ModalKind::Distance, {CodeAction::Incremental});
    bool &inAll = incremental_.try_emplace(node, true).first->second;
    inAll = inAll && isIncremental;
    const auto chord = chordOf(node, state);
    const bool isNew = radii_.emplace(node, radius).second;
    chords_[node] = !chord || (!isNew && !chords_[node]) ? std::nullopt
                    : isNew                              ? chord
                                                         : std::optional(std::min(*chords_[node], *chord));
  }

  void report(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) override {
    // In a plane that is known the run ends here, and nothing comes after the block.
    for (const AlarmFact &alarm : facts.alarms())
      if (alarm.kind == AlarmKind::ArcTooShort && alarm.always && !unclear_.contains(alarm.node))
        if (const Word *radius = wordOf(alarm.node, 'R'); radius && !radii_.contains(alarm.node))
          tellTooSmall(facts, alarm.node, *radius, context, reporter);
    for (const auto &[node, radius] : radii_) {
      if (isTooSmall(facts, node, *radius)) {
        tellTooSmall(facts, node, *radius, context, reporter);
        continue;
      }
      if (isHalfOfVariable(facts, node, *radius))
        tellHalf(*radius, context, reporter);
    }
  }

private:
  static std::optional<double> placeOf(const AbstractState &state, Axis axis) {
    const AbstractValue &coordinate = state.at(axis);
    return coordinate.isNumber() ? coordinate.number().constantValue() : std::nullopt;
  }
  /// The only word of the address.
  const Word *wordOf(NodeId node, char address) const {
    const Word *found = nullptr;
    for (const Word *word : view_.wordsOf(node))
      if (word->address() == address && !word->has(Word::kComma)) {
        if (found)
          return nullptr;
        found = word;
      }
    return found;
  }
  /// In every state the chord is at least this long.
  std::optional<double> chordOf(NodeId node, const AbstractState &state) const {
    const Plane plane = view_.usualPlane();
    const auto first = distanceAlong(plane.first, node, state);
    const auto second = distanceAlong(plane.second, node, state);
    return first && second ? std::optional(std::hypot(*first, *second)) : std::nullopt;
  }
  bool isTooSmall(const FlowFacts &facts, NodeId node, const Word &radius) const {
    const AbstractValue *computed =
        radius.form() == WordForm::Expression ? facts.valueOf(radius.expression()) : nullptr;
    const auto value = radius.isNumber()                  ? std::optional(radius.number().toDouble())
                       : computed && computed->isNumber() ? computed->number().constantValue()
                                                          : std::nullopt;
    const auto &chord = chords_.at(node);
    // In inches the tolerance is a smaller number; which units are in force need not be known.
    return value && chord && *chord > 2 * std::abs(*value) + 2 * view_.context().dialect.behaviour.arcTolerance;
  }
  std::optional<double> distanceAlong(Axis axis, NodeId node, const AbstractState &state) const {
    const auto end = placeOf(state, axis);
    if (const auto start = start_[indexOf(axis)]; start && end)
      return view_.lengthOf(axis) * (*end - *start);
    const Word *word = wordOf(node, letterOf(axis));
    if (!word)
      return view_.mayHave(node, letterOf(axis)) ? std::nullopt : std::optional(0.);
    return incremental_.at(node) && word->isNumber() ? std::optional(view_.lengthOf(axis) * word->number().toDouble())
                                                     : std::nullopt;
  }
  /// `G91 G02 X#7 R[#7/2]`: half of the distance, but for the rounding of both words.
  bool isHalfOfVariable(const FlowFacts &facts, NodeId node, const Word &radius) const {
    const Word *x = wordOf(node, 'X');
    const Word *y = wordOf(node, 'Y');
    const Word *along = x ? x : y;
    if (view_.context().dialect.machine == MachineKind::Turning || !incremental_.at(node) || !along || (x && y) ||
        along->form() != WordForm::Expression || radius.form() != WordForm::Expression)
      return false;
    StraightPath path(facts, node, [](NodeId) { return false; });
    const auto chord = path.formOf(along->expression(), 0);
    const auto half = path.formOf(radius.expression(), 0);
    if (!chord || !half || chord->isConstant())
      return false;
    for (const double sign : {-2., 2.}) {
      const LinearForm left = sum(*chord, sign, *half);
      if (left.isConstant() && left.constant == 0)
        return true;
    }
    return false;
  }

  void tellTooSmall(const FlowFacts &facts, NodeId node, const Word &radius, const FileContext &context,
                    const Reporter &reporter) const {
    reporter.report(
        {.message = fmt::format("no circle with {} goes through both ends of the arc", context.quoted(radius.span())),
         .span = radius.span(),
         .flow = pathFromEntry(facts, node),
         .notes = {"the end point is further from the start point than twice R",
                   fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::ArcTooShort))}});
  }
  void tellHalf(const Word &radius, const FileContext &context, const Reporter &reporter) const {
    reporter.report({.message = fmt::format("{} is half the distance from the start point to the end point",
                                            context.quoted(radius.span())),
                     .span = radius.span(),
                     .notes = {"both words are rounded to the least increment: where R is rounded down and the end "
                               "point is not, no circle goes through both ends",
                               "program a half circle with I, J, K"}},
                    Severity::Warning);
  }

  MotionView view_;
  std::array<std::optional<double>, kAxisCount> start_; // of the node that is being executed
  std::map<NodeId, const Word *> radii_;                // of arcs
  std::map<NodeId, std::optional<double>> chords_;      // the shortest, in all states
  std::set<NodeId> unclear_;                            // in some state
  std::map<NodeId, bool> incremental_;                  // in all states
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<ArcRadiusTooSmall>(program, context);
}

} // namespace

extern const Rule arcRadiusTooSmall;
const Rule arcRadiusTooSmall{
    .info = {"arc-radius-too-small", Category::Motion, Severity::Error,
             "Reports an arc whose `R` is less than half the distance to the end point, or is computed as half of it."},
    .hooks = {.watch = watch}};

} // namespace feedhold::rules::arc_radius_too_small
