// remark-of-other-direction: `G91 G1 Z-10 (move z axis up)`.
#include "rules/comments/remarks_of_block.h"
#include "rules/motion/motion_view.h"

#include <fmt/format.h>

#include <map>

namespace feedhold::rules::remark_of_other_direction {
namespace {

enum class Way : std::uint8_t { Up, Down };

std::optional<Way> wayIn(std::string_view remark) {
  const bool up = saysAny(remark, {" UP ", "UPWARD", "RETRACT", "RAISE", "LIFT "});
  const bool down = saysAny(remark, {" DOWN ", "DOWNWARD", "PLUNGE", "LOWER "});
  if (up == down || saysAny(remark, {"NOT ", "NO ", "THEN", "BEFORE", "AFTER", "BACK UP"}))
    return std::nullopt;
  return up ? Way::Up : Way::Down;
}

/// Remarks end with a parenthesis, or with the line.
std::string spaced(std::string remark) {
  for (char &c : remark)
    if (!isLetter(c) && !isDigit(c))
      c = ' ';
  return " " + remark + " ";
}

class RemarkOfOtherDirection final : public FlowRule {
public:
  RemarkOfOtherDirection(ProgramId program, const FileContext &context) : view_(program, context) {}

  void after(NodeId node, const AbstractState &state) override {
    if (!view_.mayHave(node, 'Z') || view_.context().tree.commentsOf(view_.node(node).block).empty())
      return;
    const auto words = view_.modalMotionWords(node);
    const bool isDistance = words.size() == 1 && words.front()->address() == 'Z' && words.front()->isNumber() &&
                            !words.front()->number().isZero() &&
                            view_.surely(state, ModalKind::Distance, {CodeAction::Incremental}) && !isHavocked(state) &&
                            !mayBeTrue(state.transformed);
    const auto way = isDistance ? wayIn(spaced(remarksOf(view_.context(), view_.node(node).block))) : std::nullopt;
    const bool isOther = way && (*way == Way::Up) == words.front()->number().isNegative();
    const auto [at, isNew] = found_.emplace(node, isOther ? words.front() : nullptr);
    if (!isNew && !isOther)
      at->second = nullptr;
  }
  void report(const FlowFacts &, const FileContext &context, const Reporter &reporter) override {
    for (const auto &[node, word] : found_) {
      if (!word)
        continue;
      const bool goesDown = word->number().isNegative();
      reporter.report(
          {.message = fmt::format("{} under `G91` moves {}, not {} as the remark says", context.quoted(word->span()),
                                  goesDown ? "down" : "up", goesDown ? "up" : "down"),
           .span = word->span(),
           .labels = {{context.tree.commentsOf(view_.node(node).block).front().span, "the remark"}},
           .notes = {"correct the sign, or the remark"}});
    }
  }

private:
  MotionView view_;
  std::map<NodeId, const Word *> found_; // null: in some run it is as the remark says
};

std::unique_ptr<FlowRule> watch(ProgramId program, const FileContext &context) {
  return std::make_unique<RemarkOfOtherDirection>(program, context);
}

} // namespace

extern const Rule remarkOfOtherDirection;
const Rule remarkOfOtherDirection{.info = {"remark-of-other-direction", Category::Comment, Severity::Warning,
                                           "Reports an incremental move of Z whose remark says the other direction."},
                                  .hooks = {.watch = watch}};

} // namespace feedhold::rules::remark_of_other_direction
