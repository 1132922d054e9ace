// unused-variable: a main program sets `#5` and nothing reads it.
#include "rules/flow/flow_view.h"

#include <algorithm>
#include <fmt/format.h>

namespace feedhold::rules::unused_variable {
namespace {

/// Nothing but the text of the program reads its local variables.
bool isTransparent(const FlowFacts &facts) {
  const ProgramFile &file = facts.file;
  for (const Call &call : file.model->callsOf(facts.program))
    if (call.kind != CallKind::Macro && call.kind != CallKind::Modal && call.kind != CallKind::ModalCancel &&
        call.kind != CallKind::Local)
      return false;
  for (const BlockId block : blocksOf(file, facts.program))
    if (file.tree->blocks[block].has(Block::kBroken))
      return false;
  return std::ranges::all_of(file.model->variablesOf(facts.program), [&](const VariableUse &use) {
    return use.write || use.number || !as<IndirectVariable>(*file.tree, use.expression) ||
           readsOf(file, use.block).size() > 1;
  });
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  if (!isMainProgram(facts) || !isTransparent(facts))
    return;
  const auto uses = context.model.variablesOf(facts.program);
  std::vector<std::uint32_t> done;
  for (const VariableUse &use : uses) {
    if (!use.write || !use.number || !isLocal(facts.file, *use.number) ||
        std::ranges::find(done, *use.number) != done.end())
      continue;
    done.push_back(*use.number);
    if (std::ranges::any_of(uses, [&](const VariableUse &each) { return !each.write && each.number == use.number; }))
      continue;
    const Span span = context.tree.expressions[use.expression].span;
    reporter.report({.message = fmt::format("{} is set but never used", context.quoted(span)),
                     .span = span,
                     .notes = {"the value has no effect; a word or a call may have the wrong variable number"}});
  }
}

} // namespace

extern const Rule unusedVariable;
const Rule unusedVariable{.info = {"unused-variable", Category::Flow, Severity::Info,
                                   "Reports a local variable that a main program sets but never uses."},
                          .hooks = {.flow = check}};

} // namespace feedhold::rules::unused_variable
