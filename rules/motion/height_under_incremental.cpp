// height-under-incremental: `G00 Z[#26+50.]` under G91, and `G43 H1 Z[#26+10.]` under G90.
#include "rules/expressions/expression_view.h"
#include "rules/motion/motion_view.h"

#include "base/support/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace feedhold::rules::height_under_incremental {
namespace {

class HeightUnderIncremental final : public FlowRule {
public:
  HeightUnderIncremental(ProgramId program, const FileContext &context) : view_(program, context) {}

  void after(NodeId node, const AbstractState &state) override {
    if (!view_.mayHave(node, 'Z'))
      return;
    if (view_.surely(state, ModalKind::Distance, {CodeAction::Incremental}))
      noteHeightOfRemark(node);
    if (isHavocked(state))
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
    for (const auto &[node, height] : ofRemarks_)
      reporter.report(
          {.message = fmt::format("{} is a height, and `G91` is active", context.quoted(height.word->span())),
           .span = height.word->span(),
           .labels = {{height.level->span(), "the level above which the remark counts"}},
           .flow = pathFromEntry(facts, node),
           .notes = {"the tool moves by this distance, not to this height", "write `G90` in this block"}});
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
  struct HeightOfRemark {
    const Word *word;
    const Word *level;
  };

  /// `G10 L20 P1 Z25`, and in the next block `G00 Z35 (10mm above the part)`: the sum, where the distance is meant to
  /// stand.
  void noteHeightOfRemark(NodeId node) {
    const FileContext &context = view_.context();
    const BlockId block = view_.node(node).block;
    const Word *level = levelSetBefore(block);
    if (!level)
      return;
    for (const Word *word : view_.modalMotionWords(node)) {
      if (word->address() != 'Z' || !word->isNumber())
        continue;
      for (const Comment &remark : context.tree.commentsOf(block))
        if (namesRise(toUpper(context.text(remark.span)), word->number().toDouble() - level->number().toDouble()))
          ofRemarks_.emplace(node, HeightOfRemark{word, level});
    }
  }
  /// The Z of a G10 or G92 in the block above.
  const Word *levelSetBefore(BlockId block) const {
    const FileContext &context = view_.context();
    do {
      if (block == context.model.programs[view_.program()].first)
        return nullptr;
      block = BlockId(block.index() - 1);
    } while (isEmpty(context.tree, block));
    const bool sets = findCode(context.tree, block, context.dialect, CodeRole::DataSetting) ||
                      findCode(context.tree, block, context.dialect, CodeRole::CoordinateShift);
    const Word *level = sets ? findWord(context.tree, block, 'Z') : nullptr;
    return level && level->isNumber() && !level->number().isZero() ? level : nullptr;
  }
  /// `10MM ABOVE`
  static bool namesRise(std::string_view remark, double rise) {
    if (rise <= 0 || remark.find("ABOVE") == std::string_view::npos)
      return false;
    const auto isOfNumber = [](char c) { return isDigit(c) || c == '.'; };
    for (auto at = std::ranges::find_if(remark, isOfNumber); at != remark.end();) {
      const auto end = std::find_if_not(at, remark.end(), isOfNumber);
      if (std::abs(std::strtod(std::string(at, end).c_str(), nullptr) - rise) < 1e-6)
        return true;
      at = std::find_if(end, remark.end(), isOfNumber);
    }
    return false;
  }

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
  std::map<NodeId, HeightOfRemark> ofRemarks_;
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
