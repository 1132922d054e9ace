// arc-without-motion: `G02 X0. Y0. R5.` where the tool stands there already.
#include "rules/motion/motion_view.h"
#include "rules/motion/tool_sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <string_view>

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

  void after(NodeId node, const AbstractState &state) override {
    if (view_.surely(state, ModalKind::Distance, {CodeAction::Incremental}))
      incremental_.insert(node);
  }

  void report(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) override {
    // Where the control surely stops at such an arc, nothing has moved.
    for (const AlarmFact &alarm : facts.alarms())
      if (alarm.kind == AlarmKind::ArcWithoutLength && alarm.always)
        places_.emplace(alarm.node, true); // else it moves in some state
    const bool stops = context.dialect.switches.pointArcStops == Switch::On;
    for (const auto &[node, stands] : places_) {
      const Word *arc = view_.findAction(node, {CodeAction::ArcClockwise, CodeAction::ArcCounterclockwise});
      if ((stands || repeatsPosition(node)) && view_.mayHave(node, 'R'))
        reporter.report({.message = fmt::format("this {} with `R` ends where it starts, so it cuts no arc",
                                                context.quoted(arc->span())),
                         .span = view_.blockSpan(node),
                         .notes = {stops ? "the control stops with an error: R does not define a full circle; program "
                                           "it with I, J, K"
                                         : "R does not define a full circle; program it with I, J, K"}},
                        stops ? Severity::Error : Severity::Warning);
    }
  }

private:
  /// `X[#1-3.] Y#2`, and in the block above the same: whatever the variables hold.
  bool repeatsPosition(NodeId node) const {
    const BlockId block = view_.node(node).block;
    if (incremental_.contains(node) || block.index() == 0 || HiddenWork(view_.program(), view_.context()).isIn(block))
      return false;
    const BlockId before(block.index() - 1);
    return std::ranges::all_of(std::string_view("XY"), [&](char axis) {
      const std::string here = textOf(block, axis);
      return !here.empty() && here == textOf(before, axis);
    });
  }
  /// Of a word, without its blanks.
  std::string textOf(BlockId block, char address) const {
    const FileContext &context = view_.context();
    const Word *word = findWord(context.tree, block, address);
    std::string text(word ? context.text(word->span()) : "");
    std::erase_if(text, [](char each) { return each == ' '; });
    return text;
  }

  MotionView view_;
  std::map<NodeId, bool> places_;
  std::set<NodeId> incremental_;
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
