// skip-without-retract: `G91 G31 Z-80. F1000`, then `G31 Z-30. F200`: the second begins where the first has touched.
#include "rules/expressions/expression_view.h"
#include "rules/flow/definitions.h"
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace feedhold::rules::skip_without_retract {
namespace {

/// A skip move along one axis.
struct SkipMove {
  std::uint16_t tenths; // of its code
  const Word *axis;
};

class SkipWithoutRetract final : public FlowRule {
public:
  SkipWithoutRetract(ProgramId program, const FileContext &context) : view_(program, context) {}

  void after(NodeId node, const AbstractState &state) override {
    if (!view_.mayDo(node, {CodeAction::Skip}))
      return;
    const Mode mode = view_.surely(state, ModalKind::Distance, {CodeAction::Incremental}) ? Mode::Incremental
                      : view_.surely(state, ModalKind::Distance, {CodeAction::Absolute})  ? Mode::Absolute
                                                                                          : Mode::Other;
    const auto [known, isNew] = modes_.try_emplace(node, mode);
    if (!isNew && known->second != mode)
      known->second = Mode::Other;
  }

  void report(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) override {
    if (isTooLarge(facts))
      return;
    for (const auto &[node, mode] : modes_) {
      const auto move = skipAt(node);
      const auto before = move ? skipBefore(facts, node) : std::nullopt;
      const auto first = before ? skipAt(*before) : std::nullopt;
      if (first && goesOn(*first, *before, *move, node))
        reporter.report({.message = fmt::format("{} begins where the skip move before it has touched: no retract "
                                                "between them",
                                                context.quoted(view_.blockSpan(node))),
                         .span = view_.blockSpan(node),
                         .labels = {{view_.blockSpan(*before), "ends at the contact"}},
                         .notes = {"the probe is still deflected: the control ends this move at once, or stops with an "
                                   "alarm, and the second measurement is the first one again",
                                   "move back by the travel of the probe between the two"}});
    }
  }

private:
  enum class Mode : std::uint8_t { Other, Incremental, Absolute };

  /// G38.4, G38.5: until the contact is lost.
  static bool isAway(const Code &code) { return code.tenths == 384 || code.tenths == 385; }

  std::optional<SkipMove> skipAt(NodeId node) const {
    std::optional<std::uint16_t> tenths;
    for (const Word *word : view_.wordsOf(node))
      if (const Code *code = word->isCode() ? codeOf(*word, view_.context().dialect) : nullptr;
          code && isSkip(code->role) && code->action == CodeAction::Skip && !isAway(*code))
        tenths = code->tenths;
    const auto axes = tenths ? view_.axisWords(node) : std::vector<const Word *>{};
    return axes.size() == 1 ? std::optional(SkipMove{*tenths, axes.front()}) : std::nullopt;
  }

  /// Nothing moves there, is decided, or is left to the operator.
  bool isCalm(NodeId node) const {
    const Instruction &instruction = view_.node(node).instruction;
    if (std::holds_alternative<Pass>(instruction) || std::holds_alternative<Assign>(instruction))
      return true;
    if (!std::holds_alternative<ExecuteWords>(instruction))
      return false;
    if (view_.findAction(node, {CodeAction::Dwell}))
      return true;
    return std::ranges::all_of(view_.wordsOf(node), [&](const Word *word) {
      const Code *code = word->isCode() ? codeOf(*word, view_.context().dialect) : nullptr;
      const bool isMode = code && code->role == CodeRole::Plain && word->address() == 'G';
      return word->address() == 'N' || word->address() == 'F' || isMode;
    });
  }

  std::optional<NodeId> skipBefore(const FlowFacts &facts, NodeId node) const {
    constexpr int kFarthest = 20;
    std::optional<NodeId> before = onlyPredecessor(facts, node);
    for (int i = 0; before && i < kFarthest && isCalm(*before) && !modes_.contains(*before); ++i)
      before = onlyPredecessor(facts, *before);
    return before && modes_.contains(*before) ? before : std::nullopt;
  }

  /// The second move has the direction of the first.
  bool goesOn(const SkipMove &first, NodeId before, const SkipMove &second, NodeId node) const {
    const FileContext &context = view_.context();
    const Mode mode = modes_.at(node);
    if (mode == Mode::Other || modes_.at(before) != mode || first.axis->address() != second.axis->address() ||
        first.tenths != second.tenths)
      return false;
    if (sameText(context, first.axis->span(), second.axis->span()))
      return true;
    const auto one = distanceOf(*first.axis);
    const auto other = distanceOf(*second.axis);
    return mode == Mode::Incremental && one && other && one->isNegative() == other->isNegative();
  }
  std::optional<Decimal> distanceOf(const Word &word) const {
    if (word.form() == WordForm::Expression)
      return literalValue(view_.context().tree, word.expression());
    return word.isNumber() && !word.number().isZero() ? std::optional(word.number()) : std::nullopt;
  }

  MotionView view_;
  std::map<NodeId, Mode> modes_; // of skip moves
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<SkipWithoutRetract>(program, context);
}

} // namespace

extern const Rule skipWithoutRetract;
const Rule skipWithoutRetract{.info = {"skip-without-retract", Category::Motion, Severity::Warning,
                                       "Reports a skip move that follows another one in the same direction without a "
                                       "retract."},
                              .hooks = {.watch = watch}};

} // namespace feedhold::rules::skip_without_retract
