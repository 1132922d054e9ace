// offset-under-compensation: `#13001=5.` while G41 is in force.
#include "rules/flow/system_variables.h"
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace feedhold::rules::offset_under_compensation {
namespace {

class OffsetUnderCompensation final : public FlowRule {
public:
  OffsetUnderCompensation(ProgramId program, const FileContext &context) : view_(program, context) {}

  void before(NodeId node, const AbstractState &state) override {
    const auto actions = {CodeAction::CompensationLeft, CodeAction::CompensationRight};
    if (!isHavocked(state) && view_.wasSet(state, ModalKind::Compensation, actions) &&
        view_.surely(state, ModalKind::Compensation, actions))
      compensated_.insert(node);
  }

  void report(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) override {
    for (const VariableUse &use : context.model.variablesOf(view_.program())) {
      if (!use.write || !use.number || !isToolOffset(context, *use.number))
        continue;
      const auto node = nodeOf(facts, use.block, use.expression);
      if (!node || !compensated_.contains(*node))
        continue;
      const Span span = context.tree.expressions[use.expression].span;
      reporter.report(
          {.message = fmt::format("{} is written while G41 or G42 is active", context.quoted(span)),
           .span = span,
           .notes = {"the next blocks are already computed with the old offset; where the new one takes effect varies",
                     "write it before G41 or G42, or after G40"}});
    }
  }

private:
  MotionView view_;
  std::set<NodeId> compensated_;
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<OffsetUnderCompensation>(program, context);
}

} // namespace

extern const Rule offsetUnderCompensation;
const Rule offsetUnderCompensation{.info = {"offset-under-compensation", Category::Motion, Severity::Warning,
                                            "Reports a tool offset that is written while `G41` or `G42` is active."},
                                   .hooks = {.watch = watch}};

} // namespace feedhold::rules::offset_under_compensation
