// compensation-without-move: the cutter is down on the contour at X10. Y10., and then `G42 D1 G01 X10. Y10.`
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <map>

namespace feedhold::rules::compensation_without_move {
namespace {

constexpr std::initializer_list<CodeAction> kStarts = {CodeAction::CompensationLeft, CodeAction::CompensationRight};

class CompensationWithoutMove final : public FlowRule {
public:
  CompensationWithoutMove(ProgramId program, const FileContext &context)
      : view_(program, context), asked_(context.dialect.machine == MachineKind::Milling) {}

  void before(NodeId node, const AbstractState &state) override {
    if (!asked_ || !moves(node))
      return;
    x_ = state.at(Axis::X).number().constantValue();
    y_ = state.at(Axis::Y).number().constantValue();
  }
  void after(NodeId node, const AbstractState &state) override {
    if (!asked_)
      return;
    if (node != next_)
      start_ = nullptr;
    next_ = node.next();
    if (const Word *start = view_.findAction(node, kStarts))
      start_ = start;
    if (!start_ || !moves(node))
      return;
    const bool stands = !isHavocked(state) && !view_.modalMotionWords(node).empty() && isInPart(state) && x_ &&
                        x_ == state.at(Axis::X).number().constantValue() && y_ &&
                        y_ == state.at(Axis::Y).number().constantValue();
    const auto [at, isNew] = starts_.emplace(node, Start{start_, stands});
    at->second.stands = at->second.stands && (isNew || stands);
    start_ = nullptr;
  }

  void report(const FlowFacts &, const FileContext &context, const Reporter &reporter) override {
    for (const auto &[node, start] : starts_)
      if (start.stands)
        reporter.report(
            {.message = fmt::format("{} begins with a move that has no length", context.quoted(start.code->span())),
             .span = view_.modalMotionWords(node).front()->span(),
             .labels = {{start.code->span(), "the compensation"}},
             .notes = {"the next block becomes the approach: the cutter goes over to its offset along the "
                       "first edge of the contour, and that edge is cut askew",
                       "begin beside the contour, and approach it in a straight move longer than the "
                       "radius of the cutter"}});
  }

private:
  struct Start {
    const Word *code;
    bool stands;
  };
  bool moves(NodeId node) const { return view_.mayHave(node, 'X') || view_.mayHave(node, 'Y'); }
  static bool isInPart(const AbstractState &state) { return state.at(Axis::Z).number().interval().hi < 0; }

  MotionView view_;
  bool asked_;
  NodeId next_{0};
  const Word *start_ = nullptr; // no block of the plane stands behind it so far
  std::optional<double> x_, y_; // before the instruction
  std::map<NodeId, Start> starts_;
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<CompensationWithoutMove>(program, context);
}

} // namespace

extern const Rule compensationWithoutMove;
const Rule compensationWithoutMove{
    .info = {"compensation-without-move", Category::Motion, Severity::Warning,
             "Reports cutter compensation that begins in the part with a move of no length."},
    .hooks = {.watch = watch}};

} // namespace feedhold::rules::compensation_without_move
