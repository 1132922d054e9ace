// Depth-first search over the graph; each path carries what its conditions have decided.
#include "rules/flow/consistent_path.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>
#include <string>

namespace feedhold::rules {
namespace {

/// What conditions say of one number: that of a text, or the difference of two.
struct Range {
  std::string subject;
  std::vector<std::uint32_t> variables; // that occur in the text
  bool isSignal = false;                // 0 or 1
  double lo = -INFINITY;
  double hi = INFINITY;
  bool withoutLo = false;
  bool withoutHi = false;
  std::vector<double> excluded = {};

  bool allows(double value) const {
    return value >= lo && value <= hi && !(withoutLo && value == lo) && !(withoutHi && value == hi) &&
           std::ranges::find(excluded, value) == excluded.end();
  }
  bool isEmpty() const {
    if (isSignal)
      return !allows(0) && !allows(1);
    // Who writes GE 56 and LE 55 has whole numbers in mind.
    const bool isGap = withoutLo && withoutHi && lo + 1 == hi && lo == std::floor(lo);
    return lo > hi || (lo == hi && !allows(lo)) || isGap;
  }
  std::string text() const {
    return fmt::format("{}[{},{}{}{}{}", subject, lo, hi, withoutLo ? '(' : '.', withoutHi ? ')' : '.',
                       fmt::join(excluded, ";"));
  }
};

OperatorKind negated(OperatorKind relation) {
  if (relation == OperatorKind::Equal)
    return OperatorKind::NotEqual;
  if (relation == OperatorKind::NotEqual)
    return OperatorKind::Equal;
  if (relation == OperatorKind::GreaterThan)
    return OperatorKind::LessOrEqual;
  if (relation == OperatorKind::LessOrEqual)
    return OperatorKind::GreaterThan;
  return relation == OperatorKind::LessThan ? OperatorKind::GreaterOrEqual : OperatorKind::LessThan;
}

void restrict(Range &range, OperatorKind relation, double bound) {
  const bool upper = relation == OperatorKind::LessThan || relation == OperatorKind::LessOrEqual;
  const bool lower = relation == OperatorKind::GreaterThan || relation == OperatorKind::GreaterOrEqual;
  if (relation == OperatorKind::NotEqual) {
    range.excluded.push_back(bound);
    std::ranges::sort(range.excluded);
  }
  if ((upper || relation == OperatorKind::Equal) && bound <= range.hi) {
    range.withoutHi = relation == OperatorKind::LessThan || (range.withoutHi && bound == range.hi);
    range.hi = bound;
  }
  if ((lower || relation == OperatorKind::Equal) && bound >= range.lo) {
    range.withoutLo = relation == OperatorKind::GreaterThan || (range.withoutLo && bound == range.lo);
    range.lo = bound;
  }
  if (relation == OperatorKind::Equal && (bound > range.hi || bound < range.lo))
    range.lo = INFINITY; // no number is both
}

using Ranges = std::vector<Range>;

class PathSearch {
public:
  PathSearch(const FlowFacts &facts, NodeId to, const std::function<bool(NodeId)> &blocked)
      : facts_(facts), tree_(*facts.file.tree), to_(to), blocked_(blocked) {}

  std::optional<std::vector<NodeId>> run() {
    return go(facts_.entry(), {}, true) ? std::optional(path_) : std::nullopt;
  }

private:
  static constexpr std::size_t kMostSteps = 20'000;
  static constexpr std::size_t kLongestPath = 3'000; // each step of a path is a call

  bool go(NodeId node, Ranges ranges, bool fully) {
    if (++steps_ > kMostSteps || path_.size() > kLongestPath || !seen_.insert(keyOf(node, ranges, fully)).second)
      return false;
    path_.push_back(node);
    if (node == to_)
      return true;
    if (!blocked_(node) && leave(node, ranges, fully))
      return true;
    path_.pop_back();
    return false;
  }

  bool leave(NodeId node, Ranges &ranges, bool fully) {
    forget(node, ranges);
    std::vector<NodeId> nexts;
    forEachSuccessor(facts_.file.cfg, *facts_.file.model, node, ProgramUse::Called, [&](NodeId next) {
      if (next >= facts_.entry() && next < facts_.end() && facts_.isReached(next))
        nexts.push_back(next);
    });
    const auto *test = std::get_if<Test>(&facts_.node(node).instruction);
    if (!fully && !nexts.empty())
      nexts = {*std::ranges::min_element(nexts)}; // the body stands directly behind the WHILE
    for (const NodeId next : nexts) {
      Ranges decided = ranges;
      const bool isOnePath = nexts.size() == 2 || !fully;
      if (test && test->condition && isOnePath && test->taken != facts_.node(node).next &&
          !assume(*test->condition, next == test->taken, decided))
        continue;
      if (go(next, std::move(decided), !isWhile(next) || node > next))
        return true;
    }
    return false;
  }

  bool isWhile(NodeId node) const {
    const auto statements = tree_.statementsOf(facts_.node(node).block);
    return std::holds_alternative<Test>(facts_.node(node).instruction) &&
           std::ranges::any_of(statements, [](const Statement &s) { return std::holds_alternative<While>(s.node); });
  }

  /// False: it contradicts what was decided before.
  bool assume(ExpressionId condition, bool holds, Ranges &ranges) {
    const auto *operation = asInside<BinaryOperation>(tree_, condition);
    if (!operation)
      return true;
    if ((operation->op == OperatorKind::And && holds) || (operation->op == OperatorKind::Or && !holds))
      return assume(operation->left, holds, ranges) && assume(operation->right, holds, ranges);
    if (!isRelation(operation->op))
      return true;
    Range &range = rangeOf(*operation, ranges);
    restrict(range, holds ? operation->op : negated(operation->op), numberOf(operation->right).value_or(0));
    return !range.isEmpty();
  }

  std::optional<double> numberOf(ExpressionId id) const {
    const auto value = literalValue(tree_, id);
    return value ? std::optional(value->toDouble()) : std::nullopt;
  }

  Range &rangeOf(const BinaryOperation &relation, Ranges &ranges) {
    std::string subject = compact(relation.left);
    if (!numberOf(relation.right))
      subject += '|' + compact(relation.right);
    const auto found = std::ranges::find(ranges, subject, &Range::subject);
    if (found != ranges.end())
      return *found;
    Range range{subject, {}};
    for (const ExpressionId side : {relation.left, relation.right})
      for (const ExpressionId part : subexpressions(tree_, side))
        if (const auto number = variableNumber(tree_, part))
          range.variables.push_back(*number);
    range.isSignal = isSignal(relation.left);
    ranges.push_back(std::move(range));
    return ranges.back();
  }

  bool isSignal(ExpressionId id) const {
    const auto number = variableNumber(tree_, unwrapped(tree_, id));
    const VariableRange *range = number ? findVariable(*facts_.file.dialect, *number) : nullptr;
    return range && isVolatile(range->role) && range->access == VariableAccess::ReadOnly && range->name != "_UIL" &&
           range->meaning.find("input") != std::string_view::npos;
  }

  /// The text without blanks and outer brackets.
  std::string compact(ExpressionId id) const {
    std::string text;
    for (const char c : facts_.file.source->text(tree_.expressions[unwrapped(tree_, id)].span))
      if (c != ' ' && c != '\t')
        text += c;
    return text;
  }

  void forget(NodeId node, Ranges &ranges) const {
    const Instruction &instruction = facts_.node(node).instruction;
    if (std::holds_alternative<Havoc>(instruction))
      ranges.clear();
    if (std::holds_alternative<CallProgram>(instruction))
      std::erase_if(ranges, [](const Range &range) {
        return std::ranges::any_of(range.variables, [](std::uint32_t each) { return each > kLocalVariables; });
      });
    for (const Assignment &assignment : assignmentsOf(facts_, node)) {
      const auto target = variableNumber(tree_, unwrapped(tree_, assignment.target));
      std::erase_if(ranges, [&](const Range &range) {
        return !target || std::ranges::find(range.variables, *target) != range.variables.end();
      });
      if (const auto value = numberOf(assignment.value); target && value)
        ranges.push_back({.subject = compact(assignment.target), .variables = {*target}, .lo = *value, .hi = *value});
    }
  }

  std::string keyOf(NodeId node, const Ranges &ranges, bool fully) const {
    std::vector<std::string> texts;
    for (const Range &range : ranges)
      texts.push_back(range.text());
    std::ranges::sort(texts);
    std::string key = std::to_string(node.index()) + (fully ? "" : "/");
    for (const std::string &text : texts)
      key += ' ' + text;
    return key;
  }

  const FlowFacts &facts_;
  const SyntaxTree &tree_;
  NodeId to_;
  const std::function<bool(NodeId)> &blocked_;
  std::vector<NodeId> path_;
  std::set<std::string> seen_;
  std::size_t steps_ = 0;
};

} // namespace

std::optional<std::vector<NodeId>> findConsistentPath(const FlowFacts &facts, NodeId to,
                                                      const std::function<bool(NodeId)> &blocked) {
  return PathSearch(facts, to, blocked).run();
}

} // namespace feedhold::rules
