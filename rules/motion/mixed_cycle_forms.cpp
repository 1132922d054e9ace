// mixed-cycle-forms: `G71 P100 Q110 D.035`, and below `G71 U.035 R0.`
#include "findings/rule/rule.h"

#include <fmt/format.h>

namespace feedhold::rules::mixed_cycle_forms {
namespace {

/// Controls take a roughing cycle in one block, with its depth of cut as D, or in two, with the depth in the first one.
struct Forms {
  const Word *one = nullptr;
  const Word *two = nullptr;
};

void note(const Word &code, BlockId block, const FileContext &context, Forms &forms) {
  const auto has = [&](char address) { return findWord(context.tree, block, address) != nullptr; };
  if (has('P') && has('Q') && has('D') && !forms.one)
    forms.one = &code;
  if (!has('P') && !has('Q') && (has('U') || has('W')) && has('R') && !forms.two)
    forms.two = &code;
}

void check(ProgramId program, const FileContext &context, const Reporter &reporter) {
  if (context.dialect.machine != MachineKind::Turning)
    return;
  Forms forms;
  const Program &its = context.model.programs[program];
  for (BlockId block = its.first; block < its.last; block = block.next()) {
    if (const Word *code =
            findAction(context.tree, block, context.dialect, {CodeAction::TurnContour, CodeAction::FaceContour}))
      note(*code, block, context, forms);
  }
  if (!forms.one || !forms.two)
    return;
  const bool isLater = forms.two->span().begin > forms.one->span().begin;
  const Word &told = isLater ? *forms.two : *forms.one;
  const Word &other = isLater ? *forms.one : *forms.two;
  reporter.report({.message = fmt::format("{} has the form of {}, and the program has the other form, too",
                                          context.quoted(told.span()), isLater ? "two blocks" : "one block"),
                   .span = told.span(),
                   .labels = {{other.span(), isLater ? "in one block, with D" : "in two blocks"}},
                   .notes = {"a control takes a roughing cycle in one of the forms only, and stops at the other, or "
                             "reads another depth of cut",
                             "write both as this control has them"}});
}

} // namespace

extern const Rule mixedCycleForms;
const Rule mixedCycleForms{
    .info = {"mixed-cycle-forms", Category::Motion, Severity::Warning,
             "Reports a program of a lathe that writes roughing cycles in one block and in two."},
    .hooks = {.program = check}};

} // namespace feedhold::rules::mixed_cycle_forms
