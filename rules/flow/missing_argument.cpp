// missing-argument: the macro computes with `#18`, and the call does not pass R.
#include "rules/flow/flow_view.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <set>

namespace feedhold::rules::missing_argument {
namespace {

std::optional<Read> readAt(const ProgramFile &file, BlockId block, ExpressionId expression) {
  const auto reads = readsOf(file, block);
  const auto found = std::ranges::find(reads, expression, &Read::expression);
  return found == reads.end() ? std::nullopt : std::optional(*found);
}

/// The macro computes with the variable as if it were always there.  One that asks for its value in some condition
/// knows that it may be missing.
bool isRelied(const FlowFacts &facts, const VacantReadInCall &vacant) {
  const ProgramFile &file = facts.programs.file(vacant.read.file);
  const BlockId block = file.cfg.nodes[vacant.read.node].block;
  const auto read = readAt(file, block, vacant.expression);
  return read && read->use == ReadUse::Computed && !isTested(file, file.model->programOf(block), vacant.variable);
}

void check(const FlowFacts &facts, const FileContext &context, const Reporter &reporter) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> done;
  for (const VacantReadInCall &vacant : facts.vacantReads()) {
    const auto *instruction = std::get_if<CallProgram>(&facts.node(vacant.call).instruction);
    const auto letter = letterOfArgument(context.dialect, vacant.variable);
    if (!instruction || !letter)
      continue;
    const Call &call = context.model.calls[instruction->call];
    const auto callee = context.callGraph.callee(context.file, call);
    const ProgramFile &file = facts.programs.file(vacant.read.file);
    const ProgramId reader = file.model->programOf(file.cfg.nodes[vacant.read.node].block);
    const bool passed = std::ranges::find(call.arguments, vacant.variable, &Argument::variable) != call.arguments.end();
    if (call.kind != CallKind::Macro || !callee || callee->file != vacant.read.file || callee->program != reader ||
        passed || !isRelied(facts, vacant) || !done.insert({vacant.call.index(), vacant.variable}).second)
      continue;
    const ProgramName &named = file.model->programs[reader].name;
    const std::string name =
        named.empty() ? std::filesystem::path(file.source->path()).filename().generic_string() : toString(named);
    reporter.report(
        {.message =
             fmt::format("{} computes with `#{}` ({}), but this call does not pass it", name, vacant.variable, *letter),
         .span = call.span,
         .labels = {{file.tree->expressions[vacant.expression].span, "vacant here, read as 0", vacant.read.file}},
         .flow = pathFromEntry(facts, vacant.call),
         .notes = {fmt::format("pass {}, or let {} check `[#{} EQ #0]` first", *letter, name, vacant.variable)}});
  }
}

} // namespace

extern const Rule missingArgument;
const Rule missingArgument{.info = {"missing-argument", Category::Flow, Severity::Warning,
                                    "Reports a macro call without an argument that the macro computes with."},
                           .hooks = {.flow = check}};

} // namespace feedhold::rules::missing_argument
