// function-arguments: `POW[2]`, `ATAN[#1]` where two are wanted.
#include "findings/rule/rule.h"

#include "rules/expressions/expression_view.h"

#include <fmt/format.h>

namespace feedhold::rules::function_arguments {
namespace {

std::string_view wantedBy(FunctionForm form) {
  switch (form) {
  case FunctionForm::OneArgument: return "one argument";
  case FunctionForm::OneOrTwo: return "one argument, or two: `[a]/[b]` or `[a,b]`";
  case FunctionForm::TwoBySlash: return "two arguments: `[a]/[b]`";
  case FunctionForm::TwoByComma: return "two arguments: `[a,b]`";
  case FunctionForm::ParameterRead: return "`[number]` or `[number,bit]`, with `/[axis]` after it";
  }
  return {};
}

bool fits(const FunctionCall &call, FunctionForm form) {
  switch (form) {
  case FunctionForm::OneArgument: return call.arguments().size() == 1;
  case FunctionForm::OneOrTwo: return call.arguments().size() == 1 || call.arguments().size() == 2;
  case FunctionForm::TwoBySlash: return call.arguments().size() == 2 && call.slash;
  case FunctionForm::TwoByComma: return call.arguments().size() == 2 && !call.slash;
  case FunctionForm::ParameterRead: return call.arguments().size() >= 1;
  }
  return true;
}

std::vector<std::string> notesFor(const FileContext &context) {
  return {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::FunctionArguments))};
}

void checkCall(ExpressionId id, BlockId, const FileContext &context, const Reporter &reporter) {
  const auto *call = as<FunctionCall>(context.tree, id);
  const Function *function = call ? findFunction(context.dialect, call->function) : nullptr;
  if (!function || call->arguments().empty() || fits(*call, function->form))
    return;
  reporter.report({.message = fmt::format("`{}` takes {}", spellingOf(call->function), wantedBy(function->form)),
                   .span = context.tree.expressions[id].span,
                   .notes = notesFor(context)});
}

void checkIssue(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  reporter.report({.message = fmt::format("{} is not a valid list of function arguments", context.quoted(issue.span)),
                   .span = issue.span,
                   .notes = notesFor(context)});
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::FunctionArguments};

} // namespace

extern const Rule functionArguments;
const Rule functionArguments{.info = {"function-arguments", Category::Expression, Severity::Error,
                                      "Reports a function with the wrong number or form of arguments."},
                             .hooks = {.issue = checkIssue,
                                       .issueKinds = kIssues,
                                       .expression = checkCall,
                                       .expressionNodes = nodeSet<FunctionCall>()}};

} // namespace feedhold::rules::function_arguments
