// brackets-too-deep: brackets inside one another beyond the limit.
#include "findings/rule/rule.h"

#include "rules/expressions/expression_view.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::brackets_too_deep {
namespace {

bool opensBracket(const SyntaxTree &tree, ExpressionId id) {
  return as<Bracketed>(tree, id) || as<FunctionCall>(tree, id) || as<IndirectVariable>(tree, id);
}

void tooDeep(Span span, std::string seen, const FileContext &context, const Reporter &reporter) {
  reporter.report({.message = std::move(seen),
                   .span = span,
                   .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::BracketNesting)),
                             "compute the inner part in a separate statement first"}});
}

/// The most brackets inside one another from `id` down.  The spans of nested nodes nest, and subexpressions() goes
/// from the outside in, so a stack of the open ends is enough.
std::size_t bracketDepth(const SyntaxTree &tree, ExpressionId id) {
  std::vector<std::uint32_t> openEnds;
  std::size_t deepest = 0;
  for (const ExpressionId node : subexpressions(tree, id)) {
    if (!opensBracket(tree, node))
      continue;
    const Span span = tree.expressions[node].span;
    while (!openEnds.empty() && openEnds.back() <= span.begin)
      openEnds.pop_back();
    openEnds.push_back(span.end);
    deepest = std::max(deepest, openEnds.size());
  }
  return deepest;
}

/// Called for every node: the one whose depth is just beyond the limit speaks for all around it.
void checkNode(ExpressionId id, BlockId, const FileContext &context, const Reporter &reporter) {
  const std::size_t limit = context.dialect.limits.bracketDepth;
  const Span span = context.tree.expressions[id].span;
  const std::string_view text = context.text(span);
  const bool canBeTooDeep = static_cast<std::size_t>(std::ranges::count(text, '[')) > limit;
  if (!canBeTooDeep || bracketDepth(context.tree, id) != limit + 1)
    return;
  tooDeep(span, fmt::format("brackets nested {} deep; this control allows {}", limit + 1, limit), context, reporter);
}

void checkIssue(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  if (context.text(issue.span) == "[") // checkNode() speaks of brackets
    return;
  tooDeep(issue.span, "this expression is nested too deep, or too long, to be read", context, reporter);
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::NestingTooDeep};

} // namespace

extern const Rule bracketsTooDeep;
const Rule bracketsTooDeep{
    .info = {"brackets-too-deep", Category::Expression, Severity::Error,
             "Reports brackets nested deeper than the control allows, function brackets included."},
    .hooks = {.issue = checkIssue,
              .issueKinds = kIssues,
              .expression = checkNode,
              .expressionNodes = nodeSet<Bracketed, FunctionCall, IndirectVariable>()}};

} // namespace feedhold::rules::brackets_too_deep
