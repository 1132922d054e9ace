// cycle-plane-below-depth: `G81 Z-5. R-10.`.
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <map>
#include <optional>

namespace feedhold::rules::cycle_plane_below_depth {
namespace {

constexpr std::initializer_list<CodeAction> kCycles = {
    CodeAction::CycleDrill,     CodeAction::CycleDwell,   CodeAction::CyclePeck, CodeAction::CycleChipBreak,
    CodeAction::CycleTap,       CodeAction::CycleTapLeft, CodeAction::CycleBore, CodeAction::CycleBoreStop,
    CodeAction::CycleBoreDwell, CodeAction::CycleFineBore};

class CyclePlaneBelowDepth final : public FlowRule {
public:
  CyclePlaneBelowDepth(ProgramId program, const FileContext &context)
      : view_(program, context), asked_(context.dialect.machine == MachineKind::Milling) {}

  void after(NodeId node, const AbstractState &state) override {
    if (!asked_ || !view_.findAction(node, kCycles) ||
        (!stops() && view_.wasSet(state, ModalKind::Plane, {CodeAction::PlaneZX, CodeAction::PlaneYZ})) ||
        !view_.surely(state, ModalKind::Distance, {CodeAction::Absolute}))
      return;
    const Word *plane = find(node, 'R');
    const Word *depth = find(node, depthAxis(state));
    if (plane && depth)
      found_.emplace(node, std::pair{plane, depth});
  }

  void report(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) override {
    for (const auto &[node, words] : found_) {
      const auto &[plane, depth] = words;
      const auto high = numberOf(*plane, facts);
      const auto low = numberOf(*depth, facts);
      if (!high || !low || (stops() ? *high >= *low : *high > *low))
        continue;
      reporter.report({.message = fmt::format("{} is not above the depth {}", context.quoted(plane->span()),
                                              context.quoted(depth->span())),
                       .span = plane->span(),
                       .labels = {{depth->span(), "the depth"}},
                       .notes = {stops() ? "the control stops with an error"
                                         : "the tool goes to R at rapid, so into the part, and feeds away from it",
                                 "correct the sign or the value of R or Z"}},
                      stops() ? Severity::Error : Severity::Warning);
    }
  }

private:
  bool stops() const { return view_.context().dialect.behaviour.stopsAtStrayWords; }
  /// Cycles drill along the normal of the plane where that is known to be so.
  char depthAxis(const AbstractState &state) const {
    return view_.surely(state, ModalKind::Plane, {CodeAction::PlaneZX})   ? 'Y'
           : view_.surely(state, ModalKind::Plane, {CodeAction::PlaneYZ}) ? 'X'
                                                                          : 'Z';
  }
  /// A number, or an expression, that the node executes.
  const Word *find(NodeId node, char address) const {
    for (const Word *word : view_.wordsOf(node))
      if (word->address() == address && (word->isNumber() || word->form() == WordForm::Expression))
        return word;
    return nullptr;
  }
  /// The same wherever the program comes to the word.
  static std::optional<double> numberOf(const Word &word, const FlowFacts &facts) {
    if (word.isNumber())
      return word.number().toDouble();
    const AbstractValue *value = facts.valueOf(word.expression());
    return value && value->isNumber() ? value->number().constantValue() : std::nullopt;
  }

  MotionView view_;
  bool asked_;
  std::map<NodeId, std::pair<const Word *, const Word *>> found_; // R, Z
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<CyclePlaneBelowDepth>(program, context);
}

} // namespace

extern const Rule cyclePlaneBelowDepth;
const Rule cyclePlaneBelowDepth{.info = {"cycle-plane-below-depth", Category::Motion, Severity::Warning,
                                         "Reports a drilling cycle whose `R` is not above its depth."},
                                .hooks = {.watch = watch}};

} // namespace feedhold::rules::cycle_plane_below_depth
