// reference-through-work-zero: `G90 G28 Z0.`.
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <map>

namespace feedhold::rules::reference_through_work_zero {
namespace {

class ReferenceThroughWorkZero final : public FlowRule {
public:
  ReferenceThroughWorkZero(ProgramId program, const FileContext &context) : view_(program, context) {}

  void after(NodeId node, const AbstractState &state) override {
    if (!depthWord(node))
      return;
    const bool absolute = !isHavocked(state) && view_.surely(state, ModalKind::Distance, {CodeAction::Absolute});
    const auto [at, isNew] = places_.emplace(node, absolute);
    at->second = at->second && (isNew || absolute);
  }

  void report(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) override {
    for (const auto &[node, absolute] : places_) {
      if (!absolute)
        continue;
      const Word &word = *depthWord(node);
      reporter.report(
          {.message = fmt::format("{} under `G90` makes part zero the intermediate point", context.quoted(word.span())),
           .span = word.span(),
           .flow = pathFromEntry(facts, node),
           .notes = {"the tool moves down to Z0 at rapid before it goes to the reference point",
                     "write G91 in this block: the intermediate point is then the current position"},
           .fixes = {{.title = "insert `G91`", .edits = {{{word.span().begin, word.span().begin}, "G91"}}}}});
    }
  }

private:
  const Word *depthWord(NodeId node) const {
    if (!view_.findAction(node, {CodeAction::ReferenceReturn, CodeAction::SecondReference}))
      return nullptr;
    for (const Word *word : view_.wordsOf(node))
      if (word->address() == 'Z' && word->isNumber() && word->number().isZero())
        return word;
    return nullptr;
  }

  MotionView view_;
  std::map<NodeId, bool> places_;
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<ReferenceThroughWorkZero>(program, context);
}

} // namespace

extern const Rule referenceThroughWorkZero;
const Rule referenceThroughWorkZero{.info = {"reference-through-work-zero", Category::Motion, Severity::Warning,
                                             "Reports a reference return with `Z0` while `G90` is active."},
                                    .hooks = {.watch = watch}};

} // namespace feedhold::rules::reference_through_work_zero
