// unmatched-o-word: `o103 if` without `o103 endif`, and the other way round.
#include "findings/rule/rule.h"

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

void reportOpen(const OWordUse &head, const FileContext &context, const Reporter &reporter) {
  const Span span = context.tree.statements[head.statement].span;
  reporter.report(
      {.message = fmt::format("{} has no `o{} {}`", context.quoted(span), spelled(head.label), endOf(head.kind)),
       .span = span,
       .notes = {"the interpreter searches for it to the end of the file and stops there"}});
}

/// A subroutine that is left by `return` works without its `endsub`.
bool isLeftByReturn(const Construct &construct, const ProgramModel &model) {
  const std::string &label = model.oWords[construct.parts.front()].label;
  return construct.kind == OWordKind::Sub &&
         std::any_of(model.oWords.begin(), model.oWords.end(),
                     [&](const auto &use) { return use.kind == OWordKind::Return && use.label == label; });
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

void check(const FileContext &context, const Reporter &reporter) {
  const ProgramModel &model = context.model;
  const std::set<std::string> parted = labelsParted(model);
  for (const OWordUse &use : model.oWords)
    if (!use.construct && !headOf(use.kind).empty() && !parted.contains(use.label))
      reportLone(use, context, reporter);
  for (const Construct &construct : model.constructs) {
    const OWordUse &head = model.oWords[construct.parts.front()];
    if (!construct.closed && !parted.contains(head.label) && !isLeftByReturn(construct, model))
      reportOpen(head, context, reporter);
  }
}

} // namespace

extern const Rule unmatchedOWord;
const Rule unmatchedOWord{.info = {"unmatched-o-word", Category::Structure, Severity::Error,
                                   "Reports an O-word block whose beginning or end is missing."},
                          .hooks = {.file = check}};

} // namespace feedhold::rules::unmatched_o_word
