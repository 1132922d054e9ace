// unchecked-touches: two skip moves to the same end point, and only the difference of what they found is looked at.
#include "rules/flow/system_variables.h"
#include "rules/motion/touch_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

namespace feedhold::rules::unchecked_touches {
namespace {

/// `#100=#5061` behind `G31 X50.`.
struct Touch {
  NodeId skip;
  const Word *end; // of the axis
};

class Touches {
public:
  Touches(const FlowFacts &facts, const FileContext &context)
      : facts_(facts), context_(context), view_(facts.program, context) {
    findTouches();
    if (touches_.size() > 1)
      for (bool grows = true; grows;)
        grows = follow();
  }

  /// The condition that looks at a difference; null where some condition looks at a touch itself, or none at any.
  const Test *comparison() const {
    const Test *found = nullptr;
    if (!first_)
      return nullptr;
    for (NodeId node = facts_.entry(); node < facts_.end(); node = node.next()) {
      const auto *test = std::get_if<Test>(&facts_.node(node).instruction);
      if (!test || !test->condition)
        continue;
      for (const Read &read : readsIn(facts_.file, *test->condition, facts_.node(node).block)) {
        const auto number = variableOf(facts_, read.expression);
        if (!number || touches_.contains(*number) || direct_.contains(*number) ||
            roleOf(context_, *number) != VariableRole::Plain)
          return nullptr;
        if (!found && differences_.contains(*number))
          found = test;
      }
    }
    return found;
  }
  Span first() const { return view_.blockSpan(first_->skip); }
  Span second() const { return view_.blockSpan(second_->skip); }

private:
  void findTouches() {
    std::set<std::uint32_t> again;
    for (NodeId node = facts_.entry(); node < facts_.end(); node = node.next())
      for (const Assignment &assignment : assignmentsOf(facts_, node)) {
        const auto target = variableOf(facts_, assignment.target);
        if (!target || !facts_.isReached(node))
          continue;
        const auto touch = again.insert(*target).second ? touchOf(assignment.value, node) : std::nullopt;
        if (touch)
          touches_.emplace(*target, *touch);
        else
          touches_.erase(*target);
      }
  }
  std::optional<Touch> touchOf(ExpressionId value, NodeId node) const {
    const auto position = variableNumber(context_.tree, unwrapped(context_.tree, value));
    if (!position || roleOf(context_, *position) != VariableRole::SkipPosition)
      return std::nullopt;
    const auto axis = axisOfPosition(context_, *position);
    const auto skip = axis ? skipBefore(facts_, view_, node) : std::nullopt;
    if (!skip || view_.findAction(*skip, {CodeAction::Incremental}))
      return std::nullopt;
    for (const Word *word : view_.axisWords(*skip))
      if (word->address() == *axis && word->isNumber())
        return Touch{*skip, word};
    return std::nullopt;
  }
  const Touch *touchIn(ExpressionId id) const {
    const auto number = variableOf(facts_, unwrapped(context_.tree, id));
    const auto at = number ? touches_.find(*number) : touches_.end();
    return at == touches_.end() ? nullptr : &at->second;
  }
  /// `#101-#100`, of two moves to one end point.
  bool isDifference(ExpressionId id) const {
    const auto *operation = as<BinaryOperation>(context_.tree, id);
    if (!operation || operation->op != OperatorKind::Subtract)
      return false;
    const Touch *left = touchIn(operation->left);
    const Touch *right = touchIn(operation->right);
    return left && right && left->skip != right->skip && left->end->address() == right->end->address() &&
           left->end->number() == right->end->number();
  }
  void note(ExpressionId id) {
    if (first_)
      return;
    const auto *operation = as<BinaryOperation>(context_.tree, id);
    first_ = *touchIn(operation->left);
    second_ = *touchIn(operation->right);
    if (second_->skip < first_->skip)
      std::swap(first_, second_);
  }
  /// What is computed from a difference, and from a touch in another way.
  bool follow() {
    bool grows = false;
    for (NodeId node = facts_.entry(); node < facts_.end(); node = node.next())
      for (const Assignment &assignment : assignmentsOf(facts_, node)) {
        const auto target = variableOf(facts_, assignment.target);
        if (!target || touches_.contains(*target))
          continue;
        const auto parts = subexpressions(context_.tree, assignment.value);
        const auto difference = std::ranges::find_if(parts, [&](ExpressionId part) { return isDifference(part); });
        if (difference != parts.end()) {
          note(*difference);
          grows |= differences_.insert(*target).second;
          continue;
        }
        for (const ExpressionId part : parts)
          if (const auto number = variableOf(facts_, part)) {
            if (touches_.contains(*number) || direct_.contains(*number))
              grows |= direct_.insert(*target).second;
            else if (differences_.contains(*number))
              grows |= differences_.insert(*target).second;
          }
      }
    return grows;
  }

  const FlowFacts &facts_;
  const FileContext &context_;
  MotionView view_;
  std::map<std::uint32_t, Touch> touches_; // by the variable that holds the position
  std::set<std::uint32_t> differences_;
  std::set<std::uint32_t> direct_;
  std::optional<Touch> first_;
  std::optional<Touch> second_;
};

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (isTooLarge(facts) || !context.model.callsOf(facts.program).empty())
    return;
  const Touches touches(facts, context);
  const Test *test = touches.comparison();
  if (!test)
    return;
  const Span condition = context.tree.expressions[*test->condition].span;
  reporter.report(
      {.message = fmt::format("{} looks only at the difference of two touches", context.quoted(condition)),
       .span = condition,
       .labels = {{touches.first(), "without a signal this moves to its end point"},
                  {touches.second(), "and this to the same"}},
       .notes = {"if the probe touches nothing, both moves end at the same point, and the difference is 0",
                 "compare each position with the end point of its move, and raise an alarm when they are equal"}});
}

} // namespace

extern const Rule uncheckedTouches;
const Rule uncheckedTouches{.info = {"unchecked-touches", Category::Motion, Severity::Warning,
                                     "Reports two skip moves to the same end point, of which only the difference is "
                                     "checked."},
                            .hooks = {.flow = check}};

} // namespace feedhold::rules::unchecked_touches
