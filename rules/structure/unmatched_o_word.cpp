// unmatched-o-word: `o103 if` without `o103 endif`, and the other way round.
#include "base/support/text.h"
#include "rules/structure/structure_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>

namespace feedhold::rules::unmatched_o_word {
namespace {

std::string_view endOf(OWordKind kind) {
  switch (kind) {
  case OWordKind::If:
  case OWordKind::ElseIf:
  case OWordKind::Else:
  case OWordKind::EndIf: return "endif";
  case OWordKind::While:
  case OWordKind::EndWhile: return "endwhile";
  case OWordKind::Repeat:
  case OWordKind::EndRepeat: return "endrepeat";
  case OWordKind::Sub:
  case OWordKind::EndSub:
  case OWordKind::Return: return "endsub";
  case OWordKind::Do: return "while";
  case OWordKind::Call:
  case OWordKind::Break:
  case OWordKind::Continue: break;
  }
  return "";
}

std::string_view headOf(OWordKind kind) {
  switch (kind) {
  case OWordKind::ElseIf:
  case OWordKind::Else:
  case OWordKind::EndIf: return "if";
  case OWordKind::EndWhile: return "while";
  case OWordKind::EndRepeat: return "repeat";
  case OWordKind::EndSub:
  case OWordKind::Return: return "sub";
  case OWordKind::Break:
  case OWordKind::Continue: return "loop";
  case OWordKind::If:
  case OWordKind::While:
  case OWordKind::Do:
  case OWordKind::Repeat:
  case OWordKind::Sub:
  case OWordKind::Call: break;
  }
  return "";
}

void reportLone(const OWordUse &use, const FileContext &context, const Reporter &reporter) {
  const Span span = context.tree.statements[use.statement].span;
  reporter.report(
      {.message = fmt::format("{} has no `{}` with the same label", context.quoted(span), headOf(use.kind)),
       .span = span,
       .notes = {"the interpreter stops here, or pairs it with the wrong block", "use the same label for both ends"}});
}

/// A label that is no number stands in angle brackets.
std::string spelled(const std::string &label) {
  return std::ranges::all_of(label, [](char c) { return c >= '0' && c <= '9'; }) ? label : "<" + label + ">";
}

/// `o<foo>` and `o100` as OWordUse has them.
std::string labelOf(std::string_view word) {
  std::string_view label = trimmed(word.substr(1));
  if (label.starts_with('<') && label.ends_with('>'))
    return comparedName(label.substr(1, label.size() - 2));
  while (label.size() > 1 && label.starts_with('0'))
    label.remove_prefix(1);
  return std::string(label);
}

void reportOpen(const OWordUse &head, const FileContext &context, const Reporter &reporter) {
  const Span span = context.tree.statements[head.statement].span;
  reporter.report(
      {.message = fmt::format("{} has no `o{} {}`", context.quoted(span), spelled(head.label), endOf(head.kind)),
       .span = span,
       .notes = {"the interpreter searches for it to the end of the file and stops there"}});
}

/// A subroutine begins before the one around it has ended: `o<outer> endsub` comes behind `o100 sub`.
struct Nesting {
  const OWordUse *outer;
  const OWordUse *inner;
  BlockId end; // of the outer one
};
std::vector<Nesting> nestings(const ProgramModel &model) {
  std::vector<Nesting> found;
  const OWordUse *last = nullptr; // `sub` before
  for (const OWordUse &use : model.oWords) {
    if (use.kind != OWordKind::Sub || !use.construct)
      continue;
    const OWordUse *outer = last;
    last = &use;
    if (!outer || model.constructs[*outer->construct].closed || (!found.empty() && use.block < found.back().end))
      continue;
    const auto end = std::find_if(model.oWords.begin(), model.oWords.end(), [&](const OWordUse &other) {
      return other.kind == OWordKind::EndSub && other.label == outer->label && other.block > use.block;
    });
    if (end != model.oWords.end())
      found.push_back({outer, &use, end->block});
  }
  return found;
}

void reportNested(const Nesting &nesting, const FileContext &context, const Reporter &reporter) {
  const Span inner = context.tree.statements[nesting.inner->statement].span;
  const Span outer = context.tree.statements[nesting.outer->statement].span;
  const std::uint32_t line = context.source.lineOf(outer.begin);
  reporter.report(
      {.message = fmt::format("{} stands inside {} (line {})", context.quoted(inner), context.quoted(outer), line),
       .span = inner,
       .labels = {{outer, "this subroutine has not ended"}},
       .notes = {"subroutines do not nest: the interpreter stops here",
                 fmt::format("move it before line {}, or into a file of its own", line)}});
}

/// Labels that have a lone end and an open head: they do not meet because a construct between them is open itself, and
/// that one is reported.
std::set<std::string> labelsParted(const ProgramModel &model) {
  std::set<std::string> open;
  for (const Construct &construct : model.constructs)
    if (!construct.closed)
      open.insert(model.oWords[construct.parts.front()].label);
  std::set<std::string> parted;
  for (const OWordUse &use : model.oWords)
    if (!use.construct && open.contains(use.label) && open.size() > 1)
      parted.insert(use.label);
  return parted;
}

/// A block behind it begins with the label, and does not parse: `o<foo> ebdsub`.
bool isEndMisspelled(const OWordUse &head, const FileContext &context) {
  for (const SyntaxIssue &issue : context.tree.issues) {
    const BlockId block = context.tree.blockAt(issue.span.begin);
    if (issue.kind != SyntaxIssueKind::UnexpectedText || block <= head.block)
      continue;
    const auto words = context.tree.wordsOf(block);
    if (!words.empty() && words.front().address() == 'O' && labelOf(context.text(words.front().span())) == head.label)
      return true;
  }
  return false;
}

void check(const FileContext &context, const Reporter &reporter) {
  const ProgramModel &model = context.model;
  const std::set<std::string> parted = labelsParted(model);
  const std::vector<Nesting> nested = nestings(model);
  for (const Nesting &nesting : nested)
    reportNested(nesting, context, reporter);
  // What a subroutine inside another one tears apart is not reported once more.
  const auto isTold = [&](const OWordUse &use) {
    return parted.contains(use.label) || std::ranges::any_of(nested, [&](const Nesting &nesting) {
             return nesting.outer->block <= use.block && use.block <= nesting.end;
           });
  };
  for (const OWordUse &use : model.oWords)
    if (!use.construct && !headOf(use.kind).empty() && !isTold(use))
      reportLone(use, context, reporter);
  for (const Construct &construct : model.constructs) {
    const OWordUse &head = model.oWords[construct.parts.front()];
    const bool isOpen = !construct.closed && (construct.kind != OWordKind::Sub || isSubWithoutEnd(construct, context));
    if (isOpen && !isTold(head) && !isEndMisspelled(head, context))
      reportOpen(head, context, reporter);
  }
}

} // namespace

extern const Rule unmatchedOWord;
const Rule unmatchedOWord{.info = {"unmatched-o-word", Category::Structure, Severity::Error,
                                   "Reports an O-word block whose beginning or end is missing."},
                          .hooks = {.file = check}};

} // namespace feedhold::rules::unmatched_o_word
