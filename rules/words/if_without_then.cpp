// if-without-then: `IF[#1EQ0]#2=1`.
#include "findings/rule/rule.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::if_without_then {
namespace {

bool leaves(CodeRole role) {
  return role == CodeRole::Return || role == CodeRole::SubprogramCall || role == CodeRole::LocalCall ||
         role == CodeRole::ExternalCall || role == CodeRole::MacroCall;
}

/// Where THEN may be left out, a statement, a call or a return may follow the condition; words for the machine may not.
bool mayFollowCondition(Span action, const FileContext &context) {
  const auto words = context.tree.wordsOf(context.tree.blockAt(action.begin));
  const auto isAction = [&](const Word &word) { return word.has(Word::kAfterThen); };
  return std::none_of(words.begin(), words.end(), isAction) ||
         std::any_of(words.begin(), words.end(), [&](const Word &word) {
           const Code *code = isAction(word) ? codeOf(word, context.dialect) : nullptr;
           return code && leaves(code->role);
         });
}

/// Words for the machine under a condition: no manual of such a control has the form, and none says that it stops.
void reportWords(const SyntaxIssue &issue, const Reporter &reporter) {
  reporter.report({.message = "words follow the condition without `THEN`",
                   .span = issue.span,
                   .labels = {{issue.other, "the IF"}},
                   .notes = {"the manual has no such form: the control stops, or executes the words whatever the "
                             "condition",
                             "write the words in a block of their own, and jump over it with the opposite condition"}},
                  Severity::Warning);
}

void check(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.grammar.thenMayBeOmitted) {
    if (!mayFollowCondition(issue.span, context))
      reportWords(issue, reporter);
    return;
  }
  reporter.report({.message = "`THEN` or `GOTO` is missing after the condition",
                   .span = issue.span,
                   .labels = {{issue.other, "the IF"}},
                   .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::IfFormat)),
                             context.dialect.grammar.thenMayBeWords
                                 ? "write THEN before the action"
                                 : "write THEN before a macro statement; to skip words, write them in the next block "
                                   "and jump over it: `IF[#1NE#2]GOTO20`"}});
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::IfWithoutThen};

} // namespace

extern const Rule ifWithoutThen;
const Rule ifWithoutThen{.info = {"if-without-then", Category::Syntax, Severity::Error,
                                  "Reports an `IF` whose action follows the condition without `THEN` or `GOTO`."},
                         .hooks = {.issue = check, .issueKinds = kIssues}};

} // namespace feedhold::rules::if_without_then
