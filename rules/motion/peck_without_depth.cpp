// peck-without-depth: `G83 Z-40. R2. F120.` before any Q.
#include "rules/motion/motion_view.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace feedhold::rules::peck_without_depth {
namespace {

class PeckWithoutDepth final : public FlowRule {
public:
  PeckWithoutDepth(ProgramId program, const FileContext &context)
      : view_(program, context), asked_(context.dialect.machine == MachineKind::Milling) {}

  void before(NodeId node, const AbstractState &state) override {
    if (!asked_ || !view_.findAction(node, kPecks) || view_.modalMotionWords(node).empty())
      return;
    const bool lacks = !hasDepth(node) && (isHavocked(state) ? isFirstOfText(node) : lacksDepth(node, state));
    const auto [at, isNew] = places_.emplace(node, lacks);
    if (!isNew)
      at->second = at->second && lacks;
  }

  void report(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) override {
    for (const auto &[node, lacks] : places_) {
      if (!lacks)
        continue;
      const Word *cycle = view_.findAction(node, kPecks);
      const Word *zero = depthOf(node);
      reporter.report(
          {.message = zero ? fmt::format("{} of {} is no depth of a peck", context.quoted(zero->span()),
                                         context.quoted(cycle->span()))
                           : fmt::format("{} has no `Q`, the depth of each peck", context.quoted(cycle->span())),
           .span = zero ? zero->span() : cycle->span(),
           .flow = pathFromEntry(facts, node),
           .notes = {context.dialect.hasFanucParameters
                         ? "the control stops with PS0045 (address Q not found), or drills the hole in one go"
                     : stops() ? "the control stops with an error"
                               : "the control stops, or drills the hole in one go",
                     "write Q, or `G81` if the hole needs no pecks"}},
          stops() ? Severity::Error : Severity::Warning);
    }
  }

private:
  static constexpr std::initializer_list<CodeAction> kPecks = {CodeAction::CyclePeck, CodeAction::CycleChipBreak};

  bool stops() const { return view_.context().dialect.behaviour.stopsAtStrayWords; }
  const Word *depthOf(NodeId node) const { return findWord(view_.context().tree, view_.node(node).block, 'Q'); }
  /// Q, or the I, J, K of pecks that become smaller.
  bool hasDepth(NodeId node) const {
    if (const Word *depth = depthOf(node))
      return !depth->isNumber() || (!depth->number().isZero() && (!stops() || depth->number().toDouble() > 0));
    return view_.mayHave(node, 'I') || view_.mayHave(node, 'J') || view_.mayHave(node, 'K') || view_.mayHave(node, 'D');
  }
  bool lacksDepth(NodeId node, const AbstractState &state) const {
    return depthOf(node) || state.cycle.peck.isVacant() || isFirstOfText(node);
  }
  /// The program is started by the operator, and no block of its text so far has a Q.
  bool isFirstOfText(NodeId node) const {
    const FileContext &context = view_.context();
    const Program &its = context.model.programs[view_.program()];
    const BlockId cycle = view_.node(node).block;
    if (startedBy(context, view_.program()) != StartedBy::Operator || !context.model.jumpsOf(view_.program()).empty() ||
        !context.model.loopsOf(view_.program()).empty() || !context.model.callsIn(its.first, cycle).empty())
      return false;
    for (BlockId block = its.first; block <= cycle; block = block.next())
      if ((block != cycle && findWord(context.tree, block, 'Q')) || context.tree.blocks[block].has(Block::kBroken) ||
          findAction(context.tree, block, context.dialect, {CodeAction::Anything}))
        return false;
    return true;
  }

  MotionView view_;
  bool asked_;
  std::map<NodeId, bool> places_;
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<PeckWithoutDepth>(program, context);
}

} // namespace

extern const Rule peckWithoutDepth;
const Rule peckWithoutDepth{.info = {"peck-without-depth", Category::Motion, Severity::Warning,
                                     "Reports a peck drilling cycle (`G73`, `G83`) without `Q` or with `Q0`."},
                            .hooks = {.watch = watch}};

} // namespace feedhold::rules::peck_without_depth
