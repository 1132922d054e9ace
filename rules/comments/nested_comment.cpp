// nested-comment: `(A (B) C)`: `C)` is read as program.
#include "findings/rule/dead_blocks.h"

#include <algorithm>
#include <fmt/format.h>
#include <span>

namespace feedhold::rules::nested_comment {
namespace {

/// `(A (B) C)` as a control reads it.
struct Parts {
  Span whole; // as it was meant
  Span open;  // the inner `(`
  Span close; // the `)` that ends the comment
  Span rest;  // behind it
};

Parts partsOf(const SyntaxIssue &issue, const FileContext &context) {
  const std::uint32_t end = issue.other.begin + static_cast<std::uint32_t>(context.text(issue.other).find(')')) + 1;
  return {issue.other, issue.span, {end - 1, end}, {end, issue.other.end}};
}

/// Only a `)` is left over, or several.
bool losesNothing(const Parts &parts, const FileContext &context) {
  return context.text(parts.rest).find_first_not_of(") \t") == std::string_view::npos;
}

/// Takes out all parentheses but the outer ones.
void unnest(const Parts &parts, const FileContext &context, FixIt &fix) {
  const std::string_view text = context.text(parts.whole);
  for (std::uint32_t i = 1; i + 1 < text.size(); ++i)
    if (text[i] == '(' || text[i] == ')')
      fix.edits.push_back({{parts.whole.begin + i, parts.whole.begin + i + 1}, ""});
}

/// `(A (B)` with nothing behind it: only an interpreter that stops at the inner `(` minds.
void addAtEnds(std::vector<Parts> &found, NeverExecuted &never, const FileContext &context) {
  const std::size_t known = found.size(); // in order of the text
  for (const Comment &comment : context.tree.comments) {
    const std::string_view text = context.text(comment.span);
    const std::size_t open = comment.closed && text.starts_with('(') ? text.find('(', 1) : std::string_view::npos;
    const bool isKnown = std::ranges::binary_search(std::span(found).first(known), comment.span.begin, {},
                                                    [](const Parts &parts) { return parts.whole.begin; });
    const BlockId block = context.tree.blockAt(comment.span.begin);
    if (open == std::string_view::npos || isKnown || context.tree.blocks[block].has(Block::kAfterEnd) ||
        never.contains(block))
      continue;
    const auto inside = static_cast<std::uint32_t>(comment.span.begin + open);
    found.push_back({comment.span,
                     {inside, inside + 1},
                     {comment.span.end - 1, comment.span.end},
                     {comment.span.end, comment.span.end}});
  }
  std::ranges::sort(found, {}, [](const Parts &parts) { return parts.whole.begin; });
}

std::vector<Parts> nestedIn(const FileContext &context) {
  NeverExecuted never(context);
  std::vector<Parts> found;
  for (const SyntaxIssue &issue : context.tree.issues)
    if (issue.kind == SyntaxIssueKind::NestedComment && !never.contains(context.tree.blockAt(issue.span.begin)))
      found.push_back(partsOf(issue, context));
  if (context.dialect.grammar.oWords)
    addAtEnds(found, never, context);
  return found;
}

/// Haas controls save such comments themselves; what they make of text behind the first `)` is not documented.  Nor is
/// what others make of a lone `)`, which shops have in programs that run.
Severity severityFor(bool isHarmless, const FileContext &context) {
  if (!context.dialect.grammar.commentsMayNest)
    return isHarmless && !context.dialect.grammar.oWords ? Severity::Warning : Severity::Error;
  return isHarmless ? Severity::Info : Severity::Warning;
}

/// A habit of an author or of a generator: one finding for the file, at the first place that matters most, and one fix.
void check(const FileContext &context, const Reporter &reporter) {
  const std::vector<Parts> found = nestedIn(context);
  if (found.empty())
    return;
  const auto harmless = [&](const Parts &parts) { return losesNothing(parts, context); };
  const auto worst = std::ranges::find_if_not(found, harmless);
  const bool isHarmless = worst == found.end();
  const Parts &first = isHarmless ? found.front() : *worst;
  const bool stopsInside = context.dialect.grammar.oWords;
  Diagnostic diagnostic;
  if (stopsInside) {
    diagnostic.message = "a `(` inside a comment";
    diagnostic.span = first.open;
    diagnostic.notes = {"the interpreter stops here: nested comment found"};
  } else {
    diagnostic.message = fmt::format("{} is outside the comment", context.quoted(first.rest));
    diagnostic.span = first.rest;
    diagnostic.labels = {{first.open, "this `(` does not open a comment"}, {first.close, "the comment ends here"}};
    diagnostic.notes = {isHarmless ? "some controls stop at a `)` outside a comment, others ignore it"
                        : context.dialect.grammar.commentsMayNest
                            ? "comments do not nest: the control may read the text after the first `)` as program"
                            : "comments do not nest: the control reads the text after the first `)` as program"};
  }
  if (found.size() > 1)
    diagnostic.notes.push_back(fmt::format("{} comments of this file have parentheses inside", found.size()));
  FixIt fix{isHarmless ? FixSafety::Safe : FixSafety::NeedsReview, "remove the inner parentheses", {}};
  for (const Parts &parts : found)
    unnest(parts, context, fix);
  diagnostic.fixes.push_back(std::move(fix));
  reporter.report(std::move(diagnostic), severityFor(isHarmless, context));
}

constexpr SyntaxIssueKind kIssues[] = {SyntaxIssueKind::NestedComment};

} // namespace

extern const Rule nestedComment;
const Rule nestedComment{
    .info =
        {"nested-comment", Category::Comment, Severity::Error,
         "Reports parentheses inside a comment: the comment ends at the first `)`, and the rest is read as program."},
    .hooks = {.issueKinds = kIssues, .file = check}};

} // namespace feedhold::rules::nested_comment
