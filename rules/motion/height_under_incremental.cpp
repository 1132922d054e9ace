// height-under-incremental: `G00 Z[#26+50.]` under G91, and `G43 H1 Z[#26+10.]` under G90.
#include "rules/expressions/expression_view.h"
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <map>
#include <optional>

namespace feedhold::rules::height_under_incremental {
namespace {

class HeightUnderIncremental final : public FlowRule {
public:
  HeightUnderIncremental(ProgramId program, const FileContext &context) : view_(program, context) {}

  void after(NodeId node, const AbstractState &state) override {
    if (!view_.mayHave(node, 'Z') || isHavocked(state))
      return;
    for (const Word *word : view_.modalMotionWords(node)) {
      const auto base =
          word->address() == 'Z' && word->form() == WordForm::Expression ? heightOver(*word) : std::nullopt;
      if (!base)
        continue;
      if (view_.surely(state, ModalKind::Distance, {CodeAction::Absolute}))
        absolute_.emplace(*base, word);
      else if (view_.surely(state, ModalKind::Distance, {CodeAction::Incremental}) &&
               view_.surely(state, ModalKind::Motion, {CodeAction::Rapid}))
        incremental_.emplace(node, std::pair{*base, word});
    }
  }

  void report(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) override {
    for (const auto &[node, use] : incremental_) {
      const auto &[base, word] = use;
      const auto other = absolute_.find(base);
      if (other == absolute_.end())
        continue;
      reporter.report({.message = fmt::format("{} is a height, and `G91` is active", context.quoted(word->span())),
                       .span = word->span(),
                       .labels = {{other->second->span(), "a height above the same level, under `G90`"}},
                       .flow = pathFromEntry(facts, node),
                       .notes = {"the tool moves by this distance, not to this height", "write `G90` in this block"}});
    }
  }

private:
  /// Of `[#26+50.]`: #26.
  std::optional<std::uint32_t> heightOver(const Word &word) const {
    const SyntaxTree &tree = view_.context().tree;
    std::optional<std::uint32_t> base;
    bool hasClearance = false;
    for (const SumTerm &term : termsOf(tree, word.expression())) {
      const auto literal = literalValue(tree, term.value);
      const auto variable = variableNumber(tree, unwrapped(tree, term.value));
      if (term.isMinus || (!literal && (!variable || base)))
        return std::nullopt;
      hasClearance = hasClearance || (literal && !literal->isNegative() && !literal->isZero());
      base = variable ? variable : base;
    }
    return hasClearance ? base : std::nullopt;
  }

  MotionView view_;
  std::map<std::uint32_t, const Word *> absolute_; // by variable
  std::map<NodeId, std::pair<std::uint32_t, const Word *>> incremental_;
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<HeightUnderIncremental>(program, context);
}

} // namespace

extern const Rule heightUnderIncremental;
const Rule heightUnderIncremental{
    .info = {"height-under-incremental", Category::Motion, Severity::Warning,
             "Reports a rapid move in `Z` under `G91` to a height above a level that is absolute elsewhere."},
    .hooks = {.watch = watch}};

} // namespace feedhold::rules::height_under_incremental
