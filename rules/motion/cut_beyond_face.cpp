// cut-beyond-face: `G00 Z[#100+.02]`, `G01 Z[#100+.04] X0.97`, where the part lies between Z0 and Z-#100.
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace feedhold::rules::cut_beyond_face {
namespace {

constexpr double kClearly = 0.05; // of the depth of the deepest cut

using Point = std::array<std::optional<double>, 2>; // X and Z

struct Cut {
  NodeId node;
  double fromX, fromZ, toX, toZ;
};

/// Follows the cuts of a lathe whose coordinates are numbers.
class CutBeyondFace final : public FlowRule {
public:
  CutBeyondFace(ProgramId program, const FileContext &context)
      : view_(program, context), asked_(context.dialect.machine == MachineKind::Turning) {}

  void before(NodeId, const AbstractState &state) override {
    if (asked_)
      from_ = pointOf(state);
  }
  void after(NodeId node, const AbstractState &state) override {
    if (!asked_)
      return;
    noteOffset(node);
    if (view_.modalMotionWords(node).empty() ||
        !view_.surely(state, ModalKind::Motion,
                      {CodeAction::Linear, CodeAction::ArcClockwise, CodeAction::ArcCounterclockwise}))
      return;
    const Point to = pointOf(state);
    if (from_[0] && from_[1] && to[0] && to[1])
      cuts_.push_back({node, *from_[0], *from_[1], *to[0], *to[1]});
  }

  void report(const FlowFacts &, const FileContext &context, const Reporter &reporter) override {
    if (cuts_.empty() || isShifted_)
      return;
    const double deepest = std::ranges::min_element(cuts_, {}, &Cut::toZ)->toZ;
    double approach = 0; // the highest level from which a tool is fed into the part
    for (const Cut &cut : cuts_)
      if (cut.toZ < cut.fromZ)
        approach = std::max(approach, cut.fromZ);
    for (const Cut &cut : cuts_)
      if (deepest < 0 && cut.toX < cut.fromX && cut.toZ > cut.fromZ && cut.fromZ > approach - deepest * kClearly)
        return tell(cut, approach, context, reporter);
  }

private:
  void noteOffset(NodeId node) {
    const bool sets = view_.mayHave(node, 'X') || view_.mayHave(node, 'Z');
    if (sets && view_.findAction(node, {CodeAction::LocalShift, CodeAction::CoordinateSet}))
      isShifted_ = true;
    if (view_.findAction(node, {CodeAction::WorkOffset, CodeAction::ExtendedWorkOffset}))
      isShifted_ = isShifted_ || std::exchange(hasOffset_, true);
  }
  static Point pointOf(const AbstractState &state) {
    Point point;
    for (const auto &[slot, axis] : {std::pair{0U, Axis::X}, std::pair{1U, Axis::Z}})
      if (const AbstractValue &coordinate = state.at(axis); coordinate.isNumber())
        point[slot] = coordinate.number().constantValue();
    return point;
  }
  void tell(const Cut &cut, double approach, const FileContext &context, const Reporter &reporter) const {
    const auto words = view_.modalMotionWords(cut.node);
    const auto level = std::ranges::find(words, 'Z', &Word::address);
    const Span span = level == words.end() ? view_.blockSpan(cut.node) : (*level)->span();
    reporter.report(
        {.message = fmt::format("{} cuts in front of the part", context.quoted(span)),
         .span = span,
         .notes = {fmt::format("this cut goes from Z{:.4g} to Z{:.4g}, where all others begin at Z{:.4g} or "
                               "below and lead to negative Z",
                               cut.fromZ, cut.toZ, approach),
                   "check the sign of Z here and in the move to its start"}});
  }

  MotionView view_;
  bool asked_;
  bool hasOffset_ = false;
  bool isShifted_ = false; // coordinates are not comparable
  Point from_;
  std::vector<Cut> cuts_;
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<CutBeyondFace>(program, context);
}

} // namespace

extern const Rule cutBeyondFace;
const Rule cutBeyondFace{.info = {"cut-beyond-face", Category::Motion, Severity::Warning,
                                  "Reports a cut of a lathe in front of the part, where the sign of Z is wrong."},
                         .hooks = {.watch = watch}};

} // namespace feedhold::rules::cut_beyond_face
