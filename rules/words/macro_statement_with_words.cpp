// macro-statement-with-words: `G00 X1. #1=2`.
#include "findings/rule/rule.h"

#include "rules/comments/remarks_of_block.h"
#include "rules/expressions/expression_view.h"
#include "rules/structure/structure_view.h"

#include <fmt/format.h>

namespace feedhold::rules::macro_statement_with_words {
namespace {

bool mayStandBeside(const Word &word) {
  return word.address() == 'N' || word.address() == 'O' || word.has(Word::kAfterThen);
}

/// Words under a condition belong to their statement.
bool takesWords(const Statement &statement) {
  return std::holds_alternative<ConditionalWords>(statement.node) ||
         std::holds_alternative<BrokenStatement>(statement.node) ||
         std::holds_alternative<LoneExpression>(statement.node);
}

std::string stopsAtMixed(const FileContext &context) {
  return fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::MixedBlock));
}

void reportLetter(Span code, const FileContext &context, const Reporter &reporter) {
  const Span letter{code.begin + 1, code.begin + 2};
  reporter.report({.message = fmt::format("{} has the letter O in place of the digit 0", context.quoted(code)),
                   .span = letter,
                   .notes = {fmt::format("the control reads it as `GOTO {}` and {}", context.text(code).back(),
                                         stopsWith(context.dialect, AlarmKind::MixedBlock))},
                   .fixes = {{.title = "write the digit 0", .edits = {{letter, "0"}}}}});
}

void checkStatement(const Statement &statement, BlockId block, const FileContext &context, const Reporter &reporter) {
  if (statement.nested || context.dialect.grammar.macroWithWords || takesWords(statement) ||
      firstStatement(context.tree, block) != &statement)
    return;
  for (const Word &word : context.tree.wordsOf(block)) {
    if (mayStandBeside(word))
      continue;
    if (isMotionCodeWithLetter(context, block, statement.span)) {
      reportLetter(statement.span, context, reporter);
      return;
    }
    reporter.report(
        {.message = fmt::format("{} is in the same block as a macro statement", context.quoted(word.span())),
         .span = word.span(),
         .labels = {{statement.span, "the macro statement"}},
         .notes = {stopsAtMixed(context), "put the macro statement in its own block"}});
    return;
  }
}

/// `#3006=1 (SIZE: ) #120`: another rule says what is wrong.
bool isValueOfMessage(const SyntaxIssue &issue, const FileContext &context) {
  return standsBehindRemark(context, issue.span) && context.text(issue.span).starts_with('#') &&
         context.text(issue.span).find('=') == std::string_view::npos;
}

void checkIssue(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.grammar.macroWithWords || isValueOfMessage(issue, context))
    return;
  const std::string second = context.quoted(issue.span);
  reporter.report({.message = fmt::format("{} is a second macro statement in one block", second),
                   .span = issue.span,
                   .labels = {{issue.other, "the first one"}},
                   .notes = {stopsAtMixed(context), fmt::format("write {} in a block of its own", second)}});
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::TwoStatements};

} // namespace

extern const Rule macroStatementWithWords;
const Rule macroStatementWithWords{
    .info = {"macro-statement-with-words", Category::Word, Severity::Error,
             "Reports a macro statement that shares its block with NC words or with another statement."},
    .hooks = {.issue = checkIssue, .issueKinds = kIssues, .statement = checkStatement}};

} // namespace feedhold::rules::macro_statement_with_words
