// compensation-number-changed: `G41 D1`, then `X60. D2` before G40.
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <map>

namespace feedhold::rules::compensation_number_changed {
namespace {

constexpr std::initializer_list<CodeAction> kCompensated = {CodeAction::CompensationLeft,
                                                            CodeAction::CompensationRight};

class CompensationNumberChanged final : public FlowRule {
public:
  CompensationNumberChanged(ProgramId program, const FileContext &context) : view_(program, context) {}

  void before(NodeId node, const AbstractState &state) override {
    if (!view_.mayHave(node, 'D') || isHavocked(state) || !view_.wasSet(state, ModalKind::Compensation, kCompensated) ||
        !view_.surely(state, ModalKind::Compensation, kCompensated) || view_.findAction(node, {kOff}))
      return;
    const AbstractValue &inForce = state.word('D');
    const auto number = inForce.isNumber() ? inForce.number().constantValue() : std::nullopt;
    for (const Word *word : view_.wordsOf(node)) {
      if (word->isCode() && takesWords(*word))
        return;
      if (word->address() == 'D' && word->isNumber() && number && word->number().toDouble() != *number)
        found_.emplace(node, *number);
    }
  }

  void report(const FlowFacts &, const FileContext &context, const Reporter &reporter) override {
    for (const auto &[node, before] : found_)
      for (const Word *word : view_.wordsOf(node))
        if (word->address() == 'D')
          reporter.report(
              {.message =
                   fmt::format("{} replaces D{} while G41 or G42 is active", context.quoted(word->span()), before),
               .span = word->span(),
               .notes = {word->number().isZero()
                             ? "D0 ends the compensation: the tool comes back to the programmed path in the next move"
                             : "the control blends from one offset to the other along one block: that edge of the part "
                               "is tapered",
                         word->number().isZero() ? "end it with G40" : "cancel with G40 before another D"}});
  }

private:
  /// The D of a cycle, of a contour (G70 of LinuxCNC), of G10, of an argument.
  bool takesWords(const Word &word) const {
    const Code *code = codeOf(word, view_.context().dialect);
    return !code || (code->role != CodeRole::Plain && code->role != CodeRole::Motion && code->role != CodeRole::Arc);
  }

  static constexpr CodeAction kOff = CodeAction::CompensationOff;

  MotionView view_;
  std::map<NodeId, double> found_; // the number in force before
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<CompensationNumberChanged>(program, context);
}

} // namespace

extern const Rule compensationNumberChanged;
const Rule compensationNumberChanged{.info = {"compensation-number-changed", Category::Motion, Severity::Warning,
                                              "Reports another `D` while `G41` or `G42` is active."},
                                     .hooks = {.watch = watch}};

} // namespace feedhold::rules::compensation_number_changed
