// unread-argument: the call passes R, and nothing in the macro reads `#18`.
#include "rules/flow/flow_view.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::unread_argument {
namespace {

/// A read of `#[..]` may name the variable: only where the index says that it does not, the text tells.
bool readsComputed(const ProgramFile &file, const VariableUse &use) {
  if (use.write || use.number)
    return false;
  const auto *indirect = as<IndirectVariable>(*file.tree, use.expression);
  if (!indirect)
    return false;
  const auto parts = subexpressions(*file.tree, indirect->index);
  return std::ranges::none_of(parts, [&](ExpressionId part) {
    const auto value = literalValue(*file.tree, part);
    return value && *value > Decimal(kLocalVariables, 0);
  });
}

/// The text of the program says what it reads of its local variables.
bool isTransparent(const ProgramFile &file, ProgramId program) {
  for (const Call &call : file.model->callsOf(program))
    if (call.kind != CallKind::Macro && call.kind != CallKind::Modal && call.kind != CallKind::ModalCancel)
      return false;
  for (const BlockId block : blocksOf(file, program))
    if (file.tree->blocks[block].has(Block::kBroken))
      return false;
  return std::ranges::none_of(file.model->variablesOf(program),
                              [&](const VariableUse &use) { return readsComputed(file, use); });
}

bool reads(const ProgramFile &file, ProgramId program, std::uint32_t variable) {
  return std::ranges::any_of(file.model->variablesOf(program),
                             [&](const VariableUse &use) { return !use.write && use.number == variable; });
}

void check(CallId id, const FileContext &context, const Reporter &reporter) {
  const Call &call = context.model.calls[id];
  const auto callee = context.callGraph.callee(context.file, call);
  if ((call.kind != CallKind::Macro && call.kind != CallKind::Modal) || !callee)
    return;
  const ProgramFile &file = context.programs->file(callee->file);
  if (!isTransparent(file, callee->program))
    return;
  const Program &program = file.model->programs[callee->program];
  const Contract *contract = context.contractOf(*callee);
  for (const Argument &argument : call.arguments) {
    const Word &word = context.tree.words[argument.word];
    const bool passesNothing = word.form() == WordForm::Expression && isVacant(context, word.expression());
    // A letter of I, J, K out of order is reported as such.
    if (argument.role != ArgumentRole::Passed || argument.variable == 0 || argument.fromSet || passesNothing ||
        reads(file, callee->program, argument.variable))
      continue;
    // A parameter of the contract belongs to the interface, as the radius of the tool does, which no block needs.
    const bool isPromised = contract && contract->param(argument.variable);
    reporter.report({.message = fmt::format("{} never reads `#{}`: {} has no effect", toString(program.name),
                                            argument.variable, context.quoted(word.span())),
                     .span = word.span(),
                     .labels = {{program.header, "the called program", callee->file}},
                     .notes = {"probably another letter was meant, or the macro no longer needs it"}},
                    isPromised ? Severity::Info : Severity::Warning);
  }
}

void asksForPrograms(const FlowFacts &, const FileContext &, const Reporter &) {}

} // namespace

extern const Rule unreadArgument;
const Rule unreadArgument{.info = {"unread-argument", Category::Flow, Severity::Warning,
                                   "Reports an argument of a macro call that the macro never reads."},
                          .hooks = {.call = check, .flow = asksForPrograms}};

} // namespace feedhold::rules::unread_argument
