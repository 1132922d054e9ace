// missing-argument: the macro computes with `#18`, and the call does not pass R.
#include "base/source/path_text.h"
#include "base/support/text.h"
#include "rules/flow/flow_view.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <set>

namespace feedhold::rules::missing_argument {
namespace {

constexpr std::uint32_t kMostParameters = 30; // of a call by o-word

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

/// Some condition of the subroutine asks for the parameter, or for the name that it copies it to.
bool asksFor(const ProgramFile &file, ProgramId program, std::uint32_t parameter) {
  if (isTested(file, program, parameter))
    return true;
  std::set<std::string> names;
  std::string conditions;
  for (const BlockId block : blocksOf(file, program))
    for (const Statement &statement : file.tree->statementsOf(block)) {
      const auto *assignment = std::get_if<Assignment>(&statement.node);
      const auto *name = assignment ? asInside<NamedVariable>(*file.tree, assignment->target) : nullptr;
      if (name && variableNumber(*file.tree, unwrapped(*file.tree, assignment->value)) == parameter)
        names.insert(toLower(file.source->text(name->name)));
      if (std::holds_alternative<OWord>(statement.node))
        conditions += toLower(file.source->text(statement.span));
    }
  return std::ranges::any_of(
      names, [&](const std::string &name) { return conditions.find("#<" + name + ">") != std::string::npos; });
}

/// What the program does with the parameter.
struct ParameterUse {
  const VariableUse *read = nullptr; // the first one
  bool isWritten = false;
};
ParameterUse useOf(const ProgramFile &file, ProgramId program, std::uint32_t parameter) {
  ParameterUse found;
  for (const VariableUse &use : file.model->variablesOf(program)) {
    if (use.number != parameter || file.model->programOf(use.block) != program)
      continue;
    found.isWritten = found.isWritten || use.write;
    found.read = found.read || use.write ? found.read : &use;
  }
  return found;
}

bool isPassedByOther(ProgramRef callee, std::uint32_t parameter, const FileContext &context) {
  return std::ranges::any_of(context.model.calls, [&](const Call &call) {
    return call.kind == CallKind::OWord && call.values.size() >= parameter &&
           context.callGraph.callee(context.file, call) == callee;
  });
}

/// `o<slot> call [50] [3]` of a subroutine that computes with #3, which other calls pass.
void checkOWord(CallId id, const FileContext &context, const Reporter &reporter) {
  const Call &call = context.model.calls[id];
  const auto callee = call.kind == CallKind::OWord ? context.callGraph.callee(context.file, call) : std::nullopt;
  if (!callee)
    return;
  const ProgramFile &file = context.programs->file(callee->file);
  const ProgramFile &own = context.programs->file(context.file);
  for (auto parameter = static_cast<std::uint32_t>(call.values.size() + 1); parameter <= kMostParameters; ++parameter) {
    const ParameterUse use = useOf(file, callee->program, parameter);
    // What is not passed is that of the caller.
    const ParameterUse callers = useOf(own, call.caller, parameter);
    if (!use.read || use.isWritten || callers.read || callers.isWritten ||
        !isPassedByOther(*callee, parameter, context) || asksFor(file, callee->program, parameter))
      continue;
    const std::string name = toString(file.model->programs[callee->program].name);
    reporter.report({.message = fmt::format("`{}` reads `#{}`, but this call passes {} values only", name, parameter,
                                            call.values.size()),
                     .span = call.span,
                     .labels = {{file.tree->expressions[use.read->expression].span, "0 here", callee->file}},
                     .notes = {"a value that is not passed is that of the caller, which has none",
                               "pass the value, as other calls do"}});
    return;
  }
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
        named.empty() ? pathText(std::filesystem::path(file.source->path()).filename()) : toString(named);
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
                           .hooks = {.call = checkOWord, .flow = check}};

} // namespace feedhold::rules::missing_argument
