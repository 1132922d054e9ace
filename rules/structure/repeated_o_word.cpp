// repeated-o-word: two `o100 if` in one program.
#include "language/model/repeated_labels.h"
#include "rules/structure/structure_view.h"

#include <fmt/format.h>

#include <map>
#include <set>
#include <utility>

namespace feedhold::rules::repeated_o_word {
namespace {

/// `o103 sub` and, outside of subroutines, `o103 while`: the interpreter keeps one place for both (LinuxCNC,
/// interp_o_word.cc).  Within a subroutine labels are its own.
void checkSubs(const FileContext &context, const Reporter &reporter) {
  std::map<std::string, const OWordUse *> subs;
  for (const Construct &construct : context.model.constructs)
    if (const OWordUse &head = context.model.oWords[construct.parts.front()];
        construct.kind == OWordKind::Sub && !head.label.empty())
      subs.try_emplace(head.label, &head);
  for (const Construct &construct : context.model.constructs) {
    const OWordUse &head = context.model.oWords[construct.parts.front()];
    const auto sub = subs.find(head.label);
    if (construct.kind == OWordKind::Sub || sub == subs.end() || sub->second == nullptr ||
        context.model.programs[head.program].name.isSubroutine)
      continue;
    const Span span = context.tree.statements[head.statement].span;
    reporter.report({.message = fmt::format("{} has the label of a subroutine", context.quoted(span)),
                     .span = span,
                     .labels = {{context.tree.statements[sub->second->statement].span, "the subroutine"}},
                     .notes = {"the interpreter stops when it has met both: duplicate O-word label",
                               "give the block a number of its own"}},
                    Severity::Warning);
    sub->second = nullptr; // once for each label
  }
}

void check(const FileContext &context, const Reporter &reporter) {
  checkSubs(context, reporter);
  std::set<std::pair<ProgramId, std::string>> told;
  for (const auto &[id, repetition] : repeatedLabels(context.model)) {
    const OWordUse &head = context.model.oWords[context.model.constructs[id].parts.front()];
    const OWordUse &other = context.model.oWords[context.model.constructs[repetition.other].parts.front()];
    const bool isSure = repetition.kind == RepeatedLabel::Surely;
    if (other.block > head.block || !told.emplace(head.program, head.label).second)
      continue;
    const Span span = context.tree.statements[head.statement].span;
    reporter.report(
        {.message = fmt::format("{} has the label of an earlier o-word of this program", context.quoted(span)),
         .span = span,
         .labels = {{context.tree.statements[other.statement].span, "first used here"}},
         .notes = {isSure ? "the interpreter stops here: duplicate O-word label"
                          : "the interpreter stops when one run meets both: duplicate O-word label",
                   "give each o-word block its own number"}},
        isSure                                     ? Severity::Error
        : repetition.kind == RepeatedLabel::Rarely ? Severity::Info
                                                   : Severity::Warning);
  }
}

} // namespace

extern const Rule repeatedOWord;
const Rule repeatedOWord{
    .info = {"repeated-o-word", Category::Structure, Severity::Error,
             "Reports an o-word block with the label of a subroutine, or of an earlier block in the "
             "same program."},
    .hooks = {.file = check}};

} // namespace feedhold::rules::repeated_o_word
