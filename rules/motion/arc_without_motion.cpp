// arc-without-motion: `G02 X0. Y0. R5.` where the tool stands there already.
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <map>

namespace feedhold::rules::arc_without_motion {
namespace {

class ArcWithoutMotion final : public FlowRule {
public:
  ArcWithoutMotion(ProgramId program, const FileContext &context) : view_(program, context) {}

  /// An arc by R without a chord is told as a straight move: see the semantics of arcs.
  void move(NodeId node, MoveKind kind) override {
    if (!view_.findAction(node, {CodeAction::ArcClockwise, CodeAction::ArcCounterclockwise}))
      return;
    const bool stands = kind == MoveKind::Feed;
    const auto [at, isNew] = places_.emplace(node, stands);
    at->second = at->second && (isNew || stands);
  }

  void report(const FlowFacts &, const FileContext &context, const Reporter &reporter) override {
    for (const auto &[node, stands] : places_) {
      const Word *arc = view_.findAction(node, {CodeAction::ArcClockwise, CodeAction::ArcCounterclockwise});
      if (stands && view_.mayHave(node, 'R'))
        reporter.report({.message = fmt::format("this {} with `R` ends where it starts, so it cuts no arc",
                                                context.quoted(arc->span())),
                         .span = view_.blockSpan(node),
                         .notes = {"R does not define a full circle; program it with I, J, K"}});
    }
  }

private:
  MotionView view_;
  std::map<NodeId, bool> places_;
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<ArcWithoutMotion>(program, context);
}

} // namespace

extern const Rule arcWithoutMotion;
const Rule arcWithoutMotion{.info = {"arc-without-motion", Category::Motion, Severity::Warning,
                                     "Reports an arc with `R` whose end point always equals its start point."},
                            .hooks = {.watch = watch}};

} // namespace feedhold::rules::arc_without_motion
