// cut-above-start: `#3=10.(DEPTH)`, and at Z5 `G01 Z#3`.
#include "rules/flow/flow_view.h"
#include "rules/motion/motion_view.h"

#include "base/support/text.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <map>

namespace feedhold::rules::cut_above_start {
namespace {

constexpr std::array<std::string_view, 7> kDepths = {"DEPTH",   "TIEFE",    "PROFOND",  "PROFUND",
                                                     "GLUBINA", "DERINLIK", "KEDALAMAN"};

/// The remark speaks of a level above it.
constexpr std::array<std::string_view, 4> kLevels = {"CLEAR", "SAFE", "RETRACT", "ABOVE"};

/// Of the variable whose value is the whole Z of the block.
struct Depth {
  const Word *word;
  std::uint32_t variable;
};

class CutAboveStart final : public FlowRule {
public:
  CutAboveStart(ProgramId program, const FileContext &context)
      : view_(program, context), asked_(context.dialect.machine == MachineKind::Milling) {}

  void before(NodeId node, const AbstractState &state) override {
    if (!asked_ || !view_.mayHave(node, 'Z') || isHavocked(state))
      return;
    start_ = node;
    level_ = state.at(Axis::Z).number().interval();
  }
  void after(NodeId node, const AbstractState &state) override {
    if (start_ != node)
      return;
    start_.reset();
    const Interval end = state.at(Axis::Z).number().interval();
    const bool rises = level_ && !isHavocked(state) && end.lo > level_->hi && end.lo > 0 &&
                       view_.surely(state, ModalKind::Motion, {CodeAction::Linear}) &&
                       view_.surely(state, ModalKind::Distance, {CodeAction::Absolute});
    const auto [at, isNew] = rises_.emplace(node, rises);
    if (!isNew)
      at->second = at->second && rises;
  }

  void report(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) override {
    for (const auto &[node, rises] : rises_) {
      const auto depth = rises ? depthIn(node, facts) : std::nullopt;
      const Comment *remark = depth ? remarkOf(depth->variable, facts) : nullptr;
      if (!remark)
        continue;
      const std::string name = facts.programs.nameOfVariable(depth->variable);
      reporter.report(
          {.message = fmt::format("{} is above the level at which this move begins: the tool goes up to its depth",
                                  context.quoted(depth->word->span())),
           .span = depth->word->span(),
           .labels = {{remark->span, "a depth"}},
           .notes = {fmt::format("`{}` is positive, and Z points up: the tool does not cut", name),
                     fmt::format("write `Z-{}`, or give the depth its sign", name)}});
      return;
    }
  }

private:
  std::optional<Depth> depthIn(NodeId node, const FlowFacts &facts) const {
    const auto words = view_.modalMotionWords(node);
    if (words.size() != 1 || words.front()->address() != 'Z' || words.front()->form() != WordForm::Expression)
      return std::nullopt;
    const auto variable = variableOf(facts, unwrapped(view_.context().tree, words.front()->expression()));
    return variable ? std::optional(Depth{words.front(), *variable}) : std::nullopt;
  }
  /// Beside the only assignment to the variable.
  const Comment *remarkOf(std::uint32_t variable, const FlowFacts &facts) const {
    const Comment *found = nullptr;
    int writes = 0;
    for (NodeId node = facts.entry(); node < facts.end(); node = node.next()) {
      if (std::ranges::none_of(assignmentsOf(facts, node), [&](const Assignment &assignment) {
            return variableOf(facts, assignment.target) == variable;
          }))
        continue;
      ++writes;
      for (const Comment &comment : view_.context().tree.commentsOf(view_.node(node).block))
        found = speaksOfDepth(comment) ? &comment : found;
    }
    return writes == 1 ? found : nullptr;
  }
  bool speaksOfDepth(const Comment &comment) const {
    const std::string text = toUpper(view_.context().text(comment.span));
    const auto has = [&](std::string_view word) { return text.find(word) != std::string::npos; };
    return std::ranges::any_of(kDepths, has) && std::ranges::none_of(kLevels, has);
  }

  MotionView view_;
  bool asked_;
  std::optional<NodeId> start_;
  std::optional<Interval> level_; // at start_
  std::map<NodeId, bool> rises_;
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<CutAboveStart>(program, context);
}

} // namespace

extern const Rule cutAboveStart;
const Rule cutAboveStart{.info = {"cut-above-start", Category::Motion, Severity::Warning,
                                  "Reports a cut to a depth that lies above the level at which the tool stands."},
                         .hooks = {.watch = watch}};

} // namespace feedhold::rules::cut_above_start
