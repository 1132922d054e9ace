// repeated-o-word: two `o100 if` in one program.
#include "rules/structure/structure_view.h"

#include <fmt/format.h>

#include <map>
#include <utility>

namespace feedhold::rules::repeated_o_word {
namespace {

void check(const FileContext &context, const Reporter &reporter) {
  std::map<std::pair<ProgramId, std::string>, const OWordUse *> first;
  for (const Construct &construct : context.model.constructs) {
    const OWordUse &head = context.model.oWords[construct.parts.front()];
    if (construct.kind == OWordKind::Sub || head.label.empty())
      continue;
    const auto [known, isNew] = first.try_emplace(std::pair(head.program, head.label), &head);
    if (isNew || known->second == nullptr)
      continue;
    const Span span = context.tree.statements[head.statement].span;
    reporter.report(
        {.message = fmt::format("{} has the label of an earlier o-word of this program", context.quoted(span)),
         .span = span,
         .labels = {{context.tree.statements[known->second->statement].span, "first used here"}},
         .notes = {"what the interpreter does with a label that is used twice is not defined",
                   "give each o-word block its own number"}});
    known->second = nullptr; // once for each label
  }
}

} // namespace

extern const Rule repeatedOWord;
const Rule repeatedOWord{.info = {"repeated-o-word", Category::Structure, Severity::Info,
                                  "Reports an o-word block with the label of an earlier one in the same program."},
                         .hooks = {.file = check}};

} // namespace feedhold::rules::repeated_o_word
