// cycle-without-depth: a canned cycle before any Z or R.
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <map>

namespace feedhold::rules::cycle_without_depth {
namespace {

constexpr std::initializer_list<CodeAction> kCycles = {
    CodeAction::CycleDrill, CodeAction::CycleDwell,   CodeAction::CyclePeck, CodeAction::CycleChipBreak,
    CodeAction::CycleTap,   CodeAction::CycleTapLeft, CodeAction::CycleBore, CodeAction::CycleBoreStop};

class CycleWithoutDepth final : public FlowRule {
public:
  CycleWithoutDepth(ProgramId program, const FileContext &context) : view_(program, context) {}

  void before(NodeId node, const AbstractState &state) override {
    if (!view_.findAction(node, kCycles))
      return;
    const auto isIn = [&](CodeAction plane) {
      return view_.sets(node, ModalKind::Plane) ? view_.findAction(node, {plane}) != nullptr
                                                : view_.surely(state, ModalKind::Plane, {plane});
    };
    depths_.emplace(node, isIn(CodeAction::PlaneZX) ? 'Y' : isIn(CodeAction::PlaneYZ) ? 'X' : 'Z');
  }
  void after(NodeId node, const AbstractState &state) override {
    if (!view_.findAction(node, kCycles) || view_.modalMotionWords(node).empty())
      return;
    if (isHavocked(state) || !isPlaneKnown(state)) {
      if (isUnlevelled(node))
        places_.emplace(node, Missing{false, true});
      return;
    }
    const Missing missing{state.cycle.bottom.isVacant(), state.cycle.retract.isVacant()};
    const auto [at, isNew] = places_.emplace(node, missing);
    if (!isNew)
      at->second = {at->second.depth && missing.depth, at->second.retract && missing.retract};
  }

  void report(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) override {
    // Where the control surely stops, the analysis goes on as if the levels were there.
    for (const AlarmFact &alarm : facts.alarms())
      if (alarm.kind == AlarmKind::CycleWithoutLevel && alarm.always && view_.findAction(alarm.node, kCycles))
        places_.emplace(alarm.node, Missing{!hasDepth(alarm.node), !view_.mayHave(alarm.node, 'R')});
    for (const auto &[node, missing] : places_) {
      if (!missing.depth && !missing.retract)
        continue;
      const bool stops = context.dialect.behaviour.stopsAtStrayWords;
      const Word *cycle = view_.findAction(node, kCycles);
      reporter.report(
          {.message = fmt::format("{} has no {}", context.quoted(cycle->span()),
                                  missing.depth && missing.retract ? "depth and no `R`"
                                  : missing.depth                  ? "depth"
                                                                   : "`R`"),
           .span = cycle->span(),
           .flow = pathFromEntry(facts, node),
           .notes = {stops ? "the control stops with an error: those of an earlier cycle no longer apply"
                           : "depth and R of an earlier cycle no longer apply: the control stops, or drills to 0",
                     "write the depth and R in the first block of the cycle"}},
          stops ? Severity::Error : Severity::Warning);
    }
  }

private:
  /// Along the normal of the plane in force.
  bool hasDepth(NodeId node) const {
    const auto depth = depths_.find(node);
    return depth != depths_.end() && view_.mayHave(node, depth->second);
  }
  /// Else the levels are not followed.
  bool isPlaneKnown(const AbstractState &state) const {
    return view_.surely(state, ModalKind::Plane, {CodeAction::PlaneXY}) ||
           view_.surely(state, ModalKind::Plane, {CodeAction::PlaneZX}) ||
           view_.surely(state, ModalKind::Plane, {CodeAction::PlaneYZ});
  }
  /// The plane is that of power on, since the program states none, and no block so far, one behind the other, has an R.
  bool isUnlevelled(NodeId node) const {
    const FileContext &context = view_.context();
    const Program &its = context.model.programs[view_.program()];
    const BlockId cycle = view_.node(node).block;
    if (context.dialect.machine != MachineKind::Milling || startedBy(context, view_.program()) != StartedBy::Operator ||
        !context.model.jumpsOf(view_.program()).empty() || !context.model.loopsOf(view_.program()).empty() ||
        !context.model.callsIn(its.first, cycle).empty())
      return false;
    for (BlockId block = its.first; block <= cycle; block = block.next())
      if (findWord(context.tree, block, 'R') || context.tree.blocks[block].has(Block::kBroken) ||
          !context.tree.statementsOf(block).empty() ||
          findAction(context.tree, block, context.dialect,
                     {CodeAction::PlaneXY, CodeAction::PlaneZX, CodeAction::PlaneYZ, CodeAction::Anything}))
        return false;
    return true;
  }
  struct Missing {
    bool depth;
    bool retract;
  };
  MotionView view_;
  std::map<NodeId, Missing> places_;
  std::map<NodeId, char> depths_; // the axis of the depth
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<CycleWithoutDepth>(program, context);
}

} // namespace

extern const Rule cycleWithoutDepth;
const Rule cycleWithoutDepth{
    .info = {"cycle-without-depth", Category::Motion, Severity::Warning,
             "Reports a canned cycle that starts without a depth or without `R` when neither can be active."},
    .hooks = {.watch = watch}};

} // namespace feedhold::rules::cycle_without_depth
