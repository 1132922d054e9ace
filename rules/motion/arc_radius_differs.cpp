// arc-radius-differs: the end of an arc is not on the circle of its start.
#include "rules/motion/arc_ends.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <set>

namespace feedhold::rules::arc_radius_differs {
namespace {

/// Where the analysis has not computed both radii, they are compared as the text has them.
class ArcRadiusDiffers final : public FlowRule {
public:
  ArcRadiusDiffers(ProgramId program, const FileContext &context)
      : view_(program, context), first_(view_.cfg().entryOf(program)) {}

  /// Under G68, G51 and G51.1 the start is told in other coordinates than the words.
  void before(NodeId node, const AbstractState &state) override {
    if (!mayBeArc(node))
      return;
    if (mayBeTrue(state.transformed) || isHavocked(state))
      mapped_.insert(node);
    before_ = stateBefore(state);
  }
  void after(NodeId node, const AbstractState &state) override {
    if (!mayBeArc(node) || mapped_.contains(node))
      return;
    const std::optional<ArcBlock> block = arcIn(node, state);
    if (!block || (view_.planeIn(state) && isPlainlyKnown(node, *block)))
      return refuse(node);
    const auto [known, isNew] = blocks_.try_emplace(node, *block);
    if (!isNew && known->second != *block)
      refuse(node);
  }

  void report(const FlowFacts &facts, const FileContext &, const Reporter &reporter) override {
    std::set<NodeId> told;
    for (const AlarmFact &alarm : facts.alarms())
      if (alarm.kind == AlarmKind::ArcRadius && alarm.always && !mapped_.contains(alarm.node)) {
        told.insert(alarm.node);
        tell(facts, alarm.node, alarm.place, std::nullopt, reporter);
      }
    for (const auto &[node, block] : blocks_)
      if (!told.contains(node) && !isRefused(node))
        if (const auto radii = apartRadii(view_, facts, node, block))
          tell(facts, node, view_.blockSpan(node), radii, reporter);
  }

private:
  struct Before {
    std::optional<bool> isAbsolute;
    std::array<std::optional<double>, kAxisCount> position;
  };

  /// In some state the block is not to be judged.
  void refuse(NodeId node) {
    const std::size_t at = node.index() - first_.index();
    refused_.resize(std::max(refused_.size(), at + 1));
    refused_[at] = true;
  }
  bool isRefused(NodeId node) const {
    const std::size_t at = node.index() - first_.index();
    return at < refused_.size() && refused_[at];
  }
  bool mayBeArc(NodeId node) const {
    return view_.mayHave(node, 'I') || view_.mayHave(node, 'J') || view_.mayHave(node, 'K');
  }
  Before stateBefore(const AbstractState &state) const {
    Before before;
    if (view_.surely(state, ModalKind::Distance, {CodeAction::Absolute}))
      before.isAbsolute = true;
    else if (view_.surely(state, ModalKind::Distance, {CodeAction::Incremental}))
      before.isAbsolute = false;
    for (const Axis axis : kAllAxes)
      if (const AbstractValue &coordinate = state.at(axis); coordinate.isNumber())
        before.position[indexOf(axis)] = coordinate.number().constantValue();
    return before;
  }
  /// Absent where it may be no arc, or its words may mean something else.
  std::optional<ArcBlock> arcIn(NodeId node, const AbstractState &state) {
    const std::optional<Plane> given = view_.planeIn(state);
    const std::optional<Plane> plane = given ? given : usualPlane(node, state);
    const bool hasModes = view_.modes().groupOf(ModalKind::Distance).has_value();
    const bool isAbsolute = !hasModes || view_.surely(state, ModalKind::Distance, {CodeAction::Absolute});
    const bool isKnown = isAbsolute || view_.surely(state, ModalKind::Distance, {CodeAction::Incremental});
    const bool isFromStart = !view_.context().dialect.behaviour.arcDistanceModes ||
                             view_.surely(state, ModalKind::ArcDistance, {CodeAction::ArcIncremental});
    const bool isPlain = !mayBeTrue(state.transformed) && !isHavocked(state) && state.modalCalls.empty() &&
                         !mayBeTrue(state.modalCallsUnknown) &&
                         !view_.wasSet(state, ModalKind::Polar, {CodeAction::PolarOn});
    if (!plane || !isKnown || !isFromStart || !isPlain ||
        !view_.surely(state, ModalKind::Motion, {CodeAction::ArcClockwise, CodeAction::ArcCounterclockwise}))
      return std::nullopt;
    return ArcBlock{*plane,
                    isAbsolute,
                    view_.surely(state, ModalKind::Units, {CodeAction::Inch}),
                    before_.isAbsolute,
                    {before_.position[indexOf(plane->first)], before_.position[indexOf(plane->second)]}};
  }
  /// An arc of a tool path: between two points that are numbers the analysis has compared the radii.
  bool isPlainlyKnown(NodeId node, const ArcBlock &block) const {
    const auto words = view_.wordsOf(node);
    return block.start[0] && block.start[1] &&
           std::ranges::none_of(words, [](const Word *word) { return word->form() == WordForm::Expression; });
  }
  /// That of power-on, where the words of the arc name no other.
  std::optional<Plane> usualPlane(NodeId node, const AbstractState &state) const {
    return view_.namesOtherPlane(node) || view_.choseOtherPlane(state) ? std::nullopt
                                                                       : std::optional(view_.usualPlane());
  }

  void tell(const FlowFacts &facts, NodeId node, Span place, const std::optional<ApartRadii> &radii,
            const Reporter &reporter) const {
    std::vector<std::string> notes;
    if (radii && radii->start.width() < kShown && radii->end.width() < kShown)
      notes.push_back(fmt::format("the radius is {:.6g} at the start point and {:.6g} at the end point{}",
                                  radii->start.lo, radii->end.lo,
                                  radii->dependsOnVariables ? ", whatever numbers the variables hold" : ""));
    const bool isShifted = radii && radii->shift;
    if (isShifted)
      notes.push_back(fmt::format("the end is the start point moved by {:.6g} along the radius: both are on one circle "
                                  "for one value of the variables only, which makes a half circle",
                                  *radii->shift));
    notes.push_back(fmt::format("the control {}", stopsWith(view_.context().dialect, AlarmKind::ArcRadius)));
    notes.emplace_back("I, J and K are the distances from the start point to the centre");
    reporter.report({.message = "the end point of this arc is not on the circle through its start point",
                     .span = place,
                     .flow = pathFromEntry(facts, node),
                     .notes = std::move(notes)},
                    isShifted ? Severity::Warning : Severity::Error);
  }

  static constexpr double kShown = 1e-6; // a bound of a radius, as the place that messages have for it

  MotionView view_;
  std::set<NodeId> mapped_;
  std::map<NodeId, ArcBlock> blocks_;
  NodeId first_;
  std::vector<bool> refused_; // from the first node on; a tool path has a million arcs
  Before before_;             // the node that is being executed
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<ArcRadiusDiffers>(program, context);
}

} // namespace

extern const Rule arcRadiusDiffers;
const Rule arcRadiusDiffers{
    .info = {"arc-radius-differs", Category::Motion, Severity::Error,
             "Reports an arc whose radius at the end point always differs from the radius at the start point."},
    .hooks = {.watch = watch}};

} // namespace feedhold::rules::arc_radius_differs
