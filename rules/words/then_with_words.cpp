// then-with-words: `IF[#1EQ0]THEN F500`.
#include "findings/rule/rule.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::then_with_words {
namespace {

/// The words behind THEN, up to the end of the block.
Span wordsFrom(std::uint32_t begin, const FileContext &context) {
  const auto words = context.tree.wordsOf(context.tree.blockAt(begin));
  return {begin, words.empty() ? begin + 1 : std::max(begin + 1, words.back().span().end)};
}

void check(const SyntaxIssue &issue, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.grammar.thenMayBeWords)
    return;
  const Span words = wordsFrom(issue.span.begin, context);
  reporter.report({.message = fmt::format("{} after THEN is not a macro statement", context.quoted(words)),
                   .span = words,
                   .labels = {{issue.other, "the THEN"}},
                   .notes = {fmt::format("the control {}", stopsWith(context.dialect, AlarmKind::IfFormat)),
                             "jump over a block with these words, or set a variable here and use it in the word"}});
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::ThenWithWords};

} // namespace

extern const Rule thenWithWords;
const Rule thenWithWords{.info = {"then-with-words", Category::Syntax, Severity::Error,
                                  "Reports NC words after `THEN`, where the control accepts one macro statement only."},
                         .hooks = {.issue = check, .issueKinds = kIssues}};

} // namespace feedhold::rules::then_with_words
