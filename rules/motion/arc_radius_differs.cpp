// arc-radius-differs: the end of an arc is not on the circle of its start.
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <set>

namespace feedhold::rules::arc_radius_differs {
namespace {

/// The analysis has computed both radii; where it cannot tell them apart it is silent.
class ArcRadiusDiffers final : public FlowRule {
public:
  /// Under G68, G51 and G51.1 the start is told in other coordinates than the words.
  void before(NodeId node, const AbstractState &state) override {
    if (mayBeTrue(state.transformed) || isHavocked(state))
      mapped_.insert(node);
  }

  void report(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) override {
    for (const AlarmFact &alarm : facts.alarms()) {
      if (alarm.kind != AlarmKind::ArcRadius || !alarm.always || mapped_.contains(alarm.node))
        continue;
      reporter.report({.message = "the end point of this arc is not on the circle through its start point",
                       .span = alarm.place,
                       .flow = pathFromEntry(facts, alarm.node),
                       .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::ArcRadius)),
                                 "I, J and K are the distances from the start point to the centre"}});
    }
  }

private:
  std::set<NodeId> mapped_;
};

std::unique_ptr<FlowRule> watch(ProgramId, const FileContext &) { return std::make_unique<ArcRadiusDiffers>(); }

} // namespace

extern const Rule arcRadiusDiffers;
const Rule arcRadiusDiffers{
    .info = {"arc-radius-differs", Category::Motion, Severity::Error,
             "Reports an arc whose radius at the end point always differs from the radius at the start point."},
    .hooks = {.watch = watch}};

} // namespace feedhold::rules::arc_radius_differs
